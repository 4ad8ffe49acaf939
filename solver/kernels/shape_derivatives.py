"""Derivatives of a body's virtual work and stress by the positions of its nodes.

At fixed nodal values of displacement u and pressure q, a mesh velocity V with G = dV/dX changes
H = du/dX by -H G and a volume dv by tr(G) dv (``solver.sensitivity``). So the energy Pi of the
density psi, with P = d psi / dF, changes by the integral of Eshelby's tensor psi 1 - H^T P times G;
the virtual work of a direction (w, m), which is the derivative of Pi along it, by that of

    d psi 1 - L^T P - H^T dP,   L = dw/dX,   d psi = P : L - m (J - theta),

where dP is the derivative of P along the direction: (Lie derivative of tau + l tau) F^-T with
l = L F^-1. Source: J. D. Eshelby, J. Elasticity 5, 321, 1975; the directional derivative is ours.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from solver.arrays import Reals
from solver.kernels.element import (
    Solid,
    constants_of,
    displacement_gradient,
    reference_gradients,
    spatial_gradients,
)
from solver.kernels.hyperelastic import principal_response
from solver.kernels.tensors import (
    along_axes,
    deformation_gradient,
    invert,
    product,
    pulled_back,
    spectrum,
    volume_change,
)
from solver.material.volumetric import volume_law
from solver.numerics.compiled import compiled


@compiled()
def as_matrix(s: Reals, m: Reals) -> None:
    """m (3, 3) from s (6,) in the order xx, yy, zz, xy, yz, zx."""
    for i in range(3):
        j = (i + 1) % 3
        m[i, i] = s[i]
        m[i, j] = s[3 + i]
        m[j, i] = s[3 + i]


@compiled()
def to_axes_of_space(vectors: Reals, principal: Reals, m: Reals) -> None:
    """m (3, 3) with the eigenvalues ``principal`` (3,) and the eigenvectors in columns."""
    for i in range(3):
        for j in range(3):
            m[i, j] = 0.0
            for k in range(3):
                m[i, j] += principal[k] * vectors[i, k] * vectors[j, k]


@compiled(parallel=True)
def work_derivatives(
    solid: Solid,
    displacement: Reals,
    pressure: Reals,
    directions: Reals,
    pressure_directions: Reals,
    by_position: Reals,
    by_displacement: Reals,
) -> None:
    """Derivatives (r, e, 10, 3) of each element's virtual works by nodes and displacements, N.

    ``displacement`` (n, 3) and ``directions`` (r, n, 3), mm; ``pressure`` (v,) and its directions
    (r, v), MPa.
    """
    for element in prange(solid.tets.shape[0]):
        x, u, w = np.empty((10, 3)), np.empty((10, 3)), np.empty((10, 3))
        gradients, g = np.empty((10, 3)), np.empty((10, 3))
        h, f, inverse = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        b, vectors, turned = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        tau, rate = np.empty((3, 3)), np.empty((3, 3))
        change_w, velocity = np.empty((3, 3)), np.empty((3, 3))
        logs, stress, shear = np.empty(3), np.empty(3), np.empty(3)
        normal = np.empty((3, 3))
        for a in range(10):
            node = solid.tets[element, a]
            for i in range(3):
                x[a, i] = solid.nodes[node, i]
                u[a, i] = displacement[node, i]
        for r in range(directions.shape[0]):
            by_position[r, element, :, :] = 0.0
            by_displacement[r, element, :, :] = 0.0
        material = solid.material_of[element]
        law, constants = solid.law[material], constants_of(solid, material)
        compliance, logarithmic = solid.compliance[material], solid.logarithmic[material]
        for point in range(solid.weights.size):
            dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
            displacement_gradient(u, gradients, h)
            change = volume_change(h)
            deformation_gradient(h, f)
            invert(f, inverse)
            spatial_gradients(gradients, inverse, g)
            q = 0.0
            for v in range(4):
                q += solid.linear[point, v] * pressure[solid.tet_vertices[element, v]]
            spectrum(h, b, vectors, logs)
            principal_response(
                law, logs, b, -q * (1.0 + change), constants, stress, normal, shear,
            )  # fmt: skip
            to_axes_of_space(vectors, stress, tau)
            swelling, _ = volume_law(q, compliance, logarithmic)
            for r in range(directions.shape[0]):
                m = 0.0
                for v in range(4):
                    vertex = solid.tet_vertices[element, v]
                    m += solid.linear[point, v] * pressure_directions[r, vertex]
                for a in range(10):
                    for i in range(3):
                        w[a, i] = directions[r, solid.tets[element, a], i]
                displacement_gradient(w, gradients, change_w)
                product(change_w, inverse, velocity)
                along_axes(velocity, vectors, turned)
                _stress_rate(turned, vectors, normal, shear, -m * (1.0 + change), rate)
                density = m * (swelling - change)
                for i in range(3):
                    for j in range(3):
                        density += tau[i, j] * velocity[i, j]
                        for k in range(3):
                            rate[i, j] += velocity[i, k] * tau[k, j]
                places, moves = by_position[r, element], by_displacement[r, element]
                for a in range(10):
                    for i in range(3):
                        places[a, i] += dv * density * gradients[a, i]
                _add(g, dv, rate, h, places, moves, True)
                _add(g, dv, tau, change_w, places, moves, False)


@compiled()
def _stress_rate(
    turned: Reals, vectors: Reals, normal: Reals, shear: Reals, spherical: float, rate: Reals
) -> None:
    """Lie derivative (3, 3) of the stress along a velocity gradient ``turned`` to principal axes.

    ``normal`` and ``shear`` as ``principal_response`` fills them; ``spherical`` is added.
    """
    along, voigt = np.empty(3), np.empty(6)
    for i in range(3):
        along[i] = spherical
        for j in range(3):
            along[i] += normal[i, j] * turned[j, j]
    pulled_back(vectors, along, shear, turned, voigt)
    as_matrix(voigt, rate)


@compiled()
def _add(
    g: Reals,
    dv: float,
    spatial: Reals,
    h: Reals,
    by_position: Reals,
    by_displacement: Reals,
    moved: bool,
) -> None:
    """Add a stress ``spatial`` g_a to ``by_displacement`` if ``moved``, -h^T of it to the other."""
    force = np.empty(3)
    for a in range(g.shape[0]):
        for i in range(3):
            force[i] = spatial[i, 0] * g[a, 0] + spatial[i, 1] * g[a, 1] + spatial[i, 2] * g[a, 2]
            if moved:
                by_displacement[a, i] += dv * force[i]
        for k in range(3):
            pull = h[0, k] * force[0] + h[1, k] * force[1] + h[2, k] * force[2]
            by_position[a, k] -= dv * pull


@compiled(parallel=True)
def stress_derivatives(
    solid: Solid,
    displacement: Reals,
    weights: Reals,
    volume_weights: Reals,
    by_position: Reals,
    by_displacement: Reals,
) -> None:
    """Derivatives (e, 10, 3) of a weighted sum of deviatoric Cauchy stresses and volumes.

    ``weights`` (e, q, 6) of the stresses at the quadrature points in the order xx, yy, zz, xy, yz,
    zx, and ``volume_weights`` (e,) of the elements' reference volumes. With s = dev(tau) / J and
    the weights as a symmetric tensor a, the derivative of a : s along l = dF F^-1 is

        l : ((D : a + 2 a dev(tau)) / J - (a : s) 1),

    D being the tangent of dev(tau) in the sense of the Lie derivative, which has both symmetries.
    """
    for element in prange(solid.tets.shape[0]):
        x, u = np.empty((10, 3)), np.empty((10, 3))
        gradients, g = np.empty((10, 3)), np.empty((10, 3))
        h, f, inverse = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        b, vectors, turned = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        tau, given, whole, mixed = (
            np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3)),
        )  # fmt: skip
        logs, stress, shear = np.empty(3), np.empty(3), np.empty(3)
        normal, voigt = np.empty((3, 3)), np.empty(6)
        for a in range(10):
            node = solid.tets[element, a]
            for i in range(3):
                x[a, i] = solid.nodes[node, i]
                u[a, i] = displacement[node, i]
                by_position[element, a, i] = 0.0
                by_displacement[element, a, i] = 0.0
        material = solid.material_of[element]
        law, constants = solid.law[material], constants_of(solid, material)
        for point in range(solid.weights.size):
            dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
            displacement_gradient(u, gradients, h)
            deformation_gradient(h, f)
            jacobian = invert(f, inverse)
            spatial_gradients(gradients, inverse, g)
            spectrum(h, b, vectors, logs)
            principal_response(
                law, logs, b, 0.0, constants, stress, normal, shear,
            )  # fmt: skip
            for c in range(6):
                voigt[c] = weights[element, point, c] * (1.0 if c < 3 else 0.5)
            as_matrix(voigt, given)
            along_axes(given, vectors, turned)
            _stress_rate(turned, vectors, normal, shear, 0.0, whole)
            to_axes_of_space(vectors, stress, tau)
            product(given, tau, mixed)
            total = (mixed[0, 0] + mixed[1, 1] + mixed[2, 2]) / jacobian
            for i in range(3):
                for j in range(3):
                    whole[i, j] = (whole[i, j] + 2.0 * mixed[i, j]) / jacobian
                whole[i, i] -= total
            _add(g, 1.0, whole, h, by_position[element], by_displacement[element], True)
            for a in range(10):
                for i in range(3):
                    by_position[element, a, i] += volume_weights[element] * dv * gradients[a, i]
