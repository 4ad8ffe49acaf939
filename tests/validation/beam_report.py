"""What the document says of the beam."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from record import Report, Results

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "beam.json").read_text(encoding="utf-8")
)
CELLS = (6.0, 3.0, 2.0, 1.5)
SEVERAL = 3.0
"""mm; cells on which variants are computed."""
NEARLY, INCOMPRESSIBLE, AUTHORS = "nearly incompressible", "incompressible", "authors' modulus"
MARKERS = {
    "top": ((0.0, 30.0), (0.0, 1.0)),
    "left": ((15.0, 24.0), (1.0, 0.0)),
    "right": ((15.0, 6.0), (1.0, 0.0)),
}
"""Foot and normal (y, z) in the half y > 0 that is modelled; the left marker is mirrored."""


def on_cells(what: str, cell: float) -> str:
    """Name of a computation."""
    return f"{what}, cells of {cell:g} mm"


def report(results: Results) -> Report:
    """The section."""
    return Report("", "", "", (), "", "")


def draw(results: Results, path: str) -> None:
    """Deflections over the load."""
