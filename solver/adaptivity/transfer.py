"""Interpolation of a solution to another mesh, as a start for Newton's method."""

from __future__ import annotations

import numpy as np
from numba import prange
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.compilation import njit
from solver.errors import SolverError
from solver.input_types import check_instance
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_shapes
from solver.mesh.mesh import Mesh
from solver.results.solution import Solution, check_solution

CANDIDATES = 24
"""Elements with the nearest centres, in which a point is searched."""

OUTSIDE = 0.02
"""Points outside of an element by no more than this, in barycentric coordinates, count as inside:
two meshes of one curved body differ by more, and the extrapolation is as good as the interpolation.
"""


def transfer(solution: Solution, finer_mesh: Mesh) -> tuple[Reals, Reals]:
    """Interpolate a solution to another mesh of the same body, as ``initial`` for ``solve``.

    By the shape functions of the element in which each node lies; a node slightly outside of the
    old mesh takes the extrapolation of the element it is least outside of. A hydrostatic pressure
    is that of an element of the same region.

    Args:
        solution: on the old mesh.
        finer_mesh: the other mesh.

    Returns:
        Displacement at its nodes and hydrostatic pressure at its vertices.

        *Shape:* (n, 3) in mm, (v,) in MPa.

    Raises:
        SolverError: no solution, no mesh, or meshes of different bodies: of which the extents
            differ by more than an edge, or the names of regions.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, solve, transfer
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> coarse, fine = (block((30, 4, 4), cells) for cells in ((6, 1, 1), (12, 2, 2)))
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> meshes = (coarse, fine)
        >>> problems = [Problem(mesh, rubber, Supports(("x0",)), loads=(bend,)) for mesh in meshes]
        >>> start = solve(problems[0])
        >>> refined = solve(problems[1], initial=transfer(start, fine))
        >>> print(refined.load_steps, "load step")
        1 load step
        >>> print([f"{found.displacement[:, 2].min():.2f} mm" for found in (start, refined)])
        ['-4.16 mm', '-4.34 mm']
    """
    check_solution(solution)
    check_instance("transfer: finer_mesh", finer_mesh, Mesh)
    mesh = solution.problem.mesh
    _check_same_body(mesh, finer_mesh)
    element, barycentric = locate(mesh, finer_mesh.nodes)
    shapes = quadratic_shapes(barycentric, TETRAHEDRON_EDGES)
    displacement = np.einsum("na,nai->ni", shapes, solution.displacement[mesh.tets[element]])
    pressure = np.zeros(len(finer_mesh.vertices))
    for number, name in _shared_regions(mesh, finer_mesh):
        there = np.flatnonzero(finer_mesh.region_of_vertex == number)
        nodes = finer_mesh.vertices[there]
        if mesh.regions:
            own = np.flatnonzero(mesh.region_of_tet == mesh.region_names.index(name))
            part = Mesh(mesh.nodes, mesh.tets[own])
            within, barycentric = locate(part, finer_mesh.nodes[nodes])
            pressure[there] = _interpolated(solution, own[within], barycentric)
        else:
            pressure[there] = _interpolated(solution, element[nodes], barycentric[nodes])
    return displacement, pressure


def _interpolated(solution: Solution, elements: NDArray[np.int64], barycentric: Reals) -> Reals:
    """Hydrostatic pressure (k,) at barycentric coordinates (k, 4) in elements (k,), MPa."""
    corners = solution.hydrostatic_pressure[solution.problem.mesh.tet_vertices[elements]]
    pressure: Reals = np.einsum("na,na->n", barycentric, corners)
    return pressure


def _shared_regions(mesh: Mesh, other: Mesh) -> list[tuple[int, str]]:
    """Numbers in the other mesh, and names, of the regions; ``SolverError`` unless both agree."""
    ours, theirs = (
        {each.region_names[number] for number in np.unique(each.region_of_tet)}
        for each in (mesh, other)
    )
    if ours != theirs:
        names = [", ".join(map(repr, sorted(each))) for each in (ours, theirs)]
        raise SolverError(
            f"transfer: both meshes must have the same regions; one has {names[0]}, the other "
            f"{names[1]} ('' is the rest)."
        )
    return [(number, name) for number, name in enumerate(other.region_names) if name in theirs]


def _check_same_body(mesh: Mesh, other: Mesh) -> None:
    """Raise ``SolverError`` if the extents of two meshes differ by more than a mean edge."""
    ours, theirs = (each.nodes[each.vertices] for each in (mesh, other))
    ends = (theirs.min(axis=0) - ours.min(axis=0), theirs.max(axis=0) - ours.max(axis=0))
    apart = float(np.abs(ends).max())
    if apart > mesh.edge:
        raise SolverError(
            f"transfer: both meshes must be of one body; their extents differ by {apart:.4g} mm."
        )


def locate(mesh: Mesh, points: Reals) -> tuple[NDArray[np.int64], Reals]:
    """The element each point (k, 3) lies in, (k,), and barycentric coordinates in it, (k, 4)."""
    from scipy.spatial import cKDTree

    centres = mesh.nodes[mesh.tets].mean(axis=1)
    count = min(CANDIDATES, len(centres))
    _, near = cKDTree(centres).query(points, k=count)
    element = np.zeros(len(points), np.int64)
    barycentric = np.empty((len(points), 4))
    near = near.reshape(len(points), count)
    _locate(mesh.nodes, mesh.tets, points, near, element, barycentric)
    return element, barycentric


@njit(cache=True, error_model="numpy", parallel=True)
def _locate(
    nodes: Reals,
    tets: Integers,
    points: Reals,
    near: NDArray[np.int64],
    element: NDArray[np.int64],
    barycentric: Reals,
) -> None:
    """Of the elements ``near`` (k, c) each point, the one it is in or least outside of."""
    for p in prange(len(points)):
        best = -np.inf
        x = np.empty((10, 3))
        local = np.empty(4)
        for candidate in near[p]:
            for a in range(10):
                for i in range(3):
                    x[a, i] = nodes[tets[candidate, a], i]
            _inverse_map(x, points[p], local)
            inside = min(local[0], local[1], local[2], local[3])
            if inside > best:
                best = inside
                element[p] = candidate
                for k in range(4):
                    barycentric[p, k] = local[k]
            if best >= -OUTSIDE:
                break


@njit(cache=True, error_model="numpy")
def _inverse_map(x: Reals, point: Reals, local: Reals) -> None:
    """Barycentric coordinates (4,) of a point in the ten-node tetrahedron x (10, 3), by Newton.

    Written element by element, as are all functions here: numba compiles operations on whole arrays
    for seconds.
    """
    edge_a = (0, 1, 0, 0, 2, 1)
    edge_b = (1, 2, 2, 3, 3, 3)
    slopes = np.empty((4, 3))  # dX / dL_k
    gap = np.empty(3)
    step = np.empty(3)
    for k in range(4):
        local[k] = 0.25
    for _ in range(20):
        for i in range(3):
            position = 0.0
            for k in range(4):
                position += local[k] * (2.0 * local[k] - 1.0) * x[k, i]
                slopes[k, i] = (4.0 * local[k] - 1.0) * x[k, i]
            for e in range(6):
                a, b = edge_a[e], edge_b[e]
                position += 4.0 * local[a] * local[b] * x[4 + e, i]
                slopes[a, i] += 4.0 * local[b] * x[4 + e, i]
                slopes[b, i] += 4.0 * local[a] * x[4 + e, i]
            gap[i] = point[i] - position
        _solve3(slopes, gap, step)
        for k in range(3):
            local[k + 1] += step[k]
        local[0] -= step[0] + step[1] + step[2]
        largest = max(abs(step[0]), abs(step[1]), abs(step[2]))
        if largest < 1e-10:
            return
        if not largest < 1e3:
            break
    for k in range(4):  # far outside of a curved element: the map has no inverse there
        local[k] = -1e3


@njit(cache=True, error_model="numpy")
def _solve3(slopes: Reals, gap: Reals, step: Reals) -> None:
    """Changes of L1, L2, L3 (3,) that move a point by ``gap`` (3,); ``slopes`` (4, 3) = dX / dL."""
    sides = np.empty((3, 3))
    for k in range(3):
        for i in range(3):
            sides[k, i] = slopes[k + 1, i] - slopes[0, i]
    a, b, c = sides[0], sides[1], sides[2]
    determinant = _triple(a, b, c)
    step[0] = _triple(gap, b, c) / determinant
    step[1] = _triple(a, gap, c) / determinant
    step[2] = _triple(a, b, gap) / determinant


@njit(cache=True, error_model="numpy")
def _triple(a: Reals, b: Reals, c: Reals) -> float:
    """a . (b x c)."""
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )
