"""The part's surface with the local thickness of the material below it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.reports.page.thickness.refining import refined
from solver.arrays import Integers, Reals

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.geometry.tessellation import ClosedMesh
    from printers.measure.thickness.local_thickness import LocalThickness

SMOOTH = 0.9
"""Cosine of the angle between neighbours up to which colours run on over their edge."""

EDGES = 5.0
"""So many edges of the shown mesh span the part, whatever its size."""

TURN = 2.0
"""mm that count as far as opposite normals: the two sides of a thin wall are kept apart."""

NEAREST = 3
"""Samples whose mean a point takes."""

FAR = 1.0
"""mm. Points with no sample as near as that have no thickness: within the port's bore."""


@dataclass(frozen=True, eq=False)
class ThicknessMap:
    """Triangles (m, 3) on points (n, 3), mm, with the thickness (n,), mm, below them.

    Points on sharp edges are there once for each of the faces that meet in them. What is thicker
    than ``reach``, or has nothing opposite, has this thickness; NaN is where nothing was measured.
    """

    triangles: Integers
    positions: Reals
    thickness: Reals
    reach: float


def thickness_map(design: Design, mesh: ClosedMesh) -> ThicknessMap:
    """The local thickness below the printed surface, as the printer's rules measure it."""
    found, reach = _measured(design, mesh)
    extent = float(np.ptp(mesh.vertices, axis=0).max())
    patches = _patches(mesh.vertices, mesh.triangles)
    vertices, triangles, origin = refined(mesh.vertices, mesh.triangles, extent / EDGES)
    keys = np.stack([triangles, np.broadcast_to(patches[origin, None], triangles.shape)], axis=2)
    points, corners = np.unique(keys.reshape(-1, 2), axis=0, return_inverse=True)
    corners, places = corners.reshape(triangles.shape), vertices[points[:, 0]]
    values = _at_points(found, places, _point_normals(places, corners), reach)
    return ThicknessMap(corners, places, values, reach)


def _measured(design: Design, mesh: ClosedMesh) -> tuple[LocalThickness, float]:
    """Samples of the surface, and how thick walls are looked for."""
    from bellows_design.printability import printed_model
    from printers.measure.part import MeasuredPart

    profile = design.profile()
    part = MeasuredPart(printed_model(design, mesh), profile)
    return part.thickness, profile.thickest_wall_of_lines


def _at_points(found: LocalThickness, places: Reals, normals: Reals, reach: float) -> Reals:
    """Thickness (n,) at points, of the nearest samples whose face looks the same way."""
    from scipy.spatial import KDTree

    samples = found.samples
    known = KDTree(np.hstack([samples.points, TURN / 2 * samples.normals]))
    apart, which = known.query(np.hstack([places, TURN / 2 * normals]), k=NEAREST)
    values = np.minimum(found.thickness, reach)[which].mean(axis=1)
    return np.where(apart[:, 0] <= FAR, values, np.nan)


def _patches(vertices: Reals, triangles: Integers) -> Integers:
    """Number of the smooth patch of each triangle (m,)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from trimesh.graph import face_adjacency

    pairs = face_adjacency(triangles)
    across = _across(vertices[triangles])
    normals = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    alike = np.einsum("ij,ij->i", normals[pairs[:, 0]], normals[pairs[:, 1]]) > SMOOTH
    rows, columns = pairs[alike].T
    size = (len(triangles), len(triangles))
    joined = coo_array((np.ones(len(rows)), (rows, columns)), shape=size)
    return np.asarray(connected_components(joined, directed=False)[1])


def _point_normals(places: Reals, triangles: Integers) -> Reals:
    """Unit normals (n, 3) at points, the mean of their triangles' by area."""
    across, total = _across(places[triangles]), np.zeros_like(places)
    for corner in triangles.T:
        np.add.at(total, corner, across)
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)


def _across(corners: Reals) -> Reals:
    """Outward normals (m, 3), twice as long as the triangles' areas."""
    return np.asarray(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
