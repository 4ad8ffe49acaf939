"""3MF: everything that is built, in mm, at its place.

Names, colours, materials and other metadata say nothing about the surface and are passed over.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError, quoted
from printers.reading.part import ReadPart, require_few
from printers.reading.threemf.archive import Package
from printers.reading.threemf.model import (
    DEFAULT_UNIT,
    UNITS,
    ModelFile,
    Object,
    Placed,
    read_model,
)
from printers.reading.threemf.xml_events import Attributes, read_elements

USUAL_PLACE = "3D/3dmodel.model"
DEEPEST_NESTING = 16  # of objects made of objects
MOST_COPIES = 10_000
FLATTEST = float(np.finfo(np.float32).eps)
"""Ratio of the scales of a transform: programs have meshes in numbers that tell no less."""

_START = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_RELATIONS = "_rels/.rels"

Mesh = tuple[Floats, Ints]


def read_3mf(content: bytes) -> ReadPart:
    """The items that a 3MF file builds, as one surface. Raises PrintersError."""
    package = Package(content)
    start = _start(package)
    contents = _Contents(package)
    model = contents.file(start)
    if not model.items:
        raise PrintersError("it builds nothing")
    copies, triangles = _total(contents, start, model.items)
    if copies > MOST_COPIES:
        raise PrintersError(f"it builds {copies} copies of its objects; at most {MOST_COPIES}")
    require_few(triangles)
    meshes = [mesh for item in model.items for mesh in _meshes(contents, start, item)]
    vertices, corners = _joined(meshes)
    unit = UNITS[model.unit or DEFAULT_UNIT]
    return ReadPart(vertices * unit, corners, "3MF", _units(model), _notes(model, contents))


@dataclass
class _Contents:
    """The model files of a package, each read when it is first asked for."""

    package: Package
    files: dict[str, ModelFile] = field(default_factory=dict)
    sizes: dict[tuple[str, str], tuple[int, int]] = field(default_factory=dict)

    def file(self, name: str) -> ModelFile:
        if name not in self.files:
            self.files[name] = read_model(self.package.pieces(name))
        return self.files[name]

    def object(self, file: str, placed: Placed) -> tuple[str, Object]:
        """The file an object is in, and the object."""
        place = placed.file or file
        found = self.file(place).objects.get(placed.number)
        if found is None:
            raise PrintersError(f"it builds the object {quoted(placed.number)}, which it lacks")
        return place, found


def _start(package: Package) -> str:
    """The model file that the package names as its first."""
    found: list[str] = []

    def begin(name: str, attributes: Attributes) -> None:
        if name.endswith(" Relationship") and attributes.get("Type") == _START:
            found.append(attributes.get("Target", "").lstrip("/"))

    if _RELATIONS in package:
        read_elements(package.pieces(_RELATIONS), begin, lambda name: None)
    return found[0] if found else USUAL_PLACE


def _total(contents: _Contents, file: str, items: list[Placed], depth: int = 0) -> tuple[int, int]:
    """Copies and triangles that items come to, each object looked at once."""
    if depth > DEEPEST_NESTING:
        raise PrintersError(f"its objects are made of each other more than {DEEPEST_NESTING} deep")
    copies = triangles = 0
    for item in items:
        place, found = contents.object(file, item)
        key = (place, item.number)
        if key not in contents.sizes:
            inner = _total(contents, place, found.components, depth + 1)
            contents.sizes[key] = 1 + inner[0], found.size + inner[1]
        copies, triangles = copies + contents.sizes[key][0], triangles + contents.sizes[key][1]
    return copies, triangles


def _meshes(contents: _Contents, file: str, placed: Placed) -> list[Mesh]:
    """The meshes of one copy of an object, at their places, in the file's unit."""
    place, found = contents.object(file, placed)
    if not found.is_part:
        return []
    meshes = [found.mesh()]
    for component in found.components:
        meshes.extend(_meshes(contents, place, component))
    return [_moved(mesh, placed.transform) for mesh in meshes if len(mesh[1])]


def _moved(mesh: Mesh, transform: Floats) -> Mesh:
    vertices, triangles = mesh
    scales = np.linalg.svd(transform[:3], compute_uv=False)
    if not scales[-1] > FLATTEST * scales[0]:
        raise PrintersError("a transform makes an object flat")
    mirrored = np.linalg.slogdet(transform[:3]).sign < 0  # would be inside out
    turned = triangles[:, ::-1] if mirrored else triangles
    return vertices @ transform[:3] + transform[3], turned


def _joined(meshes: list[Mesh]) -> Mesh:
    if not meshes:
        raise PrintersError("it holds no triangle")
    first = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    triangles = [mesh[1] + start for mesh, start in zip(meshes, first, strict=False)]
    return np.concatenate([vertices for vertices, _ in meshes]), np.concatenate(triangles)


def _units(model: ModelFile) -> str:
    return model.unit or f"not stated: {DEFAULT_UNIT}, as 3MF has it then"


def _notes(model: ModelFile, contents: _Contents) -> tuple[str, ...]:
    notes = []
    if len(model.items) > 1:
        notes.append(f"{len(model.items)} items in one file")
    if model.left_out:
        notes.append(f"{model.left_out} items left out, which their program does not print")
    objects = (each for file in contents.files.values() for each in file.objects.values())
    supports = sum(not each.is_part for each in objects)
    if supports:
        notes.append(f"{supports} supports left out")
    return tuple(notes)
