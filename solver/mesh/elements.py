"""Shape functions and quadrature of the element pair: quadratic displacement, linear pressure.

Reference coordinates are (r, s, t) in the unit tetrahedron and (r, s) in the unit triangle;
barycentric coordinates are L0 = 1 - r - s - t, L1 = r, L2 = s, L3 = t. Node orders are Gmsh's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals

TETRAHEDRON_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3))
TRIANGLE_EDGES = ((0, 1), (1, 2), (2, 0))


@dataclass(frozen=True)
class Rule:
    """Shape functions tabulated at q quadrature points of a reference cell of dimension d.

    ``weights`` (q,) sum to the volume of the cell; ``linear`` (q, d + 1) and ``quadratic`` (q, m)
    are values, ``gradients`` (q, m, d) the derivatives of the quadratic ones.
    """

    weights: Reals
    linear: Reals
    quadratic: Reals
    gradients: Reals


def tetrahedron_rule() -> Rule:
    """Four points, exact for quadratics: the standard choice for ten-node mixed tetrahedra."""
    a, b = (5 + 3 * np.sqrt(5)) / 20, (5 - np.sqrt(5)) / 20
    barycentric = b + (a - b) * np.eye(4)
    return _tabulate(barycentric, np.full(4, 1 / 24), TETRAHEDRON_EDGES)


def triangle_rule() -> Rule:
    """Six points, exact for quartics (Dunavant 1985): all integrands of a follower pressure."""
    a, wa = 0.445948490915965, 0.223381589678011
    b, wb = 0.091576213509771, 0.109951743655322
    ones = np.eye(3)
    barycentric = np.concatenate([a + (1 - 3 * a) * ones, b + (1 - 3 * b) * ones])
    weights = np.repeat([wa, wb], 3) / 2
    return _tabulate(barycentric, weights, TRIANGLE_EDGES)


def quadratic_shapes(barycentric: Reals, edges: tuple[tuple[int, int], ...]) -> Reals:
    """Values of the quadratic shape functions at points (q, d + 1): (q, m)."""
    corners = [L * (2 * L - 1) for L in barycentric.T]
    middles = [4 * barycentric[:, a] * barycentric[:, b] for a, b in edges]
    return np.stack([*corners, *middles], axis=1)


def quadratic_gradients(barycentric: Reals, edges: tuple[tuple[int, int], ...]) -> Reals:
    """Derivatives with respect to (r, s[, t]) of the quadratic shape functions: (q, m, d)."""
    dimension = barycentric.shape[1] - 1
    slopes = np.vstack([-np.ones(dimension), np.eye(dimension)])  # dL/d(r, s, t)
    corners = [np.outer(4 * barycentric[:, k] - 1, slopes[k]) for k in range(dimension + 1)]
    middles = [
        4 * (np.outer(barycentric[:, a], slopes[b]) + np.outer(barycentric[:, b], slopes[a]))
        for a, b in edges
    ]
    return np.stack([*corners, *middles], axis=1)


def _tabulate(
    barycentric: Reals,
    weights: Reals,
    edges: tuple[tuple[int, int], ...],
) -> Rule:
    return Rule(
        weights=weights,
        linear=barycentric,
        quadratic=quadratic_shapes(barycentric, edges),
        gradients=quadratic_gradients(barycentric, edges),
    )
