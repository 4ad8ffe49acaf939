"""Mooney's and Rivlin's law with five constants, a polynomial of both invariants.

W = C10 x + C01 y + C20 x^2 + C11 x y + C02 y^2 with x = I1 - 3 and y = I2 - 3 of the isochoric
stretches l_i = exp(e_i): I1 = sum l_i^2 and I2 = sum l_i^-2. With the derivatives W1, W2 of W by x
and y, and a_i = l_i^2 - 1, b_i = l_i^-2 - 1,

    s_i = 2 W1 a_i - 2 W2 b_i,
    ds_i/de_j = 4 (W1 l_i^2 + W2 l_i^-2) delta_ij
                + 4 (2 C20 a_i a_j - C11 (a_i b_j + b_i a_j) + 2 C02 b_i b_j).

a and b come from expm1 without cancellation, the invariants as sums of squares times phi2.
Source: R. S. Rivlin and D. W. Saunders, Phil. Trans. R. Soc. A 243, 251, 1951.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import check_number
from solver.material.law import Hyperelastic, Volumetric
from solver.numerics.compiled import compiled
from solver.numerics.special_functions import phi2, sinhc


@dataclass(frozen=True)
class MooneyRivlin(Hyperelastic):
    """Mooney-Rivlin rubber with five constants, of either sign.

    W = C10 x + C01 y + C20 x^2 + C11 x y + C02 y^2 with x = I1 - 3 and y = I2 - 3 of the isochoric
    stretches. With a negative constant it may be stable up to some strain only;
    ``solver.material.stability`` computes that strain.

    Attributes:
        c10: C10, MPa.
        c01: C01, MPa.
        c20: C20, MPa.
        c11: C11, MPa.
        c02: C02, MPa.
        bulk_modulus: K, MPa; infinite means incompressible, J = 1.
        volumetric: "quadratic", K (J - 1)^2 / 2, or "logarithmic", K (J^2 - 1 - 2 ln J) / 4.

    Raises:
        SolverError: a constant is not finite, the initial shear modulus 2 (C10 + C01) or the bulk
            modulus is not positive, or the volumetric law is unknown.
    """

    law: ClassVar[str] = "mooney-rivlin-5"

    c10: float
    c01: float = 0.0
    c20: float = 0.0
    c11: float = 0.0
    c02: float = 0.0
    bulk_modulus: float = math.inf
    volumetric: Volumetric = "quadratic"

    def __post_init__(self) -> None:
        for name in ("c10", "c01", "c20", "c11", "c02"):
            check_number(f"MooneyRivlin: {name}", getattr(self, name))
        if not np.isfinite(self.values).all():
            raise SolverError(f"MooneyRivlin: constants must be finite, got {self.values} MPa.")
        if not self.shear_modulus > 0:
            raise SolverError(
                "MooneyRivlin: the initial shear modulus 2 (c10 + c01) must be positive, got "
                f"{self.shear_modulus:g} MPa."
            )
        self._check_volumetric()

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus, 2 (C10 + C01), MPa."""
        return 2.0 * (self.c10 + self.c01)

    @cached_property
    def values(self) -> Reals:
        """The constants as the compiled functions take them."""
        return np.array([self.c10, self.c01, self.c20, self.c11, self.c02], float)


MATERIAL = MooneyRivlin


@compiled()
def energy(e: Reals, constants: Reals) -> float:
    """W of isochoric log stretches e (3,), MPa."""
    x = _invariant(e, 2.0)
    y = _invariant(e, -2.0)
    linear = constants[0] * x + constants[1] * y
    return linear + constants[2] * x * x + constants[3] * x * y + constants[4] * y * y


@compiled()
def response(
    e: Reals, gaps: Reals, constants: Reals, stress: Reals, hessian: Reals, divided: Reals
) -> None:
    """s_i, ds_i/de_j and divided differences of s, MPa; see the module's text."""
    x = _invariant(e, 2.0)
    y = _invariant(e, -2.0)
    first = constants[0] + 2.0 * constants[2] * x + constants[3] * y
    second = constants[1] + constants[3] * x + 2.0 * constants[4] * y
    for i in range(3):
        a_i, b_i = math.expm1(2.0 * e[i]), math.expm1(-2.0 * e[i])
        stress[i] = 2.0 * (first * a_i - second * b_i)
        for j in range(3):
            a_j, b_j = math.expm1(2.0 * e[j]), math.expm1(-2.0 * e[j])
            hessian[i, j] = 8.0 * (constants[2] * a_i * a_j + constants[4] * b_i * b_j)
            hessian[i, j] -= 4.0 * constants[3] * (a_i * b_j + b_i * a_j)
        hessian[i, i] += 4.0 * (first * math.exp(2.0 * e[i]) + second * math.exp(-2.0 * e[i]))
        twice_mean = e[i] + e[(i + 1) % 3]
        mixed = first * math.exp(twice_mean) + second * math.exp(-twice_mean)
        divided[i] = 4.0 * mixed * sinhc(gaps[i])


@compiled()
def _invariant(e: Reals, power: float) -> float:
    """sum exp(power e_i) - 3 of e (3,) that sum to 0, without cancellation."""
    total = 0.0
    for i in range(3):
        z = power * e[i]
        total += z * z * phi2(z)
    return total
