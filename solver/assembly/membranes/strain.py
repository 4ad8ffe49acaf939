"""Strain of a six-node triangle in a membrane: sampled along its edges, linear in between.

The Green strain of a surface x(r, s) from its reference X(r, s) is, in the parameters,

    E_ab = (x,a . x,b - X,a . X,b) / 2,

quadratic over a six-node triangle. A film that hardly stretches would need all of it to vanish, and
triangles that bend cannot meet that many conditions: they lock. So it is replaced by its
interpolation among Regge elements of order one (M. Neunteufel, J. Schoeberl, Avoiding membrane
locking with Regge interpolation, CMAME 373, 2021, doi 10.1016/j.cma.2020.113524): with t the vector
of an edge in the parameters, t . E t is replaced by a linear function that agrees with it at two
Gauss points of the edge and in the mean over the triangle. Along an edge it is the same in both of
its triangles.

Each sample is a sum of t . E t over points, and so a quadratic form in the positions of the nodes:

    e_m = 1/2 sum over nodes a, b of G_mab (x_a . x_b - X_a . X_b).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.mesh.elements import TRIANGLE_EDGES, quadratic_gradients, triangle_rule

CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
EDGES = np.array([CORNERS[b] - CORNERS[a] for a, b in TRIANGLE_EDGES])
"""Vectors t of the edges in the parameters, (3, 2)."""

GAUSS = (1 + np.array([-1, 1]) / np.sqrt(3)) / 2


@dataclass(frozen=True)
class StrainSamples:
    """Samples of the strain, and the strain in between.

    ``forms`` (m, 6, 6): G; ``basis`` (m, q, 2, 2): what each sample is the factor of, tensors in
    the parameters at the points of ``triangle_rule``.
    """

    forms: Reals
    basis: Reals


def regge_samples() -> StrainSamples:
    """Nine samples: for each edge at its two Gauss points, and the mean over the triangle."""
    forms, basis = [], []
    for edge, dual in enumerate(dual_tensors(EDGES)):
        for points, weights, values in _along(edge):
            forms.append(strain_form(points, weights, EDGES[edge]))
            basis.append(values[:, None, None] * dual)
    return StrainSamples(np.array(forms), np.array(basis))


def _along(edge: int) -> list[tuple[Reals, Reals, Reals]]:
    """Samples of an edge: points (p, 3), weights (p,), and the linear function (q,) of each."""
    rule, (a, b) = triangle_rule(), TRIANGLE_EDGES[edge]
    opposite = rule.linear[:, 3 - a - b]
    points = np.zeros((2, 3))
    points[:, a], points[:, b] = 1 - GAUSS, GAUSS
    at_ends = np.linalg.inv(points[:, [a, b]])
    samples = [
        (points[[k]], np.ones(1), (rule.linear[:, [a, b]] - opposite[:, None]) @ at_ends[:, k])
        for k in range(2)
    ]
    return [*samples, (rule.linear, 2 * rule.weights, 3 * opposite)]


def strain_form(points: Reals, weights: Reals, vector: Reals) -> Reals:
    """G (6, 6) of a weighted sum of t . E t at ``points`` (p, 3), t being the ``vector`` (2,)."""
    along = quadratic_gradients(points, TRIANGLE_EDGES) @ vector
    form: Reals = np.einsum("p,pa,pb->ab", weights, along, along)
    return form


def dual_tensors(vectors: Reals) -> Reals:
    """Symmetric tensors T (3, 2, 2): t . T t is 1 for one of three vectors t, 0 for the others."""
    tensors = np.array([[[1, 0], [0, 0]], [[0, 0], [0, 1]], [[0, 1], [1, 0]]], float)
    values = np.einsum("mi,nij,mj->mn", vectors, tensors, vectors)
    duals: Reals = np.einsum("nm,nij->mij", np.linalg.inv(values), tensors)
    return duals
