"""What was written is read again, and must be the part: its triangles, or its solid.

A part's triangles are those that were found to be watertight: the same ones still are.

A disk may drop what it was given, another program may change it, and a library may write what no
other reads.
"""

from __future__ import annotations

import errno
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError
from bellows_design.export.part import Part
from printers.reading.stl import FACET

ROUNDING = 1e-5
"""mm, by which a coordinate in the text of a 3MF file may differ; observed are 2e-6."""

SAME_VOLUME = 1e-6
"""Relative, of the solid read from a STEP file; observed are 7e-9."""

_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


class NotThePart(BellowsError):
    """The content of a file is not the part it was made of; the message says how it differs."""


def require_same(part: Part, path: Path, content: bytes) -> None:
    """Raise ``OSError`` unless the file at ``path`` holds ``content``, and that the ``part``.

    The suffix of ``path`` chooses how it is read; a manifest holds no part.
    """
    found = path.read_bytes()
    if found != content:
        sizes = f"{len(content)} bytes were written, {len(found)} others read back"
        raise OSError(errno.EIO, f"its {path.suffix} file has changed: {sizes}")
    try:
        READERS.get(path.suffix.lower(), _no_part)(part, found)
    except NotThePart as difference:
        raise OSError(errno.EIO, f"its {path.suffix} file is wrong: {difference}") from None


def _no_part(part: Part, content: bytes) -> None:
    """Its bytes are all there is to compare."""


def _require(holds: bool, difference: str) -> None:
    if not holds:
        raise NotThePart(difference)


def _read_stl(part: Part, content: bytes) -> None:
    count = int.from_bytes(content[80:84], "little")
    wanted = len(part.mesh.triangles)
    whole = len(content) == 84 + count * FACET.itemsize
    _require(whole and count == wanted, f"it holds {count} triangles instead of {wanted}")
    corners = np.frombuffer(content, FACET, offset=84)["corners"]
    same = np.array_equal(corners, part.mesh.vertices[part.mesh.triangles])
    _require(same, "its triangles are not the checked ones")


def _read_3mf(part: Part, content: bytes) -> None:
    vertices, triangles = _mesh_of_3mf(content)
    same = np.array_equal(triangles, part.mesh.triangles)
    _require(same, "its triangles are not the checked ones")
    near = vertices.shape == part.mesh.vertices.shape and np.allclose(
        vertices, part.mesh.vertices, rtol=0, atol=ROUNDING
    )
    _require(near, "its vertices are not the checked ones")


def _mesh_of_3mf(content: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            root = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    except (zipfile.BadZipFile, KeyError, ElementTree.ParseError) as error:
        raise NotThePart(f"it is no 3MF file: {error}") from None
    rows = {
        tag: [[float(each.attrib[key]) for key in keys] for each in root.iter(_CORE + tag)]
        for tag, keys in (("vertex", "xyz"), ("triangle", ("v1", "v2", "v3")))
    }
    return np.array(rows["vertex"]), np.array(rows["triangle"]).astype(np.int64)


def _read_step(part: Part, content: bytes) -> None:
    import cadquery as cq
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader()
    status = reader.ReadStream(part.name, BytesIO(content))
    _require(status == IFSelect_ReturnStatus.IFSelect_RetDone, "it is no STEP file")
    reader.TransferRoots()
    _require(reader.NbShapes() == 1, f"it holds {reader.NbShapes()} bodies instead of one")
    solid, volume = cq.Shape.cast(reader.OneShape()), part.solid.Volume()
    difference = abs(solid.Volume() - volume)
    same = solid.isValid() and difference <= SAME_VOLUME * volume
    _require(same, f"its solid has another volume, by {difference:.3g} mm³, or is not closed")


READERS: Mapping[str, Callable[[Part, bytes], None]] = MappingProxyType(
    {".stl": _read_stl, ".3mf": _read_3mf, ".step": _read_step}
)
"""Suffix -> what raises ``NotThePart`` unless a content is the part."""
