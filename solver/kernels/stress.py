"""Stress at the quadrature points of all elements."""

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
from solver.material.by_number import law_response
from solver.numerics.compiled import compiled


@compiled(parallel=True)
def extrapolated_stress(
    solid: Solid,
    displacement: Reals,
    pressure: Reals,
    displacement_step: Reals,
    pressure_step: Reals,
    extrapolated: Reals,
) -> None:
    """Second Piola-Kirchhoff stress after a step, to first order in it, (e, q, 6), MPa.

    At the quadrature points, Voigt order xx, yy, zz, xy, yz, zx: S + dS, where F dS F^T is the
    Lie derivative of the Kirchhoff stress, D : sym(grad du) - J dq 1.
    """
    for element in prange(solid.tets.shape[0]):
        x = np.empty((10, 3))
        u = np.empty((10, 3))
        du = np.empty((10, 3))
        gradients = np.empty((10, 3))
        g = np.empty((10, 3))
        h = np.empty((3, 3))
        f = np.empty((3, 3))
        inverse = np.empty((3, 3))
        b = np.empty((3, 3))
        vectors = np.empty((3, 3))
        logs = np.empty(3)
        stress = np.empty(3)
        normal = np.empty((3, 3))
        shear = np.empty(3)
        rate = np.empty((3, 3))
        turned = np.empty((3, 3))
        axes = np.empty((3, 3))
        for a in range(10):
            for i in range(3):
                x[a, i] = solid.nodes[solid.tets[element, a], i]
                u[a, i] = displacement[solid.tets[element, a], i]
                du[a, i] = displacement_step[solid.tets[element, a], i]
        material = solid.material_of[element]
        law, constants = solid.law[material], constants_of(solid, material)
        for point in range(solid.weights.size):
            reference_gradients(x, solid.gradients[point], gradients)
            displacement_gradient(u, gradients, h)
            jacobian = 1.0 + volume_change(h)
            deformation_gradient(h, f)
            invert(f, inverse)
            spatial_gradients(gradients, inverse, g)
            q = 0.0
            dq = 0.0
            for v in range(4):
                q += solid.linear[point, v] * pressure[solid.tet_vertices[element, v]]
                dq += solid.linear[point, v] * pressure_step[solid.tet_vertices[element, v]]
            spectrum(h, b, vectors, logs)
            principal_response(
                law, logs, b, -q * jacobian, constants, stress, normal, shear,
            )  # fmt: skip
            displacement_gradient(du, g, rate)
            along_axes(rate, vectors, turned)
            for i in range(3):
                stress[i] -= dq * jacobian
                for j in range(3):
                    stress[i] += normal[i, j] * turned[j, j]
            product(inverse, vectors, axes)
            pulled_back(axes, stress, shear, turned, extrapolated[element, point])


@compiled(parallel=True)
def deviatoric_stress(solid: Solid, displacement: Reals, stress: Reals, dv: Reals) -> None:
    """Deviatoric Cauchy stress at the quadrature points into ``stress`` (e, q, 6), MPa.

    Voigt order xx, yy, zz, xy, yz, zx. ``dv`` (e, q) takes the reference volumes of the points,
    mm^3.
    """
    for element in prange(solid.tets.shape[0]):
        x = np.empty((10, 3))
        u = np.empty((10, 3))
        gradients = np.empty((10, 3))
        h = np.empty((3, 3))
        b = np.empty((3, 3))
        vectors = np.empty((3, 3))
        logs = np.empty(3)
        gaps = np.zeros(3)
        principal = np.empty(3)
        hessian = np.empty((3, 3))
        divided = np.empty(3)
        for a in range(10):
            for i in range(3):
                x[a, i] = solid.nodes[solid.tets[element, a], i]
                u[a, i] = displacement[solid.tets[element, a], i]
        material = solid.material_of[element]
        law, constants = solid.law[material], constants_of(solid, material)
        for point in range(solid.weights.size):
            determinant = reference_gradients(x, solid.gradients[point], gradients)
            dv[element, point] = determinant * solid.weights[point]
            displacement_gradient(u, gradients, h)
            spectrum(h, b, vectors, logs)
            law_response(law, logs, gaps, constants, principal, hessian, divided)
            mean = (principal[0] + principal[1] + principal[2]) / 3.0
            jacobian = 1.0 + volume_change(h)
            for c in range(6):
                p = c if c < 3 else c - 3
                s = c if c < 3 else (c - 2) % 3
                total = 0.0
                for i in range(3):
                    total += (principal[i] - mean) * vectors[p, i] * vectors[s, i]
                stress[element, point, c] = total / jacobian
