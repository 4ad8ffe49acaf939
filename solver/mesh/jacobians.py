"""Folded elements: bounds of the Jacobian determinant over whole quadratic tetrahedra.

The Jacobian of a quadratic map is linear in the barycentric coordinates L, J = sum_k L_k J_k with
the values J_k at the corners. Its determinant is therefore a cubic polynomial,

    det J = sum_(i, j, k) L_i L_j L_k det(column 0 of J_i, column 1 of J_j, column 2 of J_k),

and the averages of these 64 determinants over the orders of i, j, k are its twenty Bernstein-Bezier
coefficients: all values lie between the least and the largest of them, and those of the corners are
values. Where that does not tell the sign, the tetrahedron is cut into eight; the coefficients then
come nearer to the values by a factor of four. Source: G. Farin, Curves and Surfaces for CAGD, 5th
ed., ch. 17.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_gradients

ROUNDING = 1e-9
"""Share of an element's mean Jacobian below which a value counts as zero: so does the corner of an
element whose mid-nodes lie at quarters of its edges."""

HALVINGS = 6
"""Times that a tetrahedron whose sign is not known is cut into eight: the bounds are then apart by
less than a thousandth of what the Jacobian varies by in the element."""


class LeastJacobians(NamedTuple):
    """Bounds of the least Jacobian determinant in each tetrahedron, and its mean, mm^3.

    ``low`` (e,): no value lies below it. ``high`` (e,): a value that occurs. ``mean`` (e,): six
    times the volume. Bounds within rounding of zero are zero.
    """

    low: Reals
    high: Reals
    mean: Reals


def least_jacobians(nodes: Reals, tets: Integers) -> LeastJacobians:
    """Bounds of the Jacobians of tetrahedra (e, 10) of ``nodes`` (n, 3).

    Narrowed until the signs of both agree, at most ``HALVINGS`` times.
    """
    corners = _at_corners(nodes[tets])
    coefficients = _coefficients(corners)
    mean = coefficients.mean(axis=1)
    negligible = ROUNDING * np.abs(mean)
    low, high = _bounds(coefficients)
    for element in np.flatnonzero((low < -negligible) & (high >= -negligible)):
        low[element], high[element] = _narrowed(corners[element], negligible[element])
    for bound in (low, high):
        bound[np.abs(bound) <= negligible] = 0.0
    return LeastJacobians(low, high, mean)


def folded(nodes: Reals, tets: Integers) -> Integers:
    """Numbers of the tetrahedra (e, 10) of ``nodes`` (n, 3) with a negative Jacobian somewhere.

    The others have none, or one so near to zero that ``HALVINGS`` do not tell.
    """
    return np.flatnonzero(least_jacobians(nodes, tets).high < 0).astype(np.int32)


def _narrowed(corners: Reals, negligible: float) -> tuple[float, float]:
    """Bounds of the least determinant of one element with Jacobians (4, 3, 3) at its corners."""
    parts, low, high = corners[None], np.inf, np.inf
    for _ in range(HALVINGS):
        parts = np.einsum("pkc,ecij->epkij", CHILDREN, parts).reshape(-1, 4, 3, 3)
        lows, highs = _bounds(_coefficients(parts))
        unknown = lows < -negligible
        low = min(low, lows[~unknown].min(initial=np.inf))
        high = min(high, highs.min())
        parts, lows = parts[unknown], lows[unknown]
        if high < -negligible or not len(parts):
            break
    return float(min(low, lows.min(initial=np.inf))), float(high)


def _at_corners(nodes: Reals) -> Reals:
    """Jacobians (e, 4, 3, 3) of elements (e, 10, 3) at their corners: d position i / d local j."""
    gradients = quadratic_gradients(np.eye(4), TETRAHEDRON_EDGES)
    return np.einsum("eni,qnj->eqij", nodes, gradients, optimize=True)


def _coefficients(corners: Reals) -> Reals:
    """Bernstein-Bezier coefficients (e, 20) of the determinant, the corners' first."""
    first, second, third = (corners[..., j] for j in range(3))
    products = np.empty((len(corners), 3, 4, 4))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[:, i] = second[:, :, None, j] * third[:, None, :, k]
        products[:, i] -= second[:, :, None, k] * third[:, None, :, j]
    determinants = first @ products.reshape(-1, 3, 16)
    return determinants.reshape(-1, 64) @ AVERAGES


def _bounds(coefficients: Reals) -> tuple[Reals, Reals]:
    """The least coefficient and the least value at a corner, (e,) each."""
    return coefficients.min(axis=1), coefficients[:, :4].min(axis=1)


def _averages() -> Reals:
    """Shares (64, 20) of the determinants of triples of corners in the coefficients."""
    triples = [tuple(sorted(triple)) for triple in itertools.product(range(4), repeat=3)]
    order = sorted(set(triples), key=lambda triple: (len(set(triple)), triple))
    shares = np.array([[triple == key for key in order] for triple in triples], float)
    return shares / shares.sum(axis=0)


def _children() -> Reals:
    """Barycentric corners (8, 4, 4) of the eight parts that the middles of the edges make."""
    corners = np.eye(4)
    middles = (corners[:, None] + corners) / 2  # of corners a and b; a corner itself at a = b
    ring = middles[[0, 1, 2, 3], [1, 2, 3, 0]]  # around the diagonal of the octahedron inside
    inner = [[middles[0, 2], middles[1, 3], ring[k], ring[(k + 1) % 4]] for k in range(4)]
    return np.concatenate([middles, np.array(inner)])


AVERAGES = _averages()
CHILDREN = _children()
