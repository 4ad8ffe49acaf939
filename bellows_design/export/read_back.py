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
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError
from bellows_design.export.part import Part
from bellows_design.export.placement import Placement, placement
from bellows_design.validation.quoting import quoted_reason
from printers.reading.stl import FACET

if TYPE_CHECKING:
    import cadquery as cq

ROUNDING = 1e-5
"""mm, by which a coordinate in the text of a 3MF file may differ; observed are 2e-6."""

SAME_VOLUME = 1e-6
"""Relative, of the solid read from a STEP file; observed are 7e-9."""

SAME_FACE = 1e-4
"""mm² and mm, area and centre of a face of it; observed are 2e-6."""

_MODEL = "3D/3dmodel.model"
_PACKAGE = (_MODEL, "[Content_Types].xml", "_rels/.rels", "3D/_rels/3dmodel.model.rels")
"""Files of a 3MF package with one model."""

_IDENTITY = "1 0 0 0 1 0 0 0 1 0 0 0"
"""Of an item without a transform."""

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
    try:
        mesh = _only_mesh(_model_of_3mf(part, content), placement(part))
        triangles = np.array(_numbers(mesh[1], "triangle", ("v1", "v2", "v3"))).astype(np.int64)
        vertices = np.array(_numbers(mesh[0], "vertex", ("x", "y", "z")))
    except NotThePart:  # it is a ValueError, too
        raise
    except (ValueError, KeyError, OverflowError) as error:
        raise NotThePart(f"a number in it is none: {quoted_reason(error)}") from None
    same = np.array_equal(triangles, part.mesh.triangles)
    _require(same, "its triangles are not the checked ones")
    near = vertices.shape == part.mesh.vertices.shape and np.allclose(
        vertices, part.mesh.vertices, rtol=0, atol=ROUNDING
    )
    _require(near, "its vertices are not the checked ones")


def _model_of_3mf(part: Part, content: bytes) -> ElementTree.Element:
    """The model in the package, beside which there is nothing but the part's own settings."""
    from bellows_design.export.companions import settings_comment
    from bellows_design.export.three_mf import SETTINGS

    settings = SETTINGS.lstrip("/")
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            names = archive.namelist()
            known = len(set(names)) == len(names) and _MODEL in names
            _require(known and set(names) <= {*_PACKAGE, settings}, "it holds other files")
            own = settings not in names or archive.read(settings) == settings_comment(part).encode()
            _require(own, "its settings are not those of the printer")
            return ElementTree.fromstring(archive.read(_MODEL))
    except (zipfile.BadZipFile, KeyError, ElementTree.ParseError) as error:
        raise NotThePart(f"it is no 3MF file: {error}") from None


def _only_mesh(root: ElementTree.Element, stands: Placement) -> ElementTree.Element:
    """The mesh of the one object, in mm, that is built once where the part ``stands``."""
    _require(root.get("unit", "millimeter") == "millimeter", "its unit is not the millimetre")
    parts = [each for each in root if each.tag != _CORE + "metadata"]
    tags = [each.tag for each in parts]
    _require(tags == [_CORE + "resources", _CORE + "build"], "it is not one part alone")
    body, item = _only_child(parts[0], "object"), _only_child(parts[1], "item")
    plain = item.get("objectid") == body.get("id") and item.get("printable", "1") in ("1", "true")
    _require(plain and body.get("type", "model") == "model", "its object is not what is built")
    place = [float(each) for each in item.get("transform", _IDENTITY).split()]
    there = len(place) == 12 and np.allclose(place, np.ravel(stands.rows), rtol=0, atol=ROUNDING)
    _require(there, "it does not stand as it is printed")
    mesh = _only_child(body, "mesh")
    tags = [each.tag for each in mesh]
    _require(tags == [_CORE + "vertices", _CORE + "triangles"], "its mesh is more than triangles")
    return mesh


def _only_child(of: ElementTree.Element, tag: str) -> ElementTree.Element:
    """The one child of this ``tag``, which is all there is."""
    _require([each.tag for each in of] == [_CORE + tag], f"it holds not just one {tag}")
    return of[0]


def _numbers(rows: ElementTree.Element, tag: str, keys: tuple[str, ...]) -> list[list[float]]:
    """The attributes ``keys`` of every row, which are all of this ``tag``."""
    _require({each.tag for each in rows} == {_CORE + tag}, f"it does not hold every {tag} as one")
    return [[float(each.attrib[key]) for key in keys] for each in rows]


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
    _require_same_faces(_faces(solid), _faces(part.solid))


def _require_same_faces(found: NDArray[np.float64], wanted: NDArray[np.float64]) -> None:
    """Every face has its own counterpart of the same area at the same place."""
    from scipy.spatial import KDTree

    count = f"its solid has {len(found)} faces instead of {len(wanted)}"
    _require(len(found) == len(wanted), count)
    apart, which = KDTree(found).query(wanted)
    same = apart.max() <= SAME_FACE and len(np.unique(which)) == len(found)
    _require(bool(same), "its solid has other faces")


def _faces(solid: cq.Shape) -> NDArray[np.float64]:
    """(n, 4): area and centre of mass of every face, mm² and mm."""
    return np.array([(face.Area(), *face.Center().toTuple()) for face in solid.Faces()])


READERS: Mapping[str, Callable[[Part, bytes], None]] = MappingProxyType(
    {".stl": _read_stl, ".3mf": _read_3mf, ".step": _read_step}
)
"""Suffix -> what raises ``NotThePart`` unless a content is the part."""
