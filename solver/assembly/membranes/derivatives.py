"""Derivatives of the virtual work of membranes by positions, reference and deformed.

Along a direction w the samples of the strain change by e'_m = sum of G_mab x_a . w_b, and the work
is s . e'. It depends on the reference positions through e, e' and the metric A_ab = X,a . X,b. A
change dA of that one changes the components of strains in an orthonormal frame by -(dA E + E dA) /
2, up to a rotation, which an isotropic law does not see; so that with the stress S(E) and its
change S' along E'

    d (S : E') = -(S' E + S E') : dA.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.membranes import tension_field
from solver.assembly.membranes.membranes import SAMPLES, Membranes, from_first
from solver.assembly.membranes.response import as_tensors, frames, metrics
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
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
        stress = films.stresses(strains)
        change = np.einsum("kmn,kn->km", films.stiffness(strains), changes)
        through_strain = _pulled(change, moved) + _pulled(stress, led)
        through_metric = _by_metric(problem.mesh, films, strains, changes)
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


def _by_metric(mesh: Mesh, films: Membranes, strains: Reals, changes: Reals) -> Reals:
    """Derivative (k, 6, 3) by the reference nodes at fixed samples (k, m) of both strains."""
    rule, nodes = triangle_rule(), mesh.nodes[films.triangles]
    (film,) = films.responses
    metric, inverse = metrics(mesh.nodes, films.triangles)
    frame = frames(metric)
    one, other = film.strain(strains), film.strain(changes)
    stress = tension_field.stress(film.membrane, one)
    change = np.einsum("kqcd,kqd->kqc", tension_field.stiffness(film.membrane, one), other)
    density = (stress * other).sum(axis=-1)[..., None, None]
    product = as_tensors(change) @ as_tensors(one) + as_tensors(stress) @ as_tensors(other)
    shrinking = (product + product.swapaxes(-1, -2)) / 2
    by_metric = density / 2 * inverse - frame @ shrinking @ frame.swapaxes(-1, -2)
    tangents = np.einsum("qad,kai->kqdi", rule.gradients, nodes)
    derivative: Reals = 2 * np.einsum(
        "kq,kqcd,qac,kqdi->kai", film.sizes, by_metric, rule.gradients, tangents, optimize=True
    )
    return derivative
