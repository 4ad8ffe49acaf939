"""Hyperelastic materials as data, with their response at a point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from solver.arrays import Reals
from solver.errors import SolverError

Volumetric = Literal["quadratic", "logarithmic"]


@dataclass(frozen=True)
class Ogden:
    """Ogden's rubber in Abaqus's form, any number of terms, with Yeoh's higher ones.

    W = sum_k 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3) of the isochoric
    stretches l_i = J^(-1/3) lambda_i, MPa; the term with alpha_k = 0 is its limit, Hencky's
    mu_k (ln^2 l1 + ln^2 l2 + ln^2 l3). ``higher`` = (C20, C30, ...), MPa, adds Yeoh's
    C20 (I1 - 3)^2 + C30 (I1 - 3)^3 + ... of I1 = l1^2 + l2^2 + l3^2.

    An infinite ``bulk_modulus`` K (MPa) means J = 1; a finite one adds K (J - 1)^2 / 2 if
    ``volumetric`` is "quadratic", K (J^2 - 1 - 2 ln J) / 4 if it is "logarithmic", the law that
    resists without bound as J goes to 0.

    Every mu_k is positive, which is Hill's inequality in this form: such a material is stable at
    every strain as long as no ``higher`` is negative. Negative ones, common in Yeoh's model, are
    taken, and are stable up to some strain only. Raises ``SolverError`` for other mu, when a number
    is not finite, when the lengths of ``mu`` and ``alpha`` differ, and for an unknown law.
    """

    mu: tuple[float, ...]
    alpha: tuple[float, ...]
    bulk_modulus: float = math.inf
    higher: tuple[float, ...] = ()
    volumetric: Volumetric = "quadratic"

    @classmethod
    def neo_hooke(cls, mu: float, bulk_modulus: float = math.inf) -> Self:
        """W = mu / 2 (I1 - 3)."""
        return cls((mu,), (2.0,), bulk_modulus)

    @classmethod
    def mooney_rivlin(cls, c10: float, c01: float, bulk_modulus: float = math.inf) -> Self:
        """W = c10 (I1 - 3) + c01 (I2 - 3), both positive, MPa."""
        return cls((2 * c10, 2 * c01), (2.0, -2.0), bulk_modulus)

    @classmethod
    def yeoh(cls, c10: float, *higher: float, bulk_modulus: float = math.inf) -> Self:
        """W = c10 (I1 - 3) + c20 (I1 - 3)^2 + ..., MPa; ``higher`` = c20, c30, ..."""
        return cls((2 * c10,), (2.0,), bulk_modulus, higher)

    def __post_init__(self) -> None:
        for name in ("mu", "alpha", "higher"):
            object.__setattr__(self, name, tuple(float(value) for value in getattr(self, name)))
        if len(self.mu) != len(self.alpha) or not self.mu:
            raise SolverError(
                "Ogden: mu and alpha need the same number of terms, at least one, "
                f"got {len(self.mu)} and {len(self.alpha)}."
            )
        for value in self.mu:
            if not (math.isfinite(value) and value > 0):
                raise SolverError(f"Ogden: mu must be positive and finite, got {value} MPa.")
        for name, unit in (("alpha", ""), ("higher", " MPa")):
            for value in getattr(self, name):
                if not math.isfinite(value):
                    raise SolverError(f"Ogden: {name} must be finite, got {value}{unit}.")
        if not self.bulk_modulus > 0:
            raise SolverError(f"Ogden: bulk_modulus must be positive, got {self.bulk_modulus} MPa.")
        if self.volumetric not in ("quadratic", "logarithmic"):
            raise SolverError(
                f"Ogden: volumetric must be quadratic or logarithmic, got {self.volumetric!r}."
            )

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

    @cached_property
    def higher_coefficients(self) -> Reals:
        """``higher`` as an array for the kernels."""
        return np.array(self.higher, dtype=float)

    def energy(self, log_stretches: ArrayLike) -> float:
        """W in MPa at isochoric principal log stretches (3,), whose sum is 0."""
        from solver.kernels.kernels import higher_energy, ogden_energy

        logs = np.asarray(log_stretches, float)
        energy = ogden_energy(logs, *self.coefficients)
        return float(energy + higher_energy(logs, self.higher_coefficients))

    def principal_stresses(self, log_stretches: ArrayLike) -> Reals:
        """Deviatoric principal Kirchhoff stresses (3,), MPa, at isochoric log stretches (3,)."""
        from solver.kernels.kernels import higher_moduli, undeviated_stress

        logs, stress = np.asarray(log_stretches, float), np.empty(3)
        modulus, _ = higher_moduli(logs, self.higher_coefficients)
        undeviated_stress(logs, *self.coefficients, modulus, stress)
        return stress - stress.mean()
