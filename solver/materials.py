"""Hyperelastic materials as data, with their response at a point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from solver.arrays import Reals


@dataclass(frozen=True)
class Ogden:
    """Ogden's rubber in Abaqus's form, any number of terms.

    W = sum_k 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3) of the isochoric
    stretches l_i = J^(-1/3) lambda_i, MPa; the term with alpha_k = 0 is its limit, Hencky's
    mu_k (ln^2 l1 + ln^2 l2 + ln^2 l3). An infinite ``bulk_modulus`` (MPa) means J = 1, a finite
    one adds K (J - 1)^2 / 2.

    Every mu_k is positive, which is Hill's inequality in this form. Raises ``ValueError``
    otherwise, and when a number is not finite or the lengths of ``mu`` and ``alpha`` differ.
    """

    mu: tuple[float, ...]
    alpha: tuple[float, ...]
    bulk_modulus: float = math.inf

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", tuple(float(value) for value in self.mu))
        object.__setattr__(self, "alpha", tuple(float(value) for value in self.alpha))
        if len(self.mu) != len(self.alpha) or not self.mu:
            raise ValueError(
                "Ogden: mu and alpha need the same number of terms, at least one, "
                f"got {len(self.mu)} and {len(self.alpha)}."
            )
        for value in self.mu:
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"Ogden: mu must be positive and finite, got {value} MPa.")
        for value in self.alpha:
            if not math.isfinite(value):
                raise ValueError(f"Ogden: alpha must be finite, got {value}.")
        if not self.bulk_modulus > 0:
            raise ValueError(f"Ogden: bulk_modulus must be positive, got {self.bulk_modulus} MPa.")

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus, the sum of mu, MPa."""
        return sum(self.mu)

    @property
    def compliance(self) -> float:
        """1 / bulk_modulus, 1/MPa; exactly 0 when incompressible."""
        return 1.0 / self.bulk_modulus

    @cached_property
    def coefficients(self) -> tuple[Reals, Reals]:
        """mu and alpha as arrays for the kernels."""
        return np.array(self.mu), np.array(self.alpha)

    def energy(self, log_stretches: ArrayLike) -> float:
        """W in MPa at isochoric principal log stretches (3,), whose sum is 0."""
        from solver.kernels import ogden_energy

        return float(ogden_energy(np.asarray(log_stretches, float), *self.coefficients))

    def principal_stresses(self, log_stretches: ArrayLike) -> Reals:
        """Deviatoric principal Kirchhoff stresses (3,), MPa, at isochoric log stretches (3,)."""
        from solver.kernels import ogden_stress

        stress = np.empty(3)
        ogden_stress(np.asarray(log_stretches, float), *self.coefficients, stress)
        return stress - stress.mean()
