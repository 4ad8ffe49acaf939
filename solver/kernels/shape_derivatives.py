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


@compiled(parallel=True)
def work_derivatives(
    solid: Solid,
    displacement: Reals,
    pressure: Reals,
    direction: Reals,
    pressure_direction: Reals,
    by_position: Reals,
    by_displacement: Reals,
) -> None:
    """Derivatives (e, 10, 3) of each element's virtual work by its nodes and displacements, N.

    ``displacement`` and ``direction`` (n, 3), mm; ``pressure`` and its direction (v,), MPa.
    """
    for element in prange(solid.tets.shape[0]):
        x, u, w = np.empty((10, 3)), np.empty((10, 3)), np.empty((10, 3))
        gradients, g = np.empty((10, 3)), np.empty((10, 3))
        h, f, inverse = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        b, vectors, turned = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        change_w, velocity = np.empty((3, 3)), np.empty((3, 3))
        tau, rate, product_rate = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
        logs, stress, lie, shear = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
        normal, voigt, none = np.empty((3, 3)), np.empty(6), np.zeros(3)
        for a in range(10):
            node = solid.tets[element, a]
            for i in range(3):
                x[a, i] = solid.nodes[node, i]
                u[a, i] = displacement[node, i]
                w[a, i] = direction[node, i]
                by_position[element, a, i] = 0.0
                by_displacement[element, a, i] = 0.0
        for point in range(solid.weights.size):
            dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
            displacement_gradient(u, gradients, h)
            displacement_gradient(w, gradients, change_w)
            deformation_gradient(h, f)
            invert(f, inverse)
            spatial_gradients(gradients, inverse, g)
            product(change_w, inverse, velocity)
            change = volume_change(h)
            q, m = 0.0, 0.0
            for v in range(4):
                vertex = solid.tet_vertices[element, v]
                q += solid.linear[point, v] * pressure[vertex]
                m += solid.linear[point, v] * pressure_direction[vertex]
            spectrum(h, b, vectors, logs)
            principal_response(
                solid.law, logs, b, -q * (1.0 + change), solid.constants, stress, normal, shear,
            )  # fmt: skip
            along_axes(velocity, vectors, turned)
            for i in range(3):
                lie[i] = -m * (1.0 + change)
                for j in range(3):
                    lie[i] += normal[i, j] * turned[j, j]
            pulled_back(vectors, stress, none, turned, voigt)
            as_matrix(voigt, tau)
            pulled_back(vectors, lie, shear, turned, voigt)
            as_matrix(voigt, rate)
            product(velocity, tau, product_rate)
            swelling, _ = volume_law(q, solid.compliance, solid.logarithmic)
            density = m * (swelling - change)
            for i in range(3):
                for j in range(3):
                    rate[i, j] += product_rate[i, j]
                    density += tau[i, j] * velocity[i, j]
            for a in range(10):
                for i in range(3):
                    by_position[element, a, i] += dv * density * gradients[a, i]
            _add(gradients, g, dv, rate, h, by_position[element], by_displacement[element], True)
            _add(gradients, g, dv, tau, change_w, by_position[element], by_displacement[element],
                 False)  # fmt: skip


@compiled()
def _add(
    gradients: Reals,
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
    for a in range(gradients.shape[0]):
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
        logs, stress, along, shear = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
        normal, voigt, none = np.empty((3, 3)), np.empty(6), np.zeros(3)
        for a in range(10):
            node = solid.tets[element, a]
            for i in range(3):
                x[a, i] = solid.nodes[node, i]
                u[a, i] = displacement[node, i]
                by_position[element, a, i] = 0.0
                by_displacement[element, a, i] = 0.0
        for point in range(solid.weights.size):
            dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
            displacement_gradient(u, gradients, h)
            deformation_gradient(h, f)
            jacobian = invert(f, inverse)
            spatial_gradients(gradients, inverse, g)
            spectrum(h, b, vectors, logs)
            principal_response(
                solid.law, logs, b, 0.0, solid.constants, stress, normal, shear,
            )  # fmt: skip
            for c in range(6):
                voigt[c] = weights[element, point, c] * (1.0 if c < 3 else 0.5)
            as_matrix(voigt, given)
            along_axes(given, vectors, turned)
            for i in range(3):
                along[i] = 0.0
                for j in range(3):
                    along[i] += normal[i, j] * turned[j, j]
            pulled_back(vectors, along, shear, turned, voigt)
            as_matrix(voigt, whole)
            pulled_back(vectors, stress, none, turned, voigt)
            as_matrix(voigt, tau)
            product(given, tau, mixed)
            total = (mixed[0, 0] + mixed[1, 1] + mixed[2, 2]) / jacobian
            for i in range(3):
                for j in range(3):
                    whole[i, j] = (whole[i, j] + 2.0 * mixed[i, j]) / jacobian
                whole[i, i] -= total
            _add(gradients, g, 1.0, whole, h, by_position[element], by_displacement[element], True)
            for a in range(10):
                for i in range(3):
                    by_position[element, a, i] += volume_weights[element] * dv * gradients[a, i]
