"""From a CAD solid to the one closed triangle mesh that is checked, sliced and shipped."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError

if TYPE_CHECKING:
    import cadquery as cq

TOLERANCE = 0.02
"""mm. No triangle is farther from the solid's surface: a twentieth of a 0.4 mm line."""

ANGULAR_TOLERANCES = (0.3, 0.15, 0.075)
"""rad. Neighbouring edges along a curve turn by no more, so that small fillets stay round.

The CAD kernel can miss the linear tolerance on doubly curved faces, and says so; the finer angles
are tried then.
"""


class TessellationError(BellowsError):
    """The solid's triangles do not close, or turn inside out."""


@dataclass(frozen=True)
class ClosedMesh:
    """Closed, outward-oriented triangle mesh.

    ``vertices`` *Shape:* (n, 3), mm; every coordinate is a number of single precision, so that a
    binary STL holds exactly this mesh. ``triangles`` *Shape:* (m, 3), vertex numbers.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]

    @property
    def volume(self) -> float:
        """Volume enclosed, mm³ (divergence theorem)."""
        first, second, third = (self.vertices[self.triangles[:, i]] for i in range(3))
        return float(np.einsum("ij,ij->", first, np.cross(second, third)) / 6)


def tessellate(solid: cq.Solid, tolerance: float = TOLERANCE) -> ClosedMesh:
    """Triangles within ``tolerance`` (mm, absolute) of ``solid``, verified to be watertight.

    Raises ``TessellationError`` if they do not bound a solid.
    """
    mesh = _merged(*_triangulated(solid, tolerance))
    _verify(mesh, solid.Volume())
    return mesh


def _triangulated(
    solid: cq.Solid, tolerance: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools

    misses = []
    for angle in ANGULAR_TOLERANCES:
        BRepTools.Clean_s(solid.wrapped)
        BRepMesh_IncrementalMesh(solid.wrapped, tolerance, False, angle, False)
        missed = _farthest(solid, tolerance)
        if missed is None:
            return _joined([_mesh_of(face) for face in solid.Faces()])
        misses.append(missed)
    best = min(misses, key=lambda miss: miss.distance)
    raise TessellationError(
        f"no mesh of this design keeps within {tolerance:g} mm of it: the best is "
        f"{best.distance:.3g} mm off at {best.place}; change the fillet there by 0.1 mm "
        "(inner_fillet in the cavity, outer_fillet outside)"
    )


def _joined(
    meshes: list[tuple[NDArray[np.float64], NDArray[np.int64]]],
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The faces' meshes as one, its points in single precision."""
    first = np.cumsum([0] + [len(points) for points, _ in meshes])
    points = np.concatenate([points for points, _ in meshes]).astype(np.float32)
    triangles = [triangles + start for (_, triangles), start in zip(meshes, first, strict=False)]
    return points.astype(np.float64) + 0.0, np.concatenate(triangles)


@dataclass(frozen=True)
class _Miss:
    """How far a mesh misses its face, mm, and where."""

    distance: float
    place: str


def _farthest(solid: cq.Solid, tolerance: float) -> _Miss | None:
    """Where the mesh is farthest from its solid; None if nowhere by more than ``tolerance`` mm.

    The kernel's account of a face is an upper bound, which edges that a boolean operation placed
    some µm off the face can raise many times over. Faces that it names are therefore measured.
    """
    from OCP.BRepTools import BRepTools

    named = (f for f in solid.Faces() if not BRepTools.Triangulation_s(f.wrapped, tolerance))
    misses = [_miss(face) for face in named]
    worst = max(misses, key=lambda miss: miss.distance, default=None)
    return None if worst is None or worst.distance <= tolerance else worst


def _miss(face: cq.Face) -> _Miss:
    """Largest distance of corners, edge middles and centroids of the triangles from the face."""
    from OCP.BRep import BRep_Tool
    from OCP.gp import gp_Pnt
    from OCP.ShapeAnalysis import ShapeAnalysis_Surface

    surface = ShapeAnalysis_Surface(BRep_Tool.Surface_s(face.wrapped))
    points, triangles = _mesh_of(face)
    corners = points[triangles]
    probes = np.concatenate([points, corners.mean(axis=1), *_edge_middles(corners)])
    gaps = np.empty(len(probes))
    for index, probe in enumerate(probes.tolist()):
        surface.ValueOfUV(gp_Pnt(*probe), 1e-7)
        gaps[index] = surface.Gap()
    x, y, z = probes[int(gaps.argmax())]
    return _Miss(float(gaps.max()), f"({x:.1f}, {y:.1f}, {z:.1f}) mm")


def _edge_middles(corners: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    return [(corners[:, i] + corners[:, (i + 1) % 3]) / 2 for i in range(3)]


def _mesh_of(face: cq.Face) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Points (n, 3) mm and triangles (m, 3), outward, of the mesh that the kernel gave a face."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location

    place = TopLoc_Location()
    mesh = BRep_Tool.Triangulation_s(face.wrapped, place)
    nodes = (mesh.Node(i + 1).Transformed(place.Transformation()) for i in range(mesh.NbNodes()))
    points = np.array([(node.X(), node.Y(), node.Z()) for node in nodes])
    triangles = np.array([mesh.Triangle(i + 1).Get() for i in range(mesh.NbTriangles())]) - 1
    turned = face.wrapped.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
    return points, triangles[:, [0, 2, 1]] if turned else triangles


def _merged(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> ClosedMesh:
    """One vertex per place: neighbouring faces hold the points of a shared edge twice."""
    vertices, numbers = np.unique(points, axis=0, return_inverse=True)
    corners = numbers.reshape(-1)[triangles]
    first, second, third = corners.T
    proper = (first != second) & (second != third) & (third != first)
    return ClosedMesh(vertices, corners[proper])


def _verify(mesh: ClosedMesh, volume: float) -> None:
    import manifold3d

    edges = np.concatenate([mesh.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    forward, counts = np.unique(edges, axis=0, return_counts=True)
    backward = np.unique(edges[:, ::-1], axis=0)
    if counts.max() > 1 or not np.array_equal(forward, backward):
        raise TessellationError("the surface of this design does not close into a watertight mesh")
    copy = manifold3d.Mesh(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    status = manifold3d.Manifold(copy).status()
    if status != manifold3d.Error.NoError:
        raise TessellationError(f"the surface of this design is no manifold ({status.name})")
    if abs(mesh.volume - volume) > 0.02 * volume:
        raise TessellationError(
            f"the mesh of this design encloses {mesh.volume:.1f} mm³, its solid {volume:.1f} mm³"
        )
