"""Solids whose faces keep the name they were built under, and the rounded boxes they come from.

A boolean operation of the CAD kernel records which faces of the result came from which face of
its arguments. Names travel along that record; they are never guessed from coordinates.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING, Any

import cadquery as cq
from cadquery import func
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp
from OCP.TopTools import TopTools_IndexedMapOfShape, TopTools_ListOfShape

from bellows_design.errors import BellowsError

if TYPE_CHECKING:
    from solver import Mesh
    from solver.meshing import MeshOptions

Point = tuple[float, float, float]

BEYOND = 1.0
"""mm. How far a cutting solid reaches past what it cuts."""

SEWING_TOLERANCE = 1e-6
"""mm. Faces of one rounded box share edges exactly but for rounding."""


class GeometryError(BellowsError):
    """The CAD kernel could not build a valid solid from admissible numbers."""


@dataclass(frozen=True)
class NamedSolid:
    """One solid and the name of each of its faces, in the solid's own face order."""

    solid: cq.Solid
    face_names: tuple[str, ...]

    def faces(self, name: str) -> tuple[cq.Face, ...]:
        """Faces that carry ``name``."""
        pairs = zip(self.solid.Faces(), self.face_names, strict=True)
        return tuple(face for face, own in pairs if own == name)

    def area(self, name: str) -> float:
        """Area of the faces called ``name``, mm²."""
        return sum(face.Area() for face in self.faces(name))

    @property
    def looseness(self) -> float:
        """How far faces miss each other at most where they meet, mm, as the CAD kernel states."""
        from OCP.BRep import BRep_Tool

        return max(float(BRep_Tool.Tolerance_s(edge.wrapped)) for edge in self.solid.Edges())

    @property
    def solids(self) -> tuple[cq.Solid, ...]:
        """The solid."""
        return (self.solid,)

    @property
    def brep(self) -> bytes:
        """The solid as the CAD kernel writes it."""
        content = BytesIO()
        self.solid.exportBrep(content)
        return content.getvalue()

    def meshed(self, options: MeshOptions, seconds: float) -> Mesh:
        """The mesh with its named surfaces, made within ``seconds``. Raises ``MeshingError``."""
        from solver.meshing import mesh_solid

        return mesh_solid(self.brep, self.face_names, options, seconds)

    def renamed(self, rename: Callable[[cq.Face, str], str]) -> NamedSolid:
        """Same solid, each face called ``rename(face, name)``."""
        pairs = zip(self.solid.Faces(), self.face_names, strict=True)
        return NamedSolid(self.solid, tuple(rename(face, own) for face, own in pairs))


def named(solid: cq.Solid, name: str) -> NamedSolid:
    """``solid`` with all its faces called ``name``."""
    return NamedSolid(solid, tuple(name for _ in solid.Faces()))


def fused(*parts: NamedSolid) -> NamedSolid:
    """Union of ``parts``; faces that merge keep the earlier part's name."""
    return _boolean(BRepAlgoAPI_Fuse(), parts[:1], parts[1:]) if len(parts) > 1 else parts[0]


def cut(body: NamedSolid, *tools: NamedSolid) -> NamedSolid:
    """``body`` without ``tools``; the new faces keep the tools' names."""
    return _boolean(BRepAlgoAPI_Cut(), (body,), tools) if tools else body


def _boolean(
    builder: Any, arguments: Sequence[NamedSolid], tools: Sequence[NamedSolid]
) -> NamedSolid:
    builder.SetArguments(_shape_list(arguments))
    builder.SetTools(_shape_list(tools))
    builder.SetRunParallel(False)
    builder.Build()
    if not builder.IsDone():
        raise GeometryError("the CAD kernel could not combine the solids of this design")
    builder.SimplifyResult(True, False, 1e-6)
    solid = _only_solid(cq.Shape.cast(builder.Shape()))
    return NamedSolid(solid, _carried_names(builder, (*arguments, *tools), solid))


def _shape_list(parts: Sequence[NamedSolid]) -> Any:
    shapes = TopTools_ListOfShape()
    for part in parts:
        shapes.Append(part.solid.wrapped)
    return shapes


def _carried_names(builder: Any, parts: Sequence[NamedSolid], solid: cq.Solid) -> tuple[str, ...]:
    """Name of each face of the result: that of the first part it came from."""
    faces = _face_map(solid)
    names = [""] * faces.Extent()
    for part in parts:
        sources = _face_map(part.solid)
        for number, name in enumerate(part.face_names, start=1):
            face = sources.FindKey(number)
            modified = builder.Modified(face)
            for image in modified if modified.Size() else (face,):
                place = faces.FindIndex(image)  # 0: it is not in the result
                if place and not names[place - 1]:
                    names[place - 1] = name
    if "" in names:
        raise GeometryError("the CAD kernel lost track of the faces of this design")
    return tuple(names)


def _face_map(solid: cq.Solid) -> Any:
    """Faces of a solid by their number from 1, in the order of ``solid.Faces()``."""
    faces = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(solid.wrapped, TopAbs_FACE, faces)
    return faces


def _only_solid(shape: cq.Shape) -> cq.Solid:
    solids = shape.Solids()
    if len(solids) != 1:
        raise GeometryError(f"this design falls into {len(solids)} solids instead of one")
    solid = solids[0]
    if not solid.isValid():
        raise GeometryError("the CAD kernel made an invalid solid of this design")
    return solid


def box(lower: Point, upper: Point) -> cq.Solid:
    """Axis-parallel box between two corners, mm."""
    x, y, z = (high - low for low, high in zip(lower, upper, strict=True))
    return cq.Solid.makeBox(x, y, z, cq.Vector(*lower))


def rounded_box(lower: Point, upper: Point, radius: float) -> cq.Solid:
    """Axis-parallel box between two corners with all twelve edges rounded, mm.

    Sewn from planes, quarter cylinders and sphere octants, so that ``radius`` may be exactly half
    of an edge (a full round) without the slivers of a fillet operation.
    """
    if radius <= 0:
        return box(lower, upper)
    half = [(high - low) / 2 for low, high in zip(lower, upper, strict=True)]
    if radius > min(half) + 1e-9:
        raise GeometryError(f"radius = {radius:g} mm exceeds half of the box, {min(half):g} mm")
    core = [extent - radius if extent - radius > 1e-9 else 0.0 for extent in half]
    centre = cq.Vector(*[(low + high) / 2 for low, high in zip(lower, upper, strict=True)])
    faces = [*_planes(core, radius), *_cylinders(core, radius), *_octants(core, radius)]
    solid = func.solid(*faces, tol=SEWING_TOLERANCE)
    return _only_solid(solid.moved(cq.Location(centre)))


def _vector(values: dict[int, float]) -> cq.Vector:
    return cq.Vector(*(values.get(axis, 0.0) for axis in range(3)))


def _planes(core: Sequence[float], radius: float) -> list[cq.Shape]:
    faces: list[cq.Shape] = []
    for axis, sign in itertools.product(range(3), (-1, 1)):
        one, two = (axis + 1) % 3, (axis + 2) % 3
        if core[one] == 0 or core[two] == 0:
            continue
        corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
        points = [
            _vector({axis: sign * (core[axis] + radius), one: i * core[one], two: j * core[two]})
            for i, j in corners
        ]
        faces.append(func.face(func.polyline(*points, points[0])))
    return faces


def _arc(
    centre: dict[int, float], one: int, two: int, signs: Sequence[float], radius: float
) -> cq.Shape:
    """Quarter circle about ``centre`` from axis ``one`` to axis ``two``, in their signs' sense."""
    origin = _vector(centre)
    start = _vector({one: signs[one] * radius})
    stop = _vector({two: signs[two] * radius})
    middle = (start + stop).multiply(0.5**0.5)
    return cq.Edge.makeThreePointArc(origin + start, origin + middle, origin + stop)


def _cylinders(core: Sequence[float], radius: float) -> list[cq.Shape]:
    faces = []
    for axis in range(3):
        if core[axis] == 0:
            continue
        one, two = (axis + 1) % 3, (axis + 2) % 3
        for i, j in itertools.product((-1, 1), repeat=2):
            centre = {axis: -core[axis], one: i * core[one], two: j * core[two]}
            signs = _vector({one: i, two: j}).toTuple()
            arc = _arc(centre, one, two, signs, radius)
            faces.append(func.extrude(arc, _vector({axis: 2 * core[axis]})))
    return faces


def _octants(core: Sequence[float], radius: float) -> list[cq.Shape]:
    faces = []
    for signs in itertools.product((-1, 1), repeat=3):
        centre = {axis: signs[axis] * core[axis] for axis in range(3)}
        meridian = _arc(centre, 0, 2, signs, radius)
        turn = 90 if signs[0] * signs[1] > 0 else -90
        pole = cq.Vector(0, 0, 1)
        faces.append(func.revolve(meridian, _vector(centre), pole, turn))
    return faces


def prism(profile: cq.Shape, start: float, stop: float) -> cq.Solid:
    """Solid swept from y = ``start`` to y = ``stop`` (mm) by a closed wire in the plane y = 0."""
    face = func.face(profile).moved(cq.Location(cq.Vector(0, start, 0)))
    return _only_solid(func.extrude(face, cq.Vector(0, stop - start, 0)))
