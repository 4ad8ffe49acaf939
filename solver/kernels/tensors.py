"""Small symmetric tensors: spectrum, inverse, products, changes of axes.

Voigt order is xx, yy, zz, xy, yz, zx.
"""

from __future__ import annotations

import math

import numpy as np

from solver.arrays import Reals
from solver.numerics.compiled import compiled


@compiled()
def jacobi(a: Reals, vectors: Reals) -> None:
    """Eigenvalues of the symmetric (3, 3) ``a``, left on its diagonal; ``vectors`` in columns.

    Cyclic Jacobi rotations until the off-diagonal part is below rounding; equal eigenvalues are no
    special case.
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


@compiled()
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


@compiled()
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


@compiled()
def deformation_gradient(h: Reals, f: Reals) -> None:
    """f (3, 3) = 1 + h."""
    for i in range(3):
        for j in range(3):
            f[i, j] = h[i, j] + (1.0 if i == j else 0.0)


@compiled()
def spectrum(h: Reals, b: Reals, vectors: Reals, logs: Reals) -> None:
    """Principal axes of b = (1 + h)(1 + h)^T and isochoric log stretches.

    Fills the diagonal of ``b`` with the eigenvalues of b - 1, the columns of ``vectors`` with the
    principal axes, and ``logs`` with e_i.
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


@compiled()
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


@compiled()
def product(a: Reals, b: Reals, ab: Reals) -> None:
    """ab = a b of (3, 3) matrices."""
    for i in range(3):
        for j in range(3):
            ab[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]


@compiled()
def along_axes(m: Reals, vectors: Reals, turned: Reals) -> None:
    """turned (3, 3) = V^T m V: the components of ``m`` along orthonormal ``vectors``, columns."""
    mv = np.empty((3, 3))
    product(m, vectors, mv)
    product(vectors.T, mv, turned)


@compiled()
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


@compiled()
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
