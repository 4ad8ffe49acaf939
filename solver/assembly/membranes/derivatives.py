"""Derivatives of the virtual work of membranes by positions, reference and deformed.

Along a direction w the samples of the strain change by e'_m = sum of G_mab x_a . w_b, and the work
is e . D e'. It depends on the reference positions through e, e' and D, which is an integral of
functions of the metric A_ab = X,a . X,b: with P^ab = A^ac E_cd A^db of both strains,

    d tr E = -P^ab dA_ab,   d (E : E') = -(P E' A^-1 + A^-1 E' P)^ab dA_ab.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.membranes.membranes import SAMPLES, Membranes, from_first
from solver.assembly.membranes.stiffness import metrics, plane_stress
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.membranes import Membrane
from solver.problem.problem import Problem


def membrane_derivatives(
    problem: Problem, displacement: Reals, along: Reals
) -> tuple[Reals, Reals]:
    """Derivatives (n, 3) of the work along displacements ``along`` (n, 3), N.

    By the reference positions at fixed ``displacement`` (n, 3), and by the displacement.
    """
    by_position, by_displacement = np.zeros((2, *displacement.shape))
    for membrane in problem.membranes:
        films = Membranes.on(problem.mesh, membrane)
        moved, led = (from_first(v[films.triangles]) for v in (displacement, along))
        strains = films.strains(displacement)
        changes = np.einsum("kmai,kai->km", films.slopes(displacement), led)
        stress, change = films.worked(strains), films.worked(changes)
        through_strain = _pulled(change, moved) + _pulled(stress, led)
        through_metric = _by_metric(problem.mesh, membrane, strains, changes)
        np.add.at(by_position, films.triangles, through_strain + through_metric)
        deformed = films.reference + moved
        np.add.at(
            by_displacement, films.triangles, _pulled(change, deformed) + _pulled(stress, led)
        )
    return by_position, by_displacement


def _pulled(stress: Reals, vectors: Reals) -> Reals:
    """Sums (k, 6, 3) of stresses (k, m) times G and nodal vectors (k, 6, 3)."""
    pulled: Reals = np.einsum("km,mab,kbi->kai", stress, SAMPLES.forms, vectors, optimize=True)
    return pulled


def _by_metric(mesh: Mesh, membrane: Membrane, strains: Reals, changes: Reals) -> Reals:
    """Derivative (k, 6, 3) by the reference nodes at fixed samples (k, m) of both strains."""
    rule, triangles = triangle_rule(), mesh.triangles(membrane.surface)
    metric, inverse = metrics(mesh.nodes, triangles)
    one, other = (np.einsum("km,mqab->kqab", each, SAMPLES.basis) for each in (strains, changes))
    stress = plane_stress(membrane, inverse, one)
    density = np.einsum("kqab,kqab->kq", stress, other)[..., None, None]
    raised, other_raised = inverse @ one @ inverse, inverse @ other @ inverse
    trace, other_trace = (_trace(inverse, each)[..., None, None] for each in (one, other))
    nu = membrane.poisson_ratio
    shapes = raised @ other @ inverse
    slope = -nu * (trace * other_raised + other_trace * raised)
    slope -= (1 - nu) * (shapes + shapes.swapaxes(-1, -2))
    by_metric = density / 2 * inverse + membrane.stiffness / (1 - nu**2) * slope
    sizes = rule.weights * np.sqrt(np.linalg.det(metric))
    tangents = np.einsum("qad,kai->kqdi", rule.gradients, mesh.nodes[triangles])
    derivative: Reals = 2 * np.einsum(
        "kq,kqcd,qac,kqdi->kai", sizes, by_metric, rule.gradients, tangents, optimize=True
    )
    return derivative


def _trace(inverse: Reals, strain: Reals) -> Reals:
    """A^ab E_ab (k, q)."""
    trace: Reals = np.einsum("kqab,kqab->kq", inverse, strain)
    return trace
