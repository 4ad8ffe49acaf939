"""Compiled kernels of the solid: spectral Ogden and Yeoh response and element loops.

One file on purpose: numba's cache notices changes of a function's own file only, so a leaf kept
elsewhere could leave a stale kernel behind.

Energy of the mixed form, with the hydrostatic pressure q (positive in compression) as a field:

    Pi(u, q) = integral of  W(e) - q (J - 1) + G(q)

where e_i = ln(lambda_i) - ln(J) / 3 are the isochoric principal log stretches, and G the Legendre
transform of the volumetric energy U: its derivative is G' = theta(q) - 1, with U'(theta) = -q, so
that q enforces J = theta(q). Incompressible means theta = 1 and G = 0 (1 / K = 0). Residual and
tangent are the first and second derivatives of Pi, so the tangent is symmetric. Everything starts
from the displacement gradient H and the spectrum of b - 1 = H + H^T + H H^T, so that small strains
keep full relative precision.

Ogden in Abaqus's form, W = sum 2 mu / alpha^2 (sum_i exp(alpha e_i) - 3), is evaluated with
phi1(x) = expm1(x) / x and phi2(x) = (exp(x) - 1 - x) / x^2, which need no switch at equal
stretches nor at alpha -> 0 (Hencky). Yeoh's terms sum C_i0 (I1 - 3)^i of order i >= 2 have the
first and second derivatives W' and W'' by I1. They act as an Ogden term of mu = 2 W' and
alpha = 2 whose mu depends on the strain, which adds 4 W'' l_i^2 l_j^2, of rank one, to the
derivatives of the stress.

Local numbering of an element's 34 unknowns: 3 a + i for displacement i of node a, 30 + k for the
pressure of vertex k.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit, prange

from solver.arrays import Integers, Reals

UNKNOWNS = 34


class Solid(NamedTuple):
    """A meshed body as the kernels see it.

    ``nodes`` (n, 3), ``tets`` (e, 10), ``tet_vertices`` (e, 4) in the numbering of pressures;
    Ogden's ``mu`` and ``alpha`` (terms,), Yeoh's ``higher`` = C20, C30, ... (orders,),
    ``compliance`` = 1 / K and whether the volumetric law is the ``logarithmic`` one; at the q
    quadrature points the ``gradients`` (q, 10, 3) of the quadratic shape functions with respect to
    (r, s, t), the values of the ``linear`` ones (q, 4), and ``weights`` (q,).
    """

    nodes: Reals
    tets: Integers
    tet_vertices: Integers
    mu: Reals
    alpha: Reals
    higher: Reals
    compliance: float
    logarithmic: bool
    gradients: Reals
    linear: Reals
    weights: Reals


class Places(NamedTuple):
    """Where elements are added in, and in which order.

    Chunk c has the elements ``order[chunks[c]:chunks[c + 1]]``; chunks ``colours[k]`` to
    ``colours[k + 1]`` share no node, so they can be added in parallel. ``dofs`` (e, 34) and
    ``entries`` (e, 595) are the places in the residual and in the CSR values, -1 where an unknown
    is prescribed.
    """

    order: Integers
    chunks: Integers
    colours: Integers
    dofs: Integers
    entries: Integers


@njit(cache=True, error_model="numpy")
def phi1(x: float) -> float:
    """(exp(x) - 1) / x, 1 at 0."""
    return math.expm1(x) / x if x != 0.0 else 1.0


@njit(cache=True, error_model="numpy")
def phi2(x: float) -> float:
    """(exp(x) - 1 - x) / x^2, 1/2 at 0; by its series where the difference would cancel."""
    if abs(x) >= 0.5:
        return (math.expm1(x) - x) / (x * x)
    total = 0.5
    term = 0.5
    for k in range(3, 18):
        term *= x / k
        total += term
    return total


@njit(cache=True, error_model="numpy")
def sinhc(x: float) -> float:
    """sinh(x) / x, 1 at 0."""
    return math.sinh(x) / x if x != 0.0 else 1.0


@njit(cache=True, error_model="numpy")
def x_coth_x(x: float) -> float:
    """x coth(x), 1 at 0."""
    return x / math.tanh(x) if x != 0.0 else 1.0


@njit(cache=True, error_model="numpy")
def ogden_energy(e: Reals, mu: Reals, alpha: Reals) -> float:
    """W of isochoric log stretches e (3,): sum 2 mu sum_i e_i^2 phi2(alpha e_i), MPa."""
    energy = 0.0
    for k in range(mu.size):
        for i in range(3):
            energy += 2.0 * mu[k] * e[i] * e[i] * phi2(alpha[k] * e[i])
    return energy


@njit(cache=True, error_model="numpy")
def ogden_stress(e: Reals, mu: Reals, alpha: Reals, stress: Reals) -> None:
    """Undeviated principal Kirchhoff stresses sum 2 mu e_i phi1(alpha e_i) into ``stress``."""
    for i in range(3):
        stress[i] = 0.0
        for k in range(mu.size):
            stress[i] += 2.0 * mu[k] * e[i] * phi1(alpha[k] * e[i])


@njit(cache=True, error_model="numpy")
def ogden_stiffness(e: Reals, mu: Reals, alpha: Reals, stiffness: Reals) -> None:
    """Derivatives of ``ogden_stress`` with respect to e_i, sum 2 mu exp(alpha e_i)."""
    for i in range(3):
        stiffness[i] = 0.0
        for k in range(mu.size):
            stiffness[i] += 2.0 * mu[k] * math.exp(alpha[k] * e[i])


@njit(cache=True, error_model="numpy")
def divided_stress(mean: float, gap: float, mu: Reals, alpha: Reals) -> float:
    """(tau_i - tau_j) / (e_i - e_j) from the mean and the gap of e_i and e_j, exact at gap 0."""
    total = 0.0
    for k in range(mu.size):
        total += 2.0 * mu[k] * math.exp(alpha[k] * mean) * sinhc(0.5 * alpha[k] * gap)
    return total


@njit(cache=True, error_model="numpy")
def first_invariant(e: Reals) -> float:
    """I1 - 3 of isochoric log stretches e (3,), without cancellation: sum 4 e_i^2 phi2(2 e_i)."""
    total = 0.0
    for i in range(3):
        total += 4.0 * e[i] * e[i] * phi2(2.0 * e[i])
    return total


@njit(cache=True, error_model="numpy")
def higher_energy(e: Reals, higher: Reals) -> float:
    """Yeoh's sum C_i0 (I1 - 3)^i over i >= 2, MPa."""
    if higher.size == 0:
        return 0.0
    x = first_invariant(e)
    total = 0.0
    for k in range(higher.size - 1, -1, -1):
        total = total * x + higher[k]
    return total * x * x


@njit(cache=True, error_model="numpy")
def higher_moduli(e: Reals, higher: Reals) -> tuple[float, float]:
    """2 W' and 4 W'' of ``higher_energy``, derivatives by I1; MPa."""
    if higher.size == 0:
        return 0.0, 0.0
    x = first_invariant(e)
    first = 0.0
    second = 0.0
    for k in range(higher.size - 1, -1, -1):
        first = first * x + (k + 2) * higher[k]
        second = second * x + (k + 2) * (k + 1) * higher[k]
    return 2.0 * first * x, 4.0 * second


@njit(cache=True, error_model="numpy")
def undeviated_stress(e: Reals, mu: Reals, alpha: Reals, modulus: float, stress: Reals) -> None:
    """``ogden_stress`` with the higher terms' 2 W' = ``modulus`` as a term of alpha = 2."""
    ogden_stress(e, mu, alpha, stress)
    if modulus != 0.0:
        for i in range(3):
            stress[i] += 2.0 * modulus * e[i] * phi1(2.0 * e[i])


@njit(cache=True, error_model="numpy")
def add_rank_one(e: Reals, factor: float, normal: Reals) -> None:
    """Add ``factor`` times d_i d_j to ``normal`` (3, 3), d the deviator of the l_i^2."""
    squares = np.empty(3)
    mean = 0.0
    for i in range(3):
        squares[i] = 2.0 * e[i] * phi1(2.0 * e[i])
        mean += squares[i] / 3.0
    for i in range(3):
        for j in range(3):
            normal[i, j] += factor * (squares[i] - mean) * (squares[j] - mean)


@njit(cache=True, error_model="numpy")
def volume_law(q: float, compliance: float, logarithmic: bool) -> tuple[float, float]:
    """theta(q) - 1 and -theta'(q), 1/MPa, of the volumetric law; see ``volume_energy``."""
    if not logarithmic:
        return -compliance * q, compliance
    a = math.asinh(compliance * q)
    return math.expm1(-a), compliance * math.exp(-a) / math.cosh(a)


@njit(cache=True, error_model="numpy")
def volume_energy(q: float, compliance: float, logarithmic: bool) -> float:
    """G(q) = U(theta) + q (theta - 1), MPa.

    Quadratic, U = K (J - 1)^2 / 2: theta = 1 - q / K and G = -q^2 / (2 K). Logarithmic,
    U = K (J^2 - 1 - 2 ln J) / 4: theta = exp(-a) with sinh a = q / K, and
    G = K a^2 (phi2(-2 a) - sinhc(a) phi1(-a)).
    """
    if not logarithmic:
        return -0.5 * compliance * q * q
    a = math.asinh(compliance * q)
    return q * a * (phi2(-2.0 * a) / sinhc(a) - phi1(-a))


@njit(cache=True, error_model="numpy")
def shear_stiffness(divided: float, gap: float, stress_sum: float) -> float:
    """(tau_i l_j^2 - tau_j l_i^2) / (l_i^2 - l_j^2), l = stretches with log gap ``gap``."""
    return 0.5 * divided * x_coth_x(gap) - 0.5 * stress_sum


@njit(cache=True, error_model="numpy")
def jacobi(a: Reals, vectors: Reals) -> None:
    """Eigenvalues of the symmetric (3, 3) ``a``, left on its diagonal; ``vectors`` in columns.

    Cyclic Jacobi rotations until the rest is negligible against rounding; equal eigenvalues need
    no special care.
    """
    for i in range(3):
        for j in range(3):
            vectors[i, j] = 1.0 if i == j else 0.0
    for _ in range(20):
        rest = abs(a[0, 1]) + abs(a[0, 2]) + abs(a[1, 2])
        if not rest > 1e-18 * (abs(a[0, 0]) + abs(a[1, 1]) + abs(a[2, 2])):
            return
        for p in range(2):
            for q in range(p + 1, 3):
                if a[p, q] == 0.0:
                    continue
                ratio = 0.5 * (a[q, q] - a[p, p]) / a[p, q]
                t = math.copysign(1.0, ratio) / (abs(ratio) + math.hypot(1.0, ratio))
                c = 1.0 / math.sqrt(1.0 + t * t)
                s = t * c
                shift = t * a[p, q]
                a[p, p] -= shift
                a[q, q] += shift
                a[p, q] = 0.0
                a[q, p] = 0.0
                r = 3 - p - q
                rp = c * a[r, p] - s * a[r, q]
                rq = s * a[r, p] + c * a[r, q]
                a[r, p] = rp
                a[p, r] = rp
                a[r, q] = rq
                a[q, r] = rq
                for i in range(3):
                    vp = c * vectors[i, p] - s * vectors[i, q]
                    vectors[i, q] = s * vectors[i, p] + c * vectors[i, q]
                    vectors[i, p] = vp


@njit(cache=True, error_model="numpy")
def volume_change(h: Reals) -> float:
    """J - 1 from the displacement gradient h (3, 3), without cancellation at small strain."""
    trace = h[0, 0] + h[1, 1] + h[2, 2]
    minors = (
        h[0, 0] * h[1, 1] - h[0, 1] * h[1, 0]
        + h[1, 1] * h[2, 2] - h[1, 2] * h[2, 1]
        + h[2, 2] * h[0, 0] - h[2, 0] * h[0, 2]
    )  # fmt: skip
    determinant = (
        h[0, 0] * (h[1, 1] * h[2, 2] - h[1, 2] * h[2, 1])
        - h[0, 1] * (h[1, 0] * h[2, 2] - h[1, 2] * h[2, 0])
        + h[0, 2] * (h[1, 0] * h[2, 1] - h[1, 1] * h[2, 0])
    )
    return trace + minors + determinant


@njit(cache=True, error_model="numpy")
def spectrum(h: Reals, b: Reals, vectors: Reals, logs: Reals) -> None:
    """Principal axes of b = (1 + h)(1 + h)^T and isochoric log stretches.

    Leaves the eigenvalues of b - 1 on the diagonal of the scratch ``b``, the principal axes in the
    columns of ``vectors`` and e_i in ``logs``.
    """
    for i in range(3):
        for j in range(3):
            b[i, j] = h[i, j] + h[j, i]
            for k in range(3):
                b[i, j] += h[i, k] * h[j, k]
    jacobi(b, vectors)
    mean = 0.0
    for i in range(3):
        logs[i] = 0.5 * math.log1p(b[i, i])
        mean += logs[i] / 3.0
    for i in range(3):
        logs[i] -= mean


@njit(cache=True, error_model="numpy")
def principal_response(
    logs: Reals,
    b: Reals,
    spherical: float,
    mu: Reals,
    alpha: Reals,
    higher: Reals,
    stress: Reals,
    normal: Reals,
    shear: Reals,
) -> None:
    """Kirchhoff stress and its spatial tangent in principal axes.

    ``logs`` and the diagonal of ``b`` as ``spectrum`` leaves them; ``spherical`` = -q J is added
    to the deviatoric part. Fills ``stress`` (3,), ``normal`` (3, 3) = d tau_i / d ln(l_j)
    - 2 tau_i delta_ij, and ``shear`` (3,) of the pairs (0, 1) (1, 2) (2, 0).
    """
    stiffness = np.empty(3)
    modulus, curvature = higher_moduli(logs, higher)
    undeviated_stress(logs, mu, alpha, modulus, stress)
    ogden_stiffness(logs, mu, alpha, stiffness)
    if modulus != 0.0:
        for i in range(3):
            stiffness[i] += 2.0 * modulus * math.exp(2.0 * logs[i])
    mean_stress = (stress[0] + stress[1] + stress[2]) / 3.0
    mean_stiffness = (stiffness[0] + stiffness[1] + stiffness[2]) / 9.0
    for i in range(3):
        stress[i] += spherical - mean_stress
    for i in range(3):
        for j in range(3):
            normal[i, j] = spherical + mean_stiffness - (stiffness[i] + stiffness[j]) / 3.0
        normal[i, i] += stiffness[i] - 2.0 * stress[i]
    if curvature != 0.0:
        add_rank_one(logs, curvature, normal)
    for i in range(3):
        j = (i + 1) % 3
        gap = 0.5 * math.log1p((b[i, i] - b[j, j]) / (1.0 + b[j, j]))
        mean = 0.5 * (logs[i] + logs[j])
        divided = divided_stress(mean, gap, mu, alpha)
        if modulus != 0.0:
            divided += 2.0 * modulus * math.exp(2.0 * mean) * sinhc(gap)
        shear[i] = shear_stiffness(divided, gap, stress[i] + stress[j])


@njit(cache=True, error_model="numpy")
def to_global_axes(
    vectors: Reals, stress: Reals, normal: Reals, shear: Reals, tau: Reals, stiffness: Reals
) -> None:
    """Rotate a principal response into ``tau`` (6,) and ``stiffness`` (6, 6).

    Voigt order xx, yy, zz, xy, yz, zx, with engineering shear strains.
    """
    dyads = np.empty((6, 6))  # rows: n_i n_i, then n_i n_j + n_j n_i of the pairs
    for i in range(3):
        j = (i + 1) % 3
        for c in range(6):
            p = c if c < 3 else c - 3
            q = c if c < 3 else (c - 2) % 3
            dyads[i, c] = vectors[p, i] * vectors[q, i]
            dyads[3 + i, c] = vectors[p, i] * vectors[q, j] + vectors[q, i] * vectors[p, j]
    for c in range(6):
        tau[c] = 0.0
        for i in range(3):
            tau[c] += stress[i] * dyads[i, c]
    for c in range(6):
        for d in range(c, 6):
            total = 0.0
            for i in range(3):
                total += shear[i] * dyads[3 + i, c] * dyads[3 + i, d]
                for j in range(3):
                    total += normal[i, j] * dyads[i, c] * dyads[j, d]
            stiffness[c, d] = total
            stiffness[d, c] = total


@njit(cache=True, error_model="numpy")
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


@njit(cache=True, error_model="numpy")
def invert(m: Reals, inverse: Reals) -> float:
    """Inverse of a (3, 3) matrix by cofactors; returns the determinant."""
    for i in range(3):
        for j in range(3):
            k, kk = (j + 1) % 3, (j + 2) % 3
            n, nn = (i + 1) % 3, (i + 2) % 3
            inverse[i, j] = m[k, n] * m[kk, nn] - m[k, nn] * m[kk, n]
    determinant = m[0, 0] * inverse[0, 0] + m[0, 1] * inverse[1, 0] + m[0, 2] * inverse[2, 0]
    for i in range(3):
        for j in range(3):
            inverse[i, j] /= determinant
    return determinant


@njit(cache=True, error_model="numpy")
def displacement_gradient(u: Reals, gradients: Reals, h: Reals) -> None:
    """h (3, 3) = du_i / dX_j from node displacements u (10, 3)."""
    for i in range(3):
        for j in range(3):
            h[i, j] = 0.0
            for a in range(10):
                h[i, j] += u[a, i] * gradients[a, j]


@njit(cache=True, error_model="numpy")
def deformation_gradient(h: Reals, f: Reals) -> None:
    """f (3, 3) = 1 + h."""
    for i in range(3):
        for j in range(3):
            f[i, j] = h[i, j] + (1.0 if i == j else 0.0)


@njit(cache=True, error_model="numpy")
def spatial_gradients(gradients: Reals, inverse: Reals, g: Reals) -> None:
    """Shape gradients g (10, 3) on the deformed body: ``gradients`` times F^-1."""
    for a in range(10):
        for i in range(3):
            g[a, i] = (
                gradients[a, 0] * inverse[0, i]
                + gradients[a, 1] * inverse[1, i]
                + gradients[a, 2] * inverse[2, i]
            )


@njit(cache=True, error_model="numpy")
def push_forward(f: Reals, s: Reals, tau: Reals) -> None:
    """tau (6,) = f s f^T of a symmetric s (6,), both in Voigt order xx, yy, zz, xy, yz, zx."""
    fs = np.empty((3, 3))
    for i in range(3):
        fs[i, 0] = f[i, 0] * s[0] + f[i, 1] * s[3] + f[i, 2] * s[5]
        fs[i, 1] = f[i, 0] * s[3] + f[i, 1] * s[1] + f[i, 2] * s[4]
        fs[i, 2] = f[i, 0] * s[5] + f[i, 1] * s[4] + f[i, 2] * s[2]
    for c in range(6):
        i = c if c < 3 else c - 3
        j = c if c < 3 else (c - 2) % 3
        tau[c] = fs[i, 0] * f[j, 0] + fs[i, 1] * f[j, 1] + fs[i, 2] * f[j, 2]


@njit(cache=True, error_model="numpy")
def element_energy(solid: Solid, x: Reals, u: Reals, q: Reals) -> tuple[float, float]:
    """Pi of one element, N mm, and its volume, mm^3; NaN where J <= 0. See the module's text."""
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
        density = ogden_energy(logs, solid.mu, solid.alpha) - pressure * change
        density += higher_energy(logs, solid.higher)
        energy += dv * (density + volume_energy(pressure, solid.compliance, solid.logarithmic))
        volume += dv
    return energy, volume


@njit(cache=True, error_model="numpy")
def element_response(
    solid: Solid,
    x: Reals,
    u: Reals,
    q: Reals,
    geometric: Reals,
    tangent: bool,
    r: Reals,
    k: Reals,
) -> float:
    """Residual r (34,) and, if ``tangent``, the upper half of the tangent k (34, 34).

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
            logs, b, -pressure * jacobian, solid.mu, solid.alpha, solid.higher,
            stress, normal, shear,
        )  # fmt: skip
        to_global_axes(vectors, stress, normal, shear, tau, stiffness)
        for a in range(10):
            r[3 * a] += dv * (tau[0] * g[a, 0] + tau[3] * g[a, 1] + tau[5] * g[a, 2])
            r[3 * a + 1] += dv * (tau[3] * g[a, 0] + tau[1] * g[a, 1] + tau[4] * g[a, 2])
            r[3 * a + 2] += dv * (tau[5] * g[a, 0] + tau[4] * g[a, 1] + tau[2] * g[a, 2])
        swelling, flexibility = volume_law(pressure, solid.compliance, solid.logarithmic)
        for v in range(4):
            r[30 + v] -= dv * solid.linear[point, v] * (change - swelling)
        if tangent:
            if geometric.shape[0] > 0:
                push_forward(f, geometric[point], tau)
            _add_displacement_tangent(g, tau, stiffness, dv, k)
            _add_pressure_tangent(g, solid.linear[point], dv * jacobian, dv * flexibility, k)
    return smallest


@njit(cache=True, error_model="numpy")
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


@njit(cache=True, error_model="numpy")
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


@njit(cache=True, error_model="numpy")
def assemble_chunk(
    solid: Solid,
    places: Places,
    chunk: int,
    displacement: Reals,
    pressure: Reals,
    geometric: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
    jacobians: Reals,
) -> None:
    """Add the elements of one chunk; arguments as for ``assemble``."""
    x = np.empty((10, 3))
    u = np.empty((10, 3))
    q = np.empty(4)
    r = np.empty(UNKNOWNS)
    k = np.empty((UNKNOWNS, UNKNOWNS))
    for position in range(places.chunks[chunk], places.chunks[chunk + 1]):
        element = places.order[position]
        for a in range(10):
            node = solid.tets[element, a]
            for i in range(3):
                x[a, i] = solid.nodes[node, i]
                u[a, i] = displacement[node, i]
        for v in range(4):
            q[v] = pressure[solid.tet_vertices[element, v]]
        jacobians[element] = element_response(solid, x, u, q, geometric[element], tangent, r, k)
        scatter(r, k, places.dofs[element], places.entries[element], 1.0, tangent, residual, values)


@njit(cache=True, error_model="numpy", parallel=True)
def assemble(
    solid: Solid,
    places: Places,
    displacement: Reals,
    pressure: Reals,
    geometric: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
    jacobians: Reals,
) -> None:
    """Add the elements' residuals to ``residual`` and tangents to the CSR ``values``.

    ``displacement`` (n, 3), ``pressure`` (v,), ``geometric`` (e, q, 6) as for ``element_response``,
    or (e, 0, 6). ``jacobians`` (e,) takes each element's smallest J.
    Chunks of a colour go in parallel, colours one after the other: the sums do not depend on the
    number of threads.
    """
    for colour in range(places.colours.size - 1):
        first, end = places.colours[colour], places.colours[colour + 1]
        if end - first == 1:  # waking the other threads would cost more than it saves
            assemble_chunk(
                solid,
                places,
                first,
                displacement,
                pressure,
                geometric,
                tangent,
                residual,
                values,
                jacobians,
            )
        else:
            for c in prange(first, end):
                assemble_chunk(
                    solid,
                    places,
                    c,
                    displacement,
                    pressure,
                    geometric,
                    tangent,
                    residual,
                    values,
                    jacobians,
                )


@njit(cache=True, error_model="numpy")
def to_plane_unknowns(r: Reals, k: Reals, node: int, height: float, tilt: float) -> None:
    """Express r (m + 2,) and the full k (m + 2, m + 2) in the unknowns of a moving plane.

    A node on the plane is at x = L + shift + h sin(tilt), z = h cos(tilt). Of the cell's local
    ``node`` the z unknown becomes that of its ``height`` h, the x unknown disappears, and the last
    two unknowns are tilt and shift.
    """
    s, c = math.sin(tilt), math.cos(tilt)
    x, z, turn, shift = 3 * node, 3 * node + 2, r.size - 2, r.size - 1
    for i in range(r.size):
        along, up = k[i, x], k[i, z]
        k[i, z] = s * along + c * up
        k[i, turn] += height * (c * along - s * up)
        k[i, shift] += along
    for j in range(r.size):
        along, up = k[x, j], k[z, j]
        k[z, j] = s * along + c * up
        k[turn, j] += height * (c * along - s * up)
        k[shift, j] += along
    along, up = r[x], r[z]
    k[z, turn] += c * along - s * up
    k[turn, z] += c * along - s * up
    k[turn, turn] -= height * (s * along + c * up)
    r[z] = s * along + c * up
    r[turn] += height * (c * along - s * up)
    r[shift] += along


@njit(cache=True, error_model="numpy")
def assemble_plane(
    solid: Solid,
    elements: Integers,
    heights: Reals,
    tilt: float,
    dofs: Integers,
    entries: Integers,
    displacement: Reals,
    pressure: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
    jacobians: Reals,
) -> None:
    """Add the ``elements`` (p,) that have nodes on the moving plane; see ``assemble``.

    ``heights`` (n,): h of the nodes on the plane, NaN for all others. ``dofs`` (p, 36) and
    ``entries`` (p, 666) end with the unknowns of the plane.
    """
    own_stress = np.empty((0, 6))
    r = np.empty(UNKNOWNS + 2)
    k = np.empty((UNKNOWNS + 2, UNKNOWNS + 2))
    for row in range(elements.size):
        element = elements[row]
        nodes = solid.tets[element]
        r[:] = 0.0
        k[:, :] = 0.0
        jacobians[element] = element_response(
            solid, solid.nodes[nodes], displacement[nodes], pressure[solid.tet_vertices[element]],
            own_stress, tangent, r[:UNKNOWNS], k[:UNKNOWNS, :UNKNOWNS],
        )  # fmt: skip
        mirror_upper(k)
        for a in range(10):
            if not np.isnan(heights[nodes[a]]):
                to_plane_unknowns(r, k, a, heights[nodes[a]], tilt)
        scatter(r, k, dofs[row], entries[row], 1.0, tangent, residual, values)


@njit(cache=True, error_model="numpy")
def mirror_upper(k: Reals) -> None:
    """Copy the upper triangle of a square matrix to its lower one."""
    for i in range(k.shape[0]):
        for j in range(i):
            k[i, j] = k[j, i]


@njit(cache=True, error_model="numpy")
def scatter(
    r: Reals,
    k: Reals,
    dofs: Integers,
    entries: Integers,
    factor: float,
    tangent: bool,
    residual: Reals,
    values: Reals,
) -> None:
    """Add r (m,) and ``factor`` times the upper triangle of k (m, m) in their places."""
    entry = 0
    for i in range(r.size):
        if dofs[i] >= 0:
            residual[dofs[i]] += r[i]
        if tangent:
            for j in range(i, r.size):
                if entries[entry] >= 0:
                    values[entries[entry]] += factor * k[i, j]
                entry += 1


@njit(cache=True, error_model="numpy")
def total_energy(solid: Solid, displacement: Reals, pressure: Reals) -> tuple[float, float]:
    """Pi of the whole solid, N mm, and its volume, mm^3."""
    energy = 0.0
    volume = 0.0
    for element in range(solid.tets.shape[0]):
        nodes = solid.tets[element]
        corners = solid.tet_vertices[element]
        part, size = element_energy(
            solid, solid.nodes[nodes], displacement[nodes], pressure[corners]
        )
        energy += part
        volume += size
    return energy, volume


@njit(cache=True, error_model="numpy", parallel=True)
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
                logs, b, -q * jacobian, solid.mu, solid.alpha, solid.higher,
                stress, normal, shear,
            )  # fmt: skip
            displacement_gradient(du, g, rate)
            along_axes(rate, vectors, turned)
            for i in range(3):
                stress[i] -= dq * jacobian
                for j in range(3):
                    stress[i] += normal[i, j] * turned[j, j]
            product(inverse, vectors, axes)
            pulled_back(axes, stress, shear, turned, extrapolated[element, point])


@njit(cache=True, error_model="numpy")
def product(a: Reals, b: Reals, ab: Reals) -> None:
    """ab = a b of (3, 3) matrices."""
    for i in range(3):
        for j in range(3):
            ab[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]


@njit(cache=True, error_model="numpy")
def along_axes(m: Reals, vectors: Reals, turned: Reals) -> None:
    """turned (3, 3) = V^T m V: the components of ``m`` along orthonormal ``vectors``, columns."""
    mv = np.empty((3, 3))
    product(m, vectors, mv)
    product(vectors.T, mv, turned)


@njit(cache=True, error_model="numpy")
def pulled_back(axes: Reals, stress: Reals, shear: Reals, rate: Reals, s: Reals) -> None:
    """s (6,) in Voigt order from normal and shear stresses along ``axes`` (3, 3), in columns.

    Shear stresses are ``shear`` (3,) of the pairs 12, 23, 31 times the shear of ``rate`` (3, 3).
    """
    for c in range(6):
        p = c if c < 3 else c - 3
        q = c if c < 3 else (c - 2) % 3
        s[c] = 0.0
        for i in range(3):
            j = (i + 1) % 3
            mixed = axes[p, i] * axes[q, j] + axes[q, i] * axes[p, j]
            s[c] += stress[i] * axes[p, i] * axes[q, i]
            s[c] += shear[i] * (rate[i, j] + rate[j, i]) * mixed


@njit(cache=True, error_model="numpy", parallel=True)
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
        principal = np.empty(3)
        for a in range(10):
            for i in range(3):
                x[a, i] = solid.nodes[solid.tets[element, a], i]
                u[a, i] = displacement[solid.tets[element, a], i]
        for point in range(solid.weights.size):
            determinant = reference_gradients(x, solid.gradients[point], gradients)
            dv[element, point] = determinant * solid.weights[point]
            displacement_gradient(u, gradients, h)
            spectrum(h, b, vectors, logs)
            modulus, _ = higher_moduli(logs, solid.higher)
            undeviated_stress(logs, solid.mu, solid.alpha, modulus, principal)
            mean = (principal[0] + principal[1] + principal[2]) / 3.0
            jacobian = 1.0 + volume_change(h)
            for c in range(6):
                p = c if c < 3 else c - 3
                s = c if c < 3 else (c - 2) % 3
                total = 0.0
                for i in range(3):
                    total += (principal[i] - mean) * vectors[p, i] * vectors[s, i]
                stress[element, point, c] = total / jacobian
