"""From a mesh and a printer's profile to G-code, by the slicer."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError, shortened
from printers.gcode.reading import GCode, read_gcode
from printers.profile import PrinterProfile
from printers.slicing.differences import differences
from printers.slicing.finding import Slicer, required_slicer
from printers.slicing.placing import Placement, misplaced, placed
from printers.slicing.prusa import parsed_settings, prusa_settings, settings_digest
from printers.slicing.running import run
from printers.slicing.steadiness import UNSTEADY, Steadiness, steadiness
from printers.slicing.stl import binary_stl
from printers.slicing.working_folder import working_folder

DEFAULT_SECONDS = 600.0
"""Time limit of one part, s. The shipped finger takes 15 s of a processor."""

MOST_WARNINGS = 20

NOT_STEADY = (
    "this system cannot fix a program's addresses: another run of the slicer lays some lines and "
    "all random seams elsewhere"
)

_PROGRESS = re.compile(
    r"\d+ => .*|Slicing result exported to .*|\[.*\[(trace|debug|info)\].*|Object name: .*|"
)
_BEGINNING = re.compile(r"print warning: |(\[[^\]]*\] )+\[(warning|error)\]\s*")


@dataclass(frozen=True, eq=False)
class Sliced:
    """What a slicer made of a part.

    Attributes:
        gcode: What its G-code lays down.
        slicer: Its name.
        version: Its version.
        profile_digest: The sha256 of the settings it was given.
        seconds: How long it took.
        placement: From the part's coordinates to those of the G-code, and back.
        reproducible: Whether the same slicer makes the same beads of the same part again.
        warnings: What the slicer warned of, in its own words, one warning each.
        notes: Sentences of ours: what the G-code leaves out, and if it is not reproducible.
    """

    gcode: GCode
    slicer: str
    version: str
    profile_digest: str
    seconds: float
    placement: Placement
    reproducible: bool
    warnings: tuple[str, ...]
    notes: tuple[str, ...]


def slice_mesh(
    vertices: Floats,
    triangles: Ints,
    profile: PrinterProfile,
    slicer: Slicer | None = None,
    rotation: float = 0.0,
    folder: Path | None = None,
    seconds: float = DEFAULT_SECONDS,
) -> Sliced:
    """The part's G-code with the airtight settings of the profile, read back as beads.

    The part stands as it is modelled, turned about z, in the middle of the bed.

    Args:
        vertices: (n, 3) mm.
        triangles: (m, 3) numbers of vertices.
        profile: The printer, its filament and settings.
        slicer: By default the one that `find_slicer` finds.
        rotation: About z, degrees, anticlockwise seen from above.
        folder: Where `part.stl`, `settings.ini`, `part.gcode` and, in `output.txt`, what the
            slicer said are kept; by default nowhere.
        seconds: Time limit of the slicer.

    Raises:
        PrintersError: One sentence: there is no slicer, the part does not fit the printer, the
            slicer failed, was too slow, made no file, dropped or changed settings, or moved the
            part.
    """
    corners = _corners(np.asarray(vertices, dtype=float), np.asarray(triangles))
    slicer = slicer or required_slicer()
    placement = placed(corners, rotation, profile)
    on_bed, settings = placement.to_gcode(corners), prusa_settings(profile)
    with working_folder(folder) as place:
        (place / "part.stl").write_bytes(binary_stl(on_bed))
        (place / "settings.ini").write_bytes(settings.encode())
        made = _made(slicer, place, profile, seconds)
    refuse_other_settings(settings, made.gcode)
    notes = misplaced(made.gcode.beads, on_bed, profile.line_width)
    return Sliced(
        gcode=made.gcode,
        slicer=slicer.name,
        version=slicer.version,
        profile_digest=settings_digest(settings),
        seconds=made.seconds,
        placement=placement,
        reproducible=made.steady,
        warnings=made.warnings,
        notes=(*notes, *(() if made.steady else (NOT_STEADY,))),
    )


@dataclass(frozen=True, eq=False)
class _Made:
    """What one run of the slicer gave, as in `Sliced`, and whether it was a steady one."""

    gcode: GCode
    warnings: tuple[str, ...]
    seconds: float
    steady: bool


def _made(slicer: Slicer, place: Path, profile: PrinterProfile, limit: float) -> _Made:
    """Slice what lies in the folder, and read it back."""
    steady = steadiness(place)
    started = time.perf_counter()
    warnings = run_slicer(slicer, place, profile, limit, steady)
    took = time.perf_counter() - started
    return _Made(read_gcode(place / "part.gcode"), warnings, took, bool(steady.prefix))


def run_slicer(
    slicer: Slicer,
    folder: Path,
    profile: PrinterProfile,
    seconds: float,
    steady: Steadiness = UNSTEADY,
) -> tuple[str, ...]:
    """Slice `part.stl` with `settings.ini` into `part.gcode`, all in the folder.

    Returns:
        The slicer's warnings.

    Raises:
        PrintersError: It failed, was too slow, or made no file.
    """
    middle = ",".join(f"{side / 2:g}" for side in profile.build_volume[:2])
    made = folder / "part.gcode"
    made.unlink(missing_ok=True)
    command = [
        *steady.prefix,
        str(slicer.path.absolute()),
        "--export-gcode",
        "--load",
        "settings.ini",
    ]
    command += ["--datadir", "own", "--center", middle, "--output", made.name, "part.stl"]
    ended = run(command, folder, seconds, steady.environment)
    warnings = tuple(_warnings(ended.output))
    reason = f": {shortened('; '.join(warnings))}" if warnings else ""
    if ended.status != 0:
        raise PrintersError(f"the slicer failed with status {ended.status}{reason}")
    if not made.is_file() or not made.stat().st_size:
        raise PrintersError(f"the slicer ended well, but made no G-code{reason}")
    return warnings


def refuse_other_settings(asked: str, gcode: GCode) -> None:
    """Compare what was asked for with what the G-code says was used.

    Raises:
        PrintersError: A setting was dropped or changed.
    """
    found = list(differences(parsed_settings(asked), gcode.settings))
    if found:
        shown = "; ".join(str(difference) for difference in found[:10])
        more = f" and {len(found) - 10} more" if len(found) > 10 else ""
        raise PrintersError(f"the slicer did not keep its settings: {shown}{more}")


def _corners(vertices: Floats, triangles: Ints) -> Floats:
    """(3 m, 3) the corners of the triangles, one triangle after the other."""
    if triangles.size == 0 or triangles.min() < 0 or triangles.max() >= len(vertices):
        raise PrintersError("the mesh has no triangles, or triangles without vertices")
    corners = np.asarray(vertices[triangles].reshape(-1, 3))
    if not np.isfinite(corners).all():
        raise PrintersError("the mesh has vertices that are no numbers")
    return corners


def _warnings(output: str) -> Iterator[str]:
    """What was said without the progress; a new warning begins where the slicer says so."""
    said = [line.strip() for line in output.splitlines()]
    told = [line for line in said if not _PROGRESS.fullmatch(line)]
    begins = [n for n, line in enumerate(told) if n == 0 or _BEGINNING.match(line)]
    for start, end in zip(begins[:MOST_WARNINGS], [*begins[1:], len(told)], strict=False):
        yield shortened(_BEGINNING.sub("", " ".join(told[start:end])))
