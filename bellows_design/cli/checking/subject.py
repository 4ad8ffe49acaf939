"""What is checked: a part, from a design or from a file, on its printer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.cli.checking.opening_options import openings_of, parse_openings
from bellows_design.cli.checking.options import CheckOptions

if TYPE_CHECKING:
    from bellows_design.progress import Progress
    from printers import PrintedModel, PrinterProfile
    from printers.model import Opening
    from printers.reading.part import ReadPart


@dataclass(frozen=True, eq=False)
class Subject:
    """A part on its printer.

    ``identity`` says in JSON what it is; ``notes`` are sentences on how it was understood.
    """

    title: str
    identity: Mapping[str, Any]
    model: PrintedModel
    profile: PrinterProfile
    notes: tuple[str, ...] = ()


def of_design(options: CheckOptions, progress: Progress) -> Subject:
    """The printed part of a design. Raises ``DesignError``."""
    from bellows_design import pipeline
    from bellows_design.printability import printed_model

    chosen = options.design.load()
    profile = options.with_filament(chosen.profile())
    progress.stage("geometry")
    part = pipeline.build_part(chosen)
    identity = {"design": chosen.name, "digest": chosen.digest}
    return Subject(chosen.name, identity, printed_model(chosen, part.mesh), profile)


def of_file(options: CheckOptions, progress: Progress) -> Subject:
    """The part in a file, with its openings. Raises ``DesignError`` and ``PrintersError``."""
    from printers.measure.surface import merged_surface
    from printers.reading.read import read_part

    named, profile = parse_openings(options.openings), options.profile()
    progress.stage(f"read {Path(options.name).name}")
    read = read_part(options.name)
    bare = _model(options.name, read)
    progress.stage("openings")
    openings, notes = openings_of(merged_surface(bare.vertices, bare.triangles), named)
    identity = {
        "file": options.name,
        "format": read.format,
        "units": read.units,
        "triangles": len(read.triangles),
        "openings": [opening_dict(opening) for opening in openings],
    }
    model = replace(bare, openings=openings)
    said = (f"{read.format}; units {read.units}; {_size(model)}", *read.notes, *notes)
    return Subject(Path(options.name).name, identity, model, profile, said)


def _model(name: str, read: ReadPart) -> PrintedModel:
    """What was read as a part to be printed. Raises ``PrintersError``, which names the file."""
    from printers.errors import PrintersError, quoted
    from printers.model import PrintedModel

    try:
        return PrintedModel(read.vertices, read.triangles)
    except PrintersError as error:
        raise PrintersError(f"{quoted(name)} cannot be taken as a part: {error}.") from None


def opening_dict(opening: Opening) -> dict[str, Any]:
    """An opening as plain values for JSON."""
    return {
        "name": opening.name,
        "centre_mm": list(opening.centre),
        "direction": list(opening.direction),
        "diameter_mm": 2 * opening.radius,
        "reach_mm": opening.reach,
    }


def _size(model: PrintedModel) -> str:
    import numpy as np

    return " × ".join(f"{extent:.2f}" for extent in np.ptp(model.vertices, axis=0)) + " mm"
