"""Free rims of surfaces under follower pressure, and what they add to its tangent.

The derivative of the force, the integral of N_a n da, has a skew part besides the symmetric one of
``solver.kernels.pressure``. Inside a surface it cancels: by Green's theorem it is the integral
along the rim, counter-clockwise about the normal n,

    A_ab = [v_ab]x,   v_ab = -1/2 integral of N_a N_b dx,   [v]x w = v x w.

It vanishes where the rim is held, where it slides
along a line, and where it slides in a plane in which it lies, as in a plane of symmetry. A pressure
on a surface with any other rim has no potential (Schweizerhof and Ramm 1984).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.linear.sparsity import Pattern
from solver.mesh.elements import TRIANGLE_EDGES
from solver.mesh.mesh import Mesh
from solver.problem.problem import Problem
from solver.problem.supports import given_displacements
from solver.problem.unknowns import Numbering

LOADS = (0.25, 0.5, 1.0)
"""Fractions of the load at which a led rim is looked at."""

FLAT = 1e-9
"""Distance from a plane, in body diagonals, that counts as none."""


@dataclass(frozen=True)
class FreeRim:
    """Free edges of a problem's pressurised surfaces.

    ``edges`` (k, 3): both ends and the mid-node, along the rim; ``places`` and ``signs`` (k, 9, 9):
    where the entries of an edge's skew matrix are added to the values of the tangent's upper
    triangle, -1 for nowhere, and with which sign.
    """

    edges: Integers
    places: Integers
    signs: Reals

    @staticmethod
    def of(problem: Problem, numbering: Numbering, pattern: Pattern, start: Reals) -> FreeRim:
        """The free rim of a problem whose supports act on a body displaced by ``start`` (n, 3).

        Raises ``SolverError`` for a free rim beside a moving plane, whose cavity must be closed.
        """
        edges = free_edges(problem, start)
        if len(edges) and problem.moving_plane is not None:
            raise SolverError(
                f"loads: the surfaces {', '.join(map(repr, problem.pressurised))} have a free rim "
                f"at {place_of(problem.mesh, edges)} mm; with a moving plane they must end in it, "
                "at supports or in planes of symmetry."
            )
        dofs = numbering.displacement[edges].reshape(-1, 9)
        places, signs = _upper_places(pattern, dofs)
        return FreeRim(edges, places, signs)

    def add_tangent(self, nodes: Reals, pressure: float, values: Reals) -> None:
        """Add the skew part of the tangent under ``pressure`` to ``values`` of the upper triangle.

        ``nodes`` (n, 3): deformed.
        """
        with np.errstate(over="ignore"):  # what is not finite is refused later
            vectors = -0.5 * pressure * np.einsum("abc,kci->kabi", WEIGHTS, nodes[self.edges])
        matrices = np.einsum("kabm,ijm->kaibj", vectors, CROSS).reshape(self.places.shape)
        used = self.places >= 0
        np.add.at(values, self.places[used], (self.signs * matrices)[used])


def free_edges(problem: Problem, start: Reals) -> Integers:
    """Edges (k, 3) of the rim of the pressurised surfaces at which the pressure has no potential.

    ``start`` (n, 3): displacements that the supports act from, mm.
    """
    edges = rim(problem.mesh.triangles(*problem.pressurised))
    flat = FLAT * problem.mesh.size
    given = [
        given_displacements(problem.mesh, problem.supports, load, problem.moving_plane)[edges]
        for load in LOADS
    ]
    held = ~np.isnan(given[-1]).any(axis=1)
    positions = (problem.mesh.nodes + start)[edges]
    level = np.ptp(positions, axis=1) <= flat
    for motion in given:
        level &= ~(np.ptp(motion, axis=1) > flat)  # NaN where free
    closed = (held.sum(axis=1) >= 2) | (held & level).any(axis=1)
    if problem.moving_plane is not None:
        on_plane = problem.mesh.surface_nodes(problem.moving_plane)
        closed |= np.isin(edges, on_plane).all(axis=1)
    return np.ascontiguousarray(edges[~closed])


def rim(triangles: Integers) -> Integers:
    """Edges (k, 3) that belong to one of the triangles only, with their mid-nodes, in its sense."""
    edges = np.concatenate([triangles[:, [*TRIANGLE_EDGES[m], 3 + m]] for m in range(3)])
    _, first, counts = np.unique(
        np.sort(edges[:, :2], axis=1), axis=0, return_index=True, return_counts=True
    )
    return edges[np.sort(first[counts == 1])]


def _upper_places(pattern: Pattern, dofs: Integers) -> tuple[NDArray[np.int32], Reals]:
    """Where matrices over ``dofs`` (k, m) go in the upper triangle, and their signs, (k, m, m).

    Of each pair of transposed entries of a skew matrix one is taken.
    """
    width = dofs.shape[1]
    row, column = np.triu_indices(width)
    places = np.full((len(dofs), width, width), -1, np.int32)
    places[:, row, column] = pattern.entries(dofs)
    signs = np.where(dofs[:, :, None] <= dofs[:, None, :], 1.0, -1.0)
    return places, signs


def place_of(mesh: Mesh, edges: Integers) -> str:
    """The middle of the first of some edges (k, 3) in the undeformed body, as text."""
    return f"({', '.join(f'{x:.4g}' for x in mesh.nodes[edges[0, 2]])})"


def _edge_weights() -> Reals:
    """Integrals of N_a N_b dN_c over an edge, for its quadratic shape functions, (3, 3, 3)."""
    points, weights = np.polynomial.legendre.leggauss(3)
    values = np.stack([points * (points - 1) / 2, points * (points + 1) / 2, 1 - points**2])
    slopes = np.stack([points - 0.5, points + 0.5, -2 * points])
    integrals: Reals = np.einsum("q,aq,bq,cq->abc", weights, values, values, slopes)
    return integrals


WEIGHTS = _edge_weights()
CROSS = np.zeros((3, 3, 3))
"""[v]x = sum over m of CROSS[:, :, m] v_m."""
for _i, _j, _m in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    CROSS[_i, _j, _m], CROSS[_j, _i, _m] = -1.0, 1.0
