"""A ten-node tetrahedron with a linear hydrostatic pressure: energy, residual, tangent.

Energy of the mixed form, with the hydrostatic pressure q (positive in compression) as a field:

    Pi(u, q) = integral of  W(e) - q (J - 1) + G(q)

where e_i = ln(lambda_i) - ln(J) / 3 are the isochoric principal log stretches, and G the Legendre
transform of the volumetric energy U: its derivative is G' = theta(q) - 1, with U'(theta) = -q, so
that q enforces J = theta(q). Incompressible means theta = 1 and G = 0 (1 / K = 0). Residual and
tangent are the first and second derivatives of Pi, so the tangent is symmetric. All is computed
from the displacement gradient H and the spectrum of b - 1 = H + H^T + H H^T, so that small strains
keep full relative precision.

Local numbering of an element's 34 unknowns: 3 a + i for displacement i of node a, 30 + k for the
pressure of vertex k.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.kernels.hyperelastic import principal_response
from solver.kernels.tensors import (
    deformation_gradient,
    invert,
    push_forward,
    spectrum,
    to_global_axes,
    volume_change,
)
from solver.material.by_number import law_energy
from solver.material.volumetric import volume_energy, volume_law
from solver.numerics.compiled import compiled

UNKNOWNS = 34


class Solid(NamedTuple):
    """Mesh, materials and quadrature of a body, as arrays for the kernels.

    ``nodes`` (n, 3), ``tets`` (e, 10), ``tet_vertices`` (e, 4) in the numbering of pressures;
    number of each element's material, ``material_of`` (e,); of each material its ``law`` (m,) in
    the table of laws, its constants from ``offsets[m]`` to ``offsets[m + 1]`` in ``constants``
    (c,), ``compliance`` (m,) = 1 / K and whether the volumetric law is the ``logarithmic`` one
    (m,); at the q quadrature points the ``gradients`` (q, 10, 3) of the quadratic shape functions
    with respect to (r, s, t), the values of the ``linear`` ones (q, 4), and ``weights`` (q,).
    """

    nodes: Reals
    tets: Integers
    tet_vertices: Integers
    material_of: Integers
    law: Integers
    constants: Reals
    offsets: Integers
    compliance: Reals
    logarithmic: NDArray[np.bool_]
    gradients: Reals
    linear: Reals
    weights: Reals


@compiled()
def constants_of(solid: Solid, material: int) -> Reals:
    """The constants that a material's law takes."""
    return solid.constants[solid.offsets[material] : solid.offsets[material + 1]]


@compiled()
def reference_gradients(x: Reals, local_gradients: Reals, gradients: Reals) -> float:
    """Shape gradients (10, 3) on the reference body at one point; returns det(dX / dr).

    ``x`` (10, 3) node coordinates, ``local_gradients`` (10, 3) with respect to (r, s, t).
    """
    m = np.zeros((3, 3))  # m[i, j] = dX_j / dr_i
    for a in range(10):
        for i in range(3):
            for j in range(3):
                m[i, j] += local_gradients[a, i] * x[a, j]
    inverse = np.empty((3, 3))
    determinant = invert(m, inverse)
    for a in range(10):
        for j in range(3):
            gradients[a, j] = (
                inverse[j, 0] * local_gradients[a, 0]
                + inverse[j, 1] * local_gradients[a, 1]
                + inverse[j, 2] * local_gradients[a, 2]
            )
    return determinant


@compiled()
def displacement_gradient(u: Reals, gradients: Reals, h: Reals) -> None:
    """h (3, 3) = du_i / dX_j from node displacements u (10, 3)."""
    for i in range(3):
        for j in range(3):
            h[i, j] = 0.0
            for a in range(10):
                h[i, j] += u[a, i] * gradients[a, j]


@compiled()
def spatial_gradients(gradients: Reals, inverse: Reals, g: Reals) -> None:
    """Shape gradients g (10, 3) on the deformed body: ``gradients`` times F^-1."""
    for a in range(10):
        for i in range(3):
            g[a, i] = (
                gradients[a, 0] * inverse[0, i]
                + gradients[a, 1] * inverse[1, i]
                + gradients[a, 2] * inverse[2, i]
            )


@compiled()
def element_energy(
    solid: Solid, material: int, x: Reals, u: Reals, q: Reals
) -> tuple[float, float]:
    """Pi of one element of a material, N mm, and its volume, mm^3; NaN where J <= 0."""
    law, constants = solid.law[material], constants_of(solid, material)
    compliance, logarithmic = solid.compliance[material], solid.logarithmic[material]
    gradients = np.empty((10, 3))
    h = np.empty((3, 3))
    b = np.empty((3, 3))
    vectors = np.empty((3, 3))
    logs = np.empty(3)
    energy = 0.0
    volume = 0.0
    for point in range(solid.weights.size):
        dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
        displacement_gradient(u, gradients, h)
        spectrum(h, b, vectors, logs)
        pressure = 0.0
        for k in range(4):
            pressure += solid.linear[point, k] * q[k]
        change = volume_change(h)
        if change <= -1.0:
            return np.nan, np.nan
        density = law_energy(law, logs, constants) - pressure * change
        energy += dv * (density + volume_energy(pressure, compliance, logarithmic))
        volume += dv
    return energy, volume


@compiled()
def element_response(
    solid: Solid,
    material: int,
    x: Reals,
    u: Reals,
    q: Reals,
    geometric: Reals,
    tangent: bool,
    r: Reals,
    k: Reals,
) -> float:
    """Residual r (34,) and, if ``tangent``, the upper half of the tangent k (34, 34).

    Of an element of a ``material``, by its number.
    ``x``, ``u`` (10, 3) reference coordinates and displacements, mm; ``q`` (4,) pressures, MPa.
    ``geometric`` (points, 6): second Piola-Kirchhoff stress of the geometric part of the tangent,
    MPa, or (0, 6) for the element's own. Returns the smallest J of the quadrature points; unless
    it is positive r and k are meaningless.
    """
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
    tau = np.empty(6)
    stiffness = np.empty((6, 6))
    law, constants = solid.law[material], constants_of(solid, material)
    compliance, logarithmic = solid.compliance[material], solid.logarithmic[material]
    r[:] = 0.0
    if tangent:
        k[:, :] = 0.0
    smallest = np.inf
    for point in range(solid.weights.size):
        dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
        displacement_gradient(u, gradients, h)
        change = volume_change(h)
        jacobian = 1.0 + change
        if not jacobian > 0.0:
            return jacobian
        smallest = min(smallest, jacobian)
        deformation_gradient(h, f)
        invert(f, inverse)
        spatial_gradients(gradients, inverse, g)
        pressure = 0.0
        for v in range(4):
            pressure += solid.linear[point, v] * q[v]
        spectrum(h, b, vectors, logs)
        principal_response(
            law, logs, b, -pressure * jacobian, constants, stress, normal, shear,
        )  # fmt: skip
        to_global_axes(vectors, stress, normal, shear, tau, stiffness)
        _add_forces(g, tau, dv, r)
        swelling, flexibility = volume_law(pressure, compliance, logarithmic)
        for v in range(4):
            r[30 + v] -= dv * solid.linear[point, v] * (change - swelling)
        if tangent:
            if geometric.shape[0] > 0:
                push_forward(f, geometric[point], tau)
            _add_displacement_tangent(g, tau, stiffness, dv, k)
            _add_pressure_tangent(g, solid.linear[point], dv * jacobian, dv * flexibility, k)
    return smallest


@compiled()
def stress_forces(solid: Solid, x: Reals, u: Reals, geometric: Reals, forces: Reals) -> None:
    """First 30 of ``forces`` (m,): nodal forces of a second Piola-Kirchhoff stress, the rest 0.

    ``x``, ``u`` (10, 3) and ``geometric`` (points, 6) as for ``element_response``.
    """
    gradients, h, f = np.empty((10, 3)), np.empty((3, 3)), np.empty((3, 3))
    inverse, g, tau = np.empty((3, 3)), np.empty((10, 3)), np.empty(6)
    forces[:] = 0.0
    for point in range(solid.weights.size):
        dv = solid.weights[point] * reference_gradients(x, solid.gradients[point], gradients)
        displacement_gradient(u, gradients, h)
        deformation_gradient(h, f)
        invert(f, inverse)
        spatial_gradients(gradients, inverse, g)
        push_forward(f, geometric[point], tau)
        _add_forces(g, tau, dv, forces)


@compiled()
def _add_forces(g: Reals, tau: Reals, dv: float, r: Reals) -> None:
    """Nodal forces of a Kirchhoff stress at one point."""
    for a in range(10):
        r[3 * a] += dv * (tau[0] * g[a, 0] + tau[3] * g[a, 1] + tau[5] * g[a, 2])
        r[3 * a + 1] += dv * (tau[3] * g[a, 0] + tau[1] * g[a, 1] + tau[4] * g[a, 2])
        r[3 * a + 2] += dv * (tau[5] * g[a, 0] + tau[4] * g[a, 1] + tau[2] * g[a, 2])


@compiled()
def _add_displacement_tangent(g: Reals, tau: Reals, stiffness: Reals, dv: float, k: Reals) -> None:
    """Material part B_a^T D B_b and geometric part (g_a . tau g_b) 1, for b >= a."""
    for b in range(10):
        x, y, z = dv * g[b, 0], dv * g[b, 1], dv * g[b, 2]
        tx = tau[0] * x + tau[3] * y + tau[5] * z
        ty = tau[3] * x + tau[1] * y + tau[4] * z
        tz = tau[5] * x + tau[4] * y + tau[2] * z
        for i in range(3):
            # one column of D B_b
            p, q, s = i, 3 + i, 3 + (i + 2) % 3
            gi, gq, gs = g[b, i] * dv, g[b, (i + 1) % 3] * dv, g[b, (i + 2) % 3] * dv
            c0 = stiffness[0, p] * gi + stiffness[0, q] * gq + stiffness[0, s] * gs
            c1 = stiffness[1, p] * gi + stiffness[1, q] * gq + stiffness[1, s] * gs
            c2 = stiffness[2, p] * gi + stiffness[2, q] * gq + stiffness[2, s] * gs
            c3 = stiffness[3, p] * gi + stiffness[3, q] * gq + stiffness[3, s] * gs
            c4 = stiffness[4, p] * gi + stiffness[4, q] * gq + stiffness[4, s] * gs
            c5 = stiffness[5, p] * gi + stiffness[5, q] * gq + stiffness[5, s] * gs
            column = 3 * b + i
            for a in range(b + 1):
                ax, ay, az = g[a, 0], g[a, 1], g[a, 2]
                k[3 * a, column] += ax * c0 + ay * c3 + az * c5
                k[3 * a + 1, column] += ay * c1 + ax * c3 + az * c4
                k[3 * a + 2, column] += az * c2 + ay * c4 + ax * c5
                k[3 * a + i, column] += ax * tx + ay * ty + az * tz


@compiled()
def _add_pressure_tangent(
    g: Reals, linear: Reals, jacobian_dv: float, flexibility_dv: float, k: Reals
) -> None:
    """Coupling -J g_a N_k and, for a finite bulk modulus, theta'(q) N_k N_l."""
    for v in range(4):
        factor = jacobian_dv * linear[v]
        for a in range(10):
            for i in range(3):
                k[3 * a + i, 30 + v] -= factor * g[a, i]
        for w in range(v, 4):
            k[30 + v, 30 + w] -= flexibility_dv * linear[v] * linear[w]
