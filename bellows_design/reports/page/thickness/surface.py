"""The part's surface with the local thickness of the material below it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.reports.page.thickness.refining import edge_lengths, refined
from printers.arrays import Flags, Floats, Ints

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.geometry.tessellation import ClosedMesh
    from printers.measure.thickness.local_thickness import LocalThickness

SMOOTH = 0.9
"""Cosine of the angle between neighbours up to which colours run on over their edge."""

EDGES = 5.0
"""So many edges of the shown mesh span the part at least, whatever its size."""

FINEST, STEP, PASSES = 60.0, 0.06, 6
"""Where the thickness changes along an edge by more than this ``STEP`` of the largest that is
shown, edges are halved: down to so many across the part, in so many passes."""

CELL = 0.03
"""mm. Nearer points of the mesh are shown as one: its slivers would be seen as lines."""

TURN = 2.0
"""mm that count as far as opposite normals: the two sides of a thin wall are kept apart."""

NEAREST = 5
"""Samples whose median a point takes: at edges single ones have nothing opposite."""

FAR = 1.0
"""mm. Points with no sample as near as that have no thickness: within the port's bore."""


@dataclass(frozen=True, eq=False)
class ThicknessMap:
    """Triangles (m, 3) on points (n, 3), mm, with the thickness (n,), mm, below them.

    Points on sharp edges are there once for each of the faces that meet in them. What is thicker
    than ``reach``, or has nothing opposite, has this thickness; NaN is where nothing was measured.
    """

    triangles: Ints
    positions: Floats
    thickness: Floats
    reach: float


def thickness_map(design: Design, mesh: ClosedMesh) -> ThicknessMap:
    """The local thickness below the printed surface, as the printer's rules measure it."""
    coarse = _without_slivers(mesh.vertices, mesh.triangles)
    survey = _Survey.of(design, mesh, _patches(*coarse))
    vertices, triangles, origin = refined(*coarse, survey.wanted, PASSES)
    places, corners, values = survey.values(vertices, triangles, origin)
    return ThicknessMap(corners, places, values, survey.reach)


@dataclass(frozen=True, eq=False)
class _Survey:
    """Samples of the thickness, and the smooth patches (m,) of the mesh's triangles."""

    found: LocalThickness
    reach: float
    patches: Ints
    extent: float

    @staticmethod
    def of(design: Design, mesh: ClosedMesh, patches: Ints) -> _Survey:
        """Measured on the part's mesh."""
        extent = float(np.ptp(mesh.vertices, axis=0).max())
        return _Survey(*_measured(design, mesh), patches, extent)

    def wanted(self, vertices: Floats, triangles: Ints, origin: Ints) -> Flags:
        """Edges (m, 3) that are long, or along which the thickness changes much."""
        _, corners, values = self.values(vertices, triangles, origin)
        at = np.nan_to_num(values, nan=self.reach)[corners]
        changes = np.abs(np.roll(at, -1, axis=1) - at) > STEP * self.reach
        lengths = edge_lengths(vertices, triangles)
        return np.asarray(
            (lengths > self.extent / EDGES) | (changes & (lengths > self.extent / FINEST))
        )

    def values(
        self, vertices: Floats, triangles: Ints, origin: Ints
    ) -> tuple[Floats, Ints, Floats]:
        """Points (n, 3), one for each patch at a vertex, triangles (m, 3), and thicknesses (n,)."""
        size = int(self.patches.max()) + 1
        keys = triangles * size + self.patches[origin, None]
        points, corners = np.unique(keys, return_inverse=True)
        corners, places = corners.reshape(triangles.shape), vertices[points // size]
        normals = _point_normals(places, corners)
        return places, corners, _at_points(self.found, places, normals, self.reach)


def _measured(design: Design, mesh: ClosedMesh) -> tuple[LocalThickness, float]:
    """Samples of the surface, and how thick walls are looked for."""
    from bellows_design.printability import printed_model
    from printers.measure.part import MeasuredPart

    profile = design.profile()
    part = MeasuredPart(printed_model(design, mesh), profile)
    return part.thickness, profile.thickest_wall_of_lines


def _at_points(found: LocalThickness, places: Floats, normals: Floats, reach: float) -> Floats:
    """Thickness (n,) at points, of the nearest samples whose face looks the same way."""
    from scipy.spatial import KDTree

    samples = found.samples
    known = KDTree(np.hstack([samples.points, TURN / 2 * samples.normals]))
    apart, which = known.query(np.hstack([places, TURN / 2 * normals]), k=NEAREST)
    values = np.median(np.minimum(found.thickness, reach)[which], axis=1)
    return np.where(apart[:, 0] <= FAR, values, np.nan)


def _without_slivers(vertices: Floats, triangles: Ints) -> tuple[Floats, Ints]:
    """The mesh with points of one cell of a fine grid as one: for the eye alone."""
    _, first, numbers = np.unique(
        np.round(vertices / CELL), axis=0, return_index=True, return_inverse=True
    )
    joined = numbers.reshape(-1)[triangles]
    proper = (joined != np.roll(joined, 1, axis=1)).all(axis=1)
    return vertices[first], joined[proper]


def _patches(vertices: Floats, triangles: Ints) -> Ints:
    """Number of the smooth patch of each triangle (m,)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from trimesh.graph import face_adjacency

    pairs = face_adjacency(triangles)  # type: ignore[no-untyped-call]
    across = _across(vertices[triangles])
    normals = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    alike = np.einsum("ij,ij->i", normals[pairs[:, 0]], normals[pairs[:, 1]]) > SMOOTH
    rows, columns = pairs[alike].T
    size = (len(triangles), len(triangles))
    joined = coo_array((np.ones(len(rows)), (rows, columns)), shape=size)
    return np.asarray(connected_components(joined, directed=False)[1])


def _point_normals(places: Floats, triangles: Ints) -> Floats:
    """Unit normals (n, 3) at points, the mean of their triangles' by area."""
    across, corners = np.repeat(_across(places[triangles]), 3, axis=0), triangles.ravel()
    count = len(places)
    total = np.stack([np.bincount(corners, each, count) for each in across.T], axis=1)
    return np.asarray(total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300))


def _across(corners: Floats) -> Floats:
    """Outward normals (m, 3), twice as long as the triangles' areas."""
    return np.asarray(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
