"""Checks of a mesh and its loaded surfaces, before anything is solved."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.errors import SolverError
from solver.mesh.elements import TETRAHEDRON_EDGES as EDGES
from solver.mesh.elements import TRIANGLE_EDGES
from solver.mesh.faces import edge_keys, face_keys, place_of
from solver.mesh.jacobians import least_jacobians
from solver.mesh.mesh import Mesh


def check_mesh(mesh: Mesh, pressurised: tuple[str, ...], loaded: tuple[str, ...] = ()) -> None:
    """Raise ``SolverError`` unless a mesh is a body and its loaded surfaces are on its boundary.

    A face belongs to one or two tetrahedra; the triangles of ``pressurised`` and otherwise
    ``loaded`` surfaces are faces of one, with outward normals. No triangle is pressurised twice.
    """
    if len(mesh.tets) == 0:
        raise SolverError("mesh: it has no tetrahedra.")
    outer = mesh.outer_faces
    for surface in (*pressurised, *loaded):
        if surface not in mesh.boundary_surfaces:
            _check_surface(mesh, surface, outer)
    triangles = mesh.triangles(*pressurised)
    keys, first = np.unique(face_keys(triangles, len(mesh.nodes)), return_index=True)
    if len(keys) < len(triangles):
        twice = np.setdiff1d(np.arange(len(triangles)), first)[0]
        raise SolverError(
            f"loads: a triangle of {', '.join(map(repr, pressurised))} at "
            f"{place_of(mesh.nodes, triangles[twice])} mm is pressurised twice."
        )


FLAT = 1e-15
"""Ratio of a mean Jacobian to the cube of the element's extent that is rounding."""


def check_elements(mesh: Mesh) -> None:
    """Raise ``SolverError`` unless the Jacobian of every tetrahedron is positive all over it.

    It may vanish at single points, as at a corner whose mid-nodes lie at quarters of the edges.
    """
    low, high, mean = least_jacobians(mesh.nodes, mesh.tets)
    extent = np.ptp(mesh.nodes[mesh.tets], axis=1).max(axis=1)
    flat = mean <= FLAT * extent**3
    if not (flat | (low < 0)).any():
        return
    worst = int(np.where(flat, -np.inf, low / np.where(flat, 1.0, mean)).argmin())
    x, y, z = mesh.nodes[mesh.tets[worst, :4]].mean(axis=0)
    what = "turned inside out or flat" if flat[worst] else "folded"
    value = f"is {mean[worst]:.3g} mm^3 on average"
    if not flat[worst]:
        value = f"falls to {min(high[worst], 0.0):.3g} mm^3 where its mean is {mean[worst]:.3g}"
    raise SolverError(
        f"mesh: tetrahedron {worst} is {what} at ({x:.4g}, {y:.4g}, {z:.4g}) mm: its Jacobian "
        f"{value}; it must be positive everywhere."
    )


def _check_surface(mesh: Mesh, surface: str, outer: NDArray[np.int64]) -> None:
    """Raise ``SolverError`` unless a surface is made of ``outer`` faces, given by their keys."""
    triangles = mesh.triangles(surface)
    if len(triangles) == 0:
        raise SolverError(f"loads: the surface {surface!r} has no triangles.")
    wrong = ~np.isin(face_keys(triangles, len(mesh.nodes)), outer)
    if wrong.any():
        bad = triangles[wrong][0]
        inwards = np.isin(face_keys(bad[None, [0, 2, 1]], len(mesh.nodes)), outer).all()
        what = "faces into the body" if inwards else "is no outer face of a tetrahedron"
        raise SolverError(
            f"loads: a triangle of the surface {surface!r} at {place_of(mesh.nodes, bad)} mm "
            f"{what}."
        )
    size = len(mesh.nodes)
    askew = ~np.isin(edge_keys(triangles, TRIANGLE_EDGES, size), edge_keys(mesh.tets, EDGES, size))
    if askew.any():
        bad = triangles[askew.reshape(-1, 3).any(axis=1)][0]
        raise SolverError(
            f"loads: a triangle of the surface {surface!r} at {place_of(mesh.nodes, bad)} mm "
            "has other mid-nodes than its tetrahedron."
        )
