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

    for angle in ANGULAR_TOLERANCES:
        BRepTools.Clean_s(solid.wrapped)
        BRepMesh_IncrementalMesh(solid.wrapped, tolerance, False, angle, False)
        if BRepTools.Triangulation_s(solid.wrapped, tolerance):
            break
    else:
        raise TessellationError(f"no mesh of this design keeps within {tolerance:g} mm of it")
    # CadQuery's own meshing takes the tolerance relative to each edge's length; it leaves a mesh
    # that is there, and fine enough, as it is.
    vertices, triangles = solid.tessellate(tolerance)
    points = np.array([vertex.toTuple() for vertex in vertices], dtype=np.float32)
    return points.astype(np.float64) + 0.0, np.array(triangles, dtype=np.int64)


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
