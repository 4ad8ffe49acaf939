"""Triangles of a CAD shape, within a tolerance and closed where its faces share their edges."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.reading.part import require_few
from printers.tolerances import FACET_TOLERANCE

ANGLES = (0.3, 0.15, 0.075)
"""rad. Neighbouring edges along a curve turn by no more; the finer ones are tried where the kernel
misses the tolerance on doubly curved faces."""


def mesh_of(shape: Any) -> tuple[Floats, Ints, tuple[str, ...]]:
    """Vertices (n, 3) mm, triangles (m, 3) and notes. Raises PrintersError."""
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools

    for angle in ANGLES:
        BRepTools.Clean_s(shape)
        BRepMesh_IncrementalMesh(shape, FACET_TOLERANCE, False, angle, False)
        missed = sum(not BRepTools.Triangulation_s(face, FACET_TOLERANCE) for face in _faces(shape))
        if not missed:
            break
    note = f"the CAD kernel does not warrant {FACET_TOLERANCE:g} mm on {missed} of its faces"
    vertices, triangles, bare = _joined(shape)
    notes = ((note,) if missed else ()) + ((f"{bare} faces have no mesh",) if bare else ())
    return *_merged(vertices, triangles), notes


def _faces(shape: Any) -> Iterator[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        yield TopoDS.Face_s(explorer.Current())
        explorer.Next()


def _joined(shape: Any) -> tuple[Floats, Ints, int]:
    """Points and triangles of all faces, and how many faces have none."""
    points, triangles, first, bare, count = [], [], 0, 0, 0
    for face in _faces(shape):
        mesh = _mesh_of_face(face)
        if mesh is None:
            bare += 1
            continue
        points.append(mesh[0])
        triangles.append(mesh[1] + first)
        first, count = first + len(mesh[0]), count + len(mesh[1])
        require_few(count)
    if not points:
        raise PrintersError("the CAD kernel could not mesh any of its faces")
    return np.concatenate(points), np.concatenate(triangles), bare


def _mesh_of_face(face: Any) -> tuple[Floats, Ints] | None:
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location

    place = TopLoc_Location()
    mesh = BRep_Tool.Triangulation_s(face, place)
    if mesh is None:
        return None
    move = place.Transformation()
    nodes = (mesh.Node(i + 1).Transformed(move) for i in range(mesh.NbNodes()))
    points = np.array([(node.X(), node.Y(), node.Z()) for node in nodes])
    triangles = np.array([mesh.Triangle(i + 1).Get() for i in range(mesh.NbTriangles())]) - 1
    inward = (face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED) != move.IsNegative()
    return points, triangles[:, [0, 2, 1]] if inward else triangles


def _merged(points: Floats, triangles: Ints) -> tuple[Floats, Ints]:
    """One vertex per place: neighbouring faces hold the points of a shared edge twice.

    In single precision, as a binary STL of the part would have them.
    """
    single = points.astype(np.float32).astype(np.float64) + 0.0
    vertices, numbers = np.unique(single, axis=0, return_inverse=True)
    corners = numbers.reshape(-1)[triangles]
    proper = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    return vertices, corners[proper]
