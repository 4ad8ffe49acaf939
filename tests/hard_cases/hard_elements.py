"""Incompressibility."""

from __future__ import annotations

import numpy as np
from hard_bodies import (
    NEO_HOOKE,
    THREE_PLANES,
    TIGHT,
    Points,
    cantilever,
    distance,
    solved,
)
from hard_case import Finding, HardCase, at_most, exactly, within
from meshes import box_mesh
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from solver import Mesh, Ogden, Problem, Traction
from solver.mesh.elements import tetrahedron_rule

RATIOS = (10.0, 1e2, 1e4, 1e6, 1e9)


def bulk_modulus() -> tuple[Finding, ...]:
    """From moderate to infinite: how far from incompressible, times K / mu."""
    mesh = box_mesh((3, 1, 1), (3.0, 1.0, 1.0))
    exact = solved(cantilever(mesh, NEO_HOOKE), 0.02)
    far = []
    for ratio in RATIOS:
        found = solved(cantilever(mesh, Ogden((1.0,), (2.0,), ratio)), 0.02)
        u = distance(found.displacement, exact.displacement)
        q = distance(found.hydrostatic_pressure, exact.hydrostatic_pressure)
        far.append((u, q))
    scaled = [max(pair) * ratio for pair, ratio in zip(far, RATIOS, strict=True)]
    return (
        at_most("distance from K = ∞ times K/μ, K/μ = 10 … 1e6", max(scaled[:4]), 10),
        at_most("distance itself at K/μ = 1e9", max(far[-1]), 1e-7),
    )


def locking() -> tuple[Finding, ...]:
    """A coarse bar bends nearly as far as a fine one, and no less for a larger bulk modulus."""
    fine, medium, coarse = (_tip((4 * n, n, n), np.inf) for n in (3, 2, 1))
    stiff, soft = _tip((4, 1, 1), 1e6), _tip((4, 1, 1), 1e3)
    return (
        at_most("tip deflection, 192 against 648 tetrahedra, K = ∞", medium / fine - 1, 0.05),
        at_most("24 against 648", coarse / fine - 1, 0.1),
        at_most("K/μ = 1e3 instead of ∞, on 24", soft / coarse - 1, 5e-3),
        at_most("K/μ = 1e6", stiff / coarse - 1, 5e-6),
    )


def _tip(divisions: tuple[int, int, int], ratio: float) -> float:
    """Deflection of a bar of 6 x 1 x 1 mm, mm."""
    mesh = box_mesh(divisions, (6.0, 1.0, 1.0))
    found = solved(cantilever(mesh, Ogden((1.0,), (2.0,), ratio)), 0.002)
    return float(found.displacement[mesh.surface_nodes("x1"), 2].mean())


def inf_sup() -> tuple[Finding, ...]:
    """Least eigenvalue of B A^-1 B^T q = beta^2 M q, A the gradients' norm, M the pressures'."""
    cubes = [inf_sup_constant(box_mesh((n, n, n), distortion=0.2), CUBE) for n in (2, 3, 4)]
    plates = [inf_sup_constant(box_mesh((n, n, 1), (8.0, 8.0, 0.4)), RIM) for n in (3, 5, 7)]
    spurious = sum(modes for _, modes in (*cubes, *plates))
    return (
        within("β on a clamped cube, 3 meshes", least(cubes), 0.15, 1.0),
        within("finest over coarsest", cubes[-1][0] / cubes[0][0], 1.0, 2.0),
        within("β on a plate clamped at its rim, 20 : 1, 3 meshes", least(plates), 0.2, 1.0),
        within("finest over coarsest", plates[-1][0] / plates[0][0], 1.0, 2.0),
        exactly("spurious pressure modes", spurious, 0),
    )


CUBE = ("x0", "x1", "y0", "y1", "z0", "z1")
RIM = ("x0", "x1", "y0", "y1")


def least(results: list[tuple[float, int]]) -> float:
    return min(beta for beta, _ in results)


def inf_sup_constant(mesh: Mesh, clamped: tuple[str, ...]) -> tuple[float, int]:
    """The inf-sup constant, constants left out where all is clamped, and vanishing others."""
    laplacian, divergence, mass = _matrices(mesh)
    free = np.setdiff1d(np.arange(len(mesh.nodes)), mesh.surface_nodes(*clamped))
    solve = splu(csc_array(laplacian[free][:, free])).solve
    parts = [divergence[axis][free] for axis in range(3)]
    schur = sum(part.T @ solve(part) for part in parts)
    values = eigh(schur, mass, eigvals_only=True)
    values = values[1:] if len(clamped) == 6 else values
    return float(np.sqrt(max(values[0], 0.0))), int((values < 1e-6).sum())


def _matrices(mesh: Mesh) -> tuple[Points, Points, Points]:
    """Laplacian (n, n) of the quadratic, divergence (3, n, v), mass (v, v) of the linear ones."""
    rule = tetrahedron_rule()
    jacobians = np.einsum("qad,eai->eqdi", rule.gradients, mesh.nodes[mesh.tets])
    volumes = np.linalg.det(jacobians) * rule.weights
    gradients = np.einsum("eqid,qad->eqai", np.linalg.inv(jacobians), rule.gradients)
    nodes, vertices = len(mesh.nodes), len(mesh.vertices)
    laplacian, mass = np.zeros((nodes, nodes)), np.zeros((vertices, vertices))
    divergence = np.zeros((nodes, vertices, 3))
    parts = np.einsum("eq,eqai,eqbi->eab", volumes, gradients, gradients)
    np.add.at(laplacian, _pairs(mesh.tets, mesh.tets), parts)
    parts = np.einsum("eq,qk,ql->ekl", volumes, rule.linear, rule.linear)
    np.add.at(mass, _pairs(mesh.tet_vertices, mesh.tet_vertices), parts)
    parts = np.einsum("eq,eqai,qk->eaki", volumes, gradients, rule.linear)
    np.add.at(divergence, _pairs(mesh.tets, mesh.tet_vertices), parts)
    return laplacian, np.moveaxis(divergence, 2, 0), mass


def _pairs(rows: NDArray[np.int32], columns: NDArray[np.int32]) -> tuple[NDArray[np.int32], ...]:
    return rows[:, :, None], columns[:, None, :]


def checkerboard() -> tuple[Finding, ...]:
    """Pressures of a block under an uneven pull: they come closer to the fine mesh's, smoothly."""
    fine = _uneven(6)
    errors = [_pressure_error(_uneven(n), fine) for n in (2, 3)]
    return (
        at_most("pressure off the finest mesh's, 3³ against 6³ cells", errors[1], 0.05),
        within("2³ over 3³ cells", errors[0] / errors[1], 1.5, 6.0),
    )


def _uneven(divisions: int) -> tuple[Mesh, Points]:
    """An incompressible block pulled by a smooth traction: mesh and pressures."""

    def pull(at: Points) -> Points:
        size = 0.4 * np.cos(np.pi * at[:, 0]) * np.cos(np.pi * at[:, 1])
        return np.stack([0 * size, 0 * size, size], axis=1)

    mesh = box_mesh((divisions,) * 3, distortion=0.2)
    problem = Problem(mesh, NEO_HOOKE, THREE_PLANES, loads=(Traction("z1", pull),))
    return mesh, solved(problem, 0.0, TIGHT).hydrostatic_pressure


def _pressure_error(coarse: tuple[Mesh, Points], fine: tuple[Mesh, Points]) -> float:
    """Root mean square distance at the grid's boundary vertices, which distortion leaves alone."""
    at, where = (mesh.nodes[mesh.vertices].round(9) for mesh, _ in (coarse, fine))
    known = {tuple(point): value for point, value in zip(where, fine[1], strict=True)}
    pairs = [
        (value, known[tuple(point)])
        for point, value in zip(at, coarse[1], strict=True)
        if tuple(point) in known
    ]
    difference = np.subtract(*np.transpose(pairs))
    return float(np.sqrt(np.mean(difference**2)) / np.ptp(fine[1]))


CASES = (
    HardCase(
        "Bulk modulus from moderate to infinite",
        "a huge K spoils the matrix; K = ∞ divides by zero",
        "the pressure is a field of its own and only 1/K enters, 0 for incompressible",
        bulk_modulus,
    ),
    HardCase(
        "Locking",
        "elements that cannot bend without changing their volume are far too stiff",
        "quadratic displacement, linear pressure",
        locking,
    ),
    HardCase(
        "Inf-sup condition",
        "pressures that no displacement feels: oscillation, or a singular matrix",
        "the constant β of the pair is bounded away from 0 under refinement, thin plates included",
        inf_sup,
    ),
    HardCase(
        "Checkerboard",
        "pressures that alternate from vertex to vertex and do not converge",
        "they converge with the mesh",
        checkerboard,
    ),
)
