"""Solids from STEP files and to them."""

from __future__ import annotations

import tempfile
from io import BytesIO
from pathlib import Path

import cadquery as cq


def solids_in(content: bytes) -> tuple[cq.Solid, ...]:
    """The solids in a STEP file, mm, in its order.

    The file is read by a process of its own: the CAD kernel may hang or crash on it.

    Raises:
        PrintersError: It cannot be read, or holds no solid.
    """
    from printers import PrintersError
    from printers.reading.step_files.reader import brep_of_step

    shape = cq.Shape.importBrep(BytesIO(brep_of_step(content)))
    solids = tuple(solid for solid in shape.Solids() if isinstance(solid, cq.Solid))
    if not solids:
        raise PrintersError("it holds no solid")
    return solids


def step_of(solid: cq.Solid) -> bytes:
    """A solid as the content of a STEP file in mm, without names of persons or places."""
    with tempfile.TemporaryDirectory(prefix="bellows-step-") as folder:
        file = Path(folder) / "part.step"
        cq.exporters.export(cq.Workplane(solid), str(file))
        return file.read_bytes()
