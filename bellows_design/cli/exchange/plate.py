"""From the options of ``bellows plate`` to its answer."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from bellows_design.cli.answer import Answer
from bellows_design.cli.output_files import require_folder
from bellows_design.cli.surroundings.memory import GEOMETRY, require_address_space
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted

MOST = 200
"""Copies on one plate."""


def plate(wanted: Sequence[str], output: Path, spacing: float, printer: str | None) -> Answer:
    """Arrange copies of designs on a printer's bed and write them as one file."""
    from bellows_design.design.overrides import with_overrides
    from bellows_design.design.shipped import load_design
    from bellows_design.progress import on_stderr

    require_address_space(GEOMETRY)
    counts = [_counted(text) for text in wanted]
    set_printer = [] if printer is None else [f"printer={printer}"]
    designs = [
        design
        for name, count in counts
        for design in [with_overrides(load_design(name), set_printer)] * count
    ]
    from bellows_design.plugin.plate import pieces
    from bellows_design.plugin.plate_files import write_plate, writer_for

    writer_for(output)
    require_folder(output)
    with on_stderr() as progress:
        progress.stage(f"geometry of {len(designs)} actuators")
        placed = pieces(designs, spacing)
        progress.stage(f"write {output.name}")
        write_plate(placed, output)
    content = {
        "file": str(output),
        "bed_mm": list(designs[0].profile().build_volume),
        "parts": [
            {
                "name": piece.name,
                "design": piece.design.name,
                "digest": piece.design.digest,
                "lower_mm": piece.bounds[0],
                "upper_mm": piece.bounds[1],
            }
            for piece in placed
        ],
    }
    return Answer(content, [f"{output}: {len(placed)} actuators on one plate"])


def _counted(text: str) -> tuple[str, int]:
    """``NAME`` or ``NAME:COUNT``. Raises ``DesignError``."""
    name, colon, number = text.rpartition(":")
    if not colon or not number.isdecimal():
        return text, 1
    if not 1 <= int(number) <= MOST:
        raise DesignError(f"{quoted(text)}: copies must be 1 to {MOST}, got {number}.")
    return name, int(number)
