"""Ogden's rubber under the incompressibility constraint, in NumPy, for codes without their own.

W(F, p) = sum_k 2 mu_k / alpha_k^2 sum_i (exp(alpha_k e_i) - 1) + p (J - 1) with the isochoric
principal log stretches e_i = ln lambda_i - ln J / 3; p in MPa, positive in tension. Written in the
principal frame, in forms that lose no digits at equal stretches or at small alpha.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from case import ALPHA, MU, Reals

DEVIATOR = np.eye(3) - 1 / 3
PAIRS = ((0, 1), (0, 2), (1, 2))


@dataclass(frozen=True)
class Principal:
    """States at m points in their principal frames.

    ``logs`` (m, 3) log stretches; ``left`` and ``right`` (m, 3, 3) with the principal directions
    in their columns; ``isochoric`` (m, 3); ``kirchhoff`` (m, 3) deviatoric stresses, MPa;
    ``volume_ratio`` (m,).
    """

    logs: Reals
    left: Reals
    right: Reals
    isochoric: Reals
    kirchhoff: Reals
    volume_ratio: Reals

    @staticmethod
    def of(gradients: Reals) -> Principal:
        """Principal frames of deformation gradients (m, 3, 3)."""
        squares, right = np.linalg.eigh(np.swapaxes(gradients, 1, 2) @ gradients)
        logs = 0.5 * np.log(squares)
        left = gradients @ right * np.exp(-logs)[:, None, :]
        isochoric = logs @ DEVIATOR
        stresses = sum(
            2 * mu * isochoric * _phi1(alpha * isochoric)
            for mu, alpha in zip(MU, ALPHA, strict=True)
        )
        return Principal(
            logs, left, right, isochoric, stresses @ DEVIATOR, np.linalg.det(gradients)
        )

    def piola(self, pressure: Reals) -> Reals:
        """First Piola stress dW/dF (m, 3, 3), MPa, under the constraint's ``pressure`` (m,)."""
        return self._assembled(self.kirchhoff + (pressure * self.volume_ratio)[:, None])

    def cofactor(self) -> Reals:
        """dJ/dF (m, 3, 3)."""
        return self._assembled(np.broadcast_to(self.volume_ratio[:, None], self.logs.shape))

    def _assembled(self, kirchhoff: Reals) -> Reals:
        """Piola stress of principal Kirchhoff stresses (m, 3)."""
        scaled = self.left * (kirchhoff * np.exp(-self.logs))[:, None, :]
        return scaled @ np.swapaxes(self.right, 1, 2)

    def tangent(self, pressure: Reals) -> Reals:
        """d2W/dFdF (m, 9, 9), MPa, over the components of F row by row."""
        principal = self._principal_tangent(pressure * self.volume_ratio)
        frame = np.einsum("mia,mjb->mijab", self.left, self.right).reshape(-1, 9, 9)
        return frame @ principal @ np.swapaxes(frame, 1, 2)

    def _principal_tangent(self, hydrostatic: Reals) -> Reals:
        """The tangent (m, 9, 9) over components (left a, right b) in the principal frame."""
        tangent = np.zeros((len(self.logs), 3, 3, 3, 3))
        inverse = np.exp(-self.logs)
        normal = self._normal_stiffness(hydrostatic)
        for a in range(3):
            for b in range(3):
                tangent[:, a, a, b, b] = normal[:, a, b] * inverse[:, a] * inverse[:, b]
        for a, b in PAIRS:
            same, crossed = self._shear_stiffness(hydrostatic, a, b)
            scale = inverse[:, a] * inverse[:, b]
            tangent[:, a, b, a, b] = tangent[:, b, a, b, a] = same * scale
            tangent[:, a, b, b, a] = tangent[:, b, a, a, b] = crossed * scale
        return tangent.reshape(-1, 9, 9)

    def _normal_stiffness(self, hydrostatic: Reals) -> Reals:
        """Derivative of the principal stresses over log stretches, less the stresses (m, 3, 3)."""
        slopes = sum(
            2 * mu * np.exp(alpha * self.isochoric) for mu, alpha in zip(MU, ALPHA, strict=True)
        )
        stiffness = np.einsum("ab,mb,bc->mac", DEVIATOR, slopes, DEVIATOR)
        stiffness += hydrostatic[:, None, None]
        diagonal = np.arange(3)
        stiffness[:, diagonal, diagonal] -= self.kirchhoff + hydrostatic[:, None]
        return stiffness

    def _shear_stiffness(self, hydrostatic: Reals, a: int, b: int) -> tuple[Reals, Reals]:
        """Stiffness of F_ab against itself and against F_ba, times both stretches: two (m,)."""
        gap = self.logs[:, a] - self.logs[:, b]
        middle = (self.isochoric[:, a] + self.isochoric[:, b]) / 2
        slope = sum(
            2 * mu * np.exp(alpha * middle) * _sinhc(alpha * gap / 2)
            for mu, alpha in zip(MU, ALPHA, strict=True)
        )
        mean = (self.kirchhoff[:, a] + self.kirchhoff[:, b]) / 2
        same = slope / (2 * _sinhc(gap))
        return same, same * np.cosh(gap) - mean - hydrostatic


def _phi1(x: Reals) -> Reals:
    """(exp(x) - 1) / x, 1 at 0."""
    return np.divide(np.expm1(x), x, out=np.ones_like(x), where=x != 0)


def _sinhc(x: Reals) -> Reals:
    """sinh(x) / x, 1 at 0."""
    return np.divide(np.sinh(x), x, out=np.ones_like(x), where=x != 0)
