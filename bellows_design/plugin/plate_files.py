"""A plate as one file: STEP and 3MF with names, STL without."""

from __future__ import annotations

import re
import uuid
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import cadquery as cq

from bellows_design.errors import DesignError
from bellows_design.export.step_file import TIME_STAMP
from bellows_design.export.three_mf import NAMESPACE
from bellows_design.files.atomic import replacing
from bellows_design.plugin.plate import Piece, assembly_of, placed, rows_of
from bellows_design.validation.quoting import quoted

STAMP = re.compile(rb"(FILE_NAME\('[^']*',')[^']*(')")
"""The time in the header of a STEP file."""


def write_plate(pieces: Sequence[Piece], path: Path | str) -> None:
    """Write the pieces of a plate in the format of ``path``'s suffix, completely or not at all.

    Raises ``DesignError`` for another suffix than .step, .3mf or .stl, and ``CannotWrite`` if the
    file cannot be written.
    """
    target = Path(path)
    write = writer_for(target)
    with replacing(target) as temporary:
        write(pieces, temporary)


def writer_for(path: Path) -> Callable[[Sequence[Piece], Path], None]:
    """What writes a file with the suffix of ``path``. Raises ``DesignError``."""
    write = WRITERS.get(path.suffix.lower())
    if write is None:
        raise DesignError(f"{quoted(str(path))} must end in {', '.join(WRITERS)}.")
    return write


def _step(pieces: Sequence[Piece], path: Path) -> None:
    assembly_of(pieces).export(str(path), exportType="STEP")
    content = STAMP.sub(rb"\g<1>" + TIME_STAMP.encode() + rb"\g<2>", path.read_bytes(), count=1)
    path.write_bytes(content)


def _stl(pieces: Sequence[Piece], path: Path) -> None:
    import trimesh
    from trimesh.exchange.stl import export_stl

    parts = [
        trimesh.Trimesh(placed(piece.mesh, piece.location), piece.mesh.triangles, process=False)
        for piece in pieces
    ]
    path.write_bytes(export_stl(trimesh.util.concatenate(parts)))


def _three_mf(pieces: Sequence[Piece], path: Path) -> None:
    import lib3mf

    model = lib3mf.get_wrapper().CreateModel()
    model.SetUnit(lib3mf.ModelUnit.MilliMeter)
    bodies = {}
    for piece in pieces:
        digest = piece.design.digest
        if digest not in bodies:
            bodies[digest] = _body(model, piece)
        body = bodies[digest]
        item = model.AddBuildItem(body, _transform(piece.location))
        item.SetPartNumber(piece.name)
        item.SetUUID(_identifier(piece.name))
    model.SetBuildUUID(_identifier("build"))
    path.write_bytes(bytes(model.QueryWriter("3mf").WriteToBuffer()))


def _body(model: Any, piece: Piece) -> Any:
    """The mesh of a piece's design, which its copies share."""
    import lib3mf

    body = model.AddMeshObject()
    body.SetName(piece.design.name)
    body.SetGeometry(
        [lib3mf.Position((x, y, z)) for x, y, z in piece.mesh.vertices.tolist()],
        [lib3mf.Triangle((a, b, c)) for a, b, c in piece.mesh.triangles.tolist()],
    )
    body.SetUUID(_identifier(piece.design.digest))
    return body


def _transform(location: cq.Location) -> Any:
    import lib3mf

    transform = lib3mf.Transform()
    for row, values in enumerate(rows_of(location).tolist()):
        for column, value in enumerate(values):
            transform.Fields[row][column] = value
    return transform


def _identifier(of: str) -> str:
    """A UUID (RFC 9562, version 5) of one thing in the file of a plate."""
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"{NAMESPACE}/plate/{of}"))


WRITERS = {".3mf": _three_mf, ".step": _step, ".stl": _stl}
