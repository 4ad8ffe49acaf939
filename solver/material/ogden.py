"""Ogden's law in Abaqus's form, any number of terms, with Yeoh's higher ones.

W = sum 2 mu / alpha^2 (sum_i exp(alpha e_i) - 3) of isochoric principal log stretches e_i is
evaluated with phi1(x) = expm1(x) / x and phi2(x) = (exp(x) - 1 - x) / x^2, which need no case
distinction at equal stretches nor at alpha -> 0 (Hencky). Yeoh's terms sum C_i0 (I1 - 3)^i of order
i >= 2 have the first and second derivatives W' and W'' by I1. They act as an Ogden term of
mu = 2 W' and alpha = 2 whose mu depends on the strain, which adds 4 W'' l_i^2 l_j^2, of rank one,
to the derivatives of the stress.

Constants as the compiled functions take them: the number of terms n, mu (n,), alpha (n,), and
C20, C30, ... of any number.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import numpy as np

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import check_number, numbers
from solver.material.constants import Constants
from solver.material.law import Hyperelastic, Volumetric
from solver.material.laws import number_of
from solver.numerics.compiled import compiled
from solver.numerics.special_functions import phi1, phi2, sinhc


@dataclass(frozen=True)
class Ogden(Hyperelastic):
    """Ogden's rubber in Abaqus's form, any number of terms, with Yeoh's higher ones.

    W = sum_k 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3)
    + C20 (I1 - 3)^2 + C30 (I1 - 3)^3 + ... of the isochoric stretches l_i = J^(-1/3) lambda_i and
    I1 = l1^2 + l2^2 + l3^2; the term with alpha_k = 0 is its limit, Hencky's
    mu_k (ln^2 l1 + ln^2 l2 + ln^2 l3).

    Positive mu_k are Hill's inequality in this form: such a material is stable at every strain as
    long as no ``higher`` is negative. Negative ones, common in Yeoh's model, are allowed; such a
    material is stable up to some strain only.

    Attributes:
        mu: moduli, MPa; positive.
        alpha: exponents, as many.
        bulk_modulus: K, MPa; infinite means incompressible, J = 1.
        higher: Yeoh's (C20, C30, ...), MPa.
        volumetric: "quadratic", K (J - 1)^2 / 2, or "logarithmic", K (J^2 - 1 - 2 ln J) / 4.

    Raises:
        SolverError: no mu or one that is not positive, a number that is not finite, other lengths
            of ``mu`` and ``alpha``, a bulk modulus that is not positive, an unknown volumetric law.

    Examples:
        >>> from solver import Ogden
        >>> print(f"{Ogden((0.4, 0.02), (1.8, 6.0)).shear_modulus:.2f} MPa")
        0.42 MPa
        >>> print(Ogden.mooney_rivlin(c10=0.2, c01=0.05))
        Ogden(mu=(0.4, 0.1), alpha=(2.0, -2.0), bulk_modulus=inf, higher=(), volumetric='quadratic')
    """

    law: ClassVar[str] = "ogden"

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
        for name, constant in (("c10", c10), ("c01", c01)):
            check_number(f"Ogden: {name}", constant)
        return cls((2 * c10, 2 * c01), (2.0, -2.0), bulk_modulus)

    @classmethod
    def yeoh(cls, c10: float, *higher: float, bulk_modulus: float = math.inf) -> Self:
        """W = c10 (I1 - 3) + c20 (I1 - 3)^2 + ..., MPa; ``higher`` = c20, c30, ..."""
        check_number("Ogden: c10", c10)
        return cls((2 * c10,), (2.0,), bulk_modulus, higher)

    def __post_init__(self) -> None:
        for name in ("mu", "alpha", "higher"):
            object.__setattr__(self, name, numbers(f"Ogden: {name}", getattr(self, name)))
        if len(self.mu) != len(self.alpha) or not self.mu:
            raise SolverError(
                "Ogden: mu and alpha need the same number of terms, at least one, "
                f"got {len(self.mu)} and {len(self.alpha)}."
            )
        for value in self.mu:
            if not (math.isfinite(value) and value > 0):
                raise SolverError(f"Ogden: mu must be positive and finite, got {value} MPa{HINT}.")
        for name, unit in (("alpha", ""), ("higher", " MPa")):
            for value in getattr(self, name):
                if not math.isfinite(value):
                    raise SolverError(f"Ogden: {name} must be finite, got {value}{unit}.")
        self._check_volumetric()

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus, the sum of mu, MPa."""
        return sum(self.mu)

    @cached_property
    def values(self) -> Reals:
        """The constants as the compiled functions take them."""
        return packed(self.mu, self.alpha, self.higher).values


MATERIAL = Ogden

HINT = (
    " (constants of Ogden's original form, sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3), "
    "become those of this one by mu -> mu alpha / 2, which is positive where both have one sign)"
)


def packed(
    mu: Sequence[float] | Reals,
    alpha: Sequence[float] | Reals,
    higher: Sequence[float] | Reals = (),
) -> Constants:
    """Constants of either sign: ``mu`` and ``higher`` in MPa."""
    values = np.concatenate([[len(mu)], mu, alpha, higher])
    return Constants(number_of(Ogden.law), np.asarray(values, float))


@compiled()
def energy(e: Reals, constants: Reals) -> float:
    """W of isochoric log stretches e (3,), MPa: sum 2 mu e_i^2 phi2(alpha e_i), and Yeoh's."""
    terms = int(constants[0])
    total = 0.0
    for k in range(1, terms + 1):
        mu, alpha = constants[k], constants[terms + k]
        for i in range(3):
            total += 2.0 * mu * e[i] * e[i] * phi2(alpha * e[i])
    if constants.size > 2 * terms + 1:
        total += higher_energy(first_invariant(e), constants)
    return total


@compiled()
def response(
    e: Reals, gaps: Reals, constants: Reals, stress: Reals, hessian: Reals, divided: Reals
) -> None:
    """s_i = sum 2 mu e_i phi1(alpha e_i), ds_i/de_j and divided differences of s, MPa."""
    terms = int(constants[0])
    modulus, curvature = 0.0, 0.0
    if constants.size > 2 * terms + 1:
        modulus, curvature = higher_moduli(first_invariant(e), constants)
    for i in range(3):
        stress[i] = 0.0
        divided[i] = 0.0
        stiffness = 0.0
        mean = 0.5 * (e[i] + e[(i + 1) % 3])
        for k in range(1, terms + 1):
            mu, alpha = constants[k], constants[terms + k]
            stress[i] += 2.0 * mu * e[i] * phi1(alpha * e[i])
            stiffness += 2.0 * mu * math.exp(alpha * e[i])
            divided[i] += 2.0 * mu * math.exp(alpha * mean) * sinhc(0.5 * alpha * gaps[i])
        if modulus != 0.0:
            stress[i] += 2.0 * modulus * e[i] * phi1(2.0 * e[i])
            stiffness += 2.0 * modulus * math.exp(2.0 * e[i])
            divided[i] += 2.0 * modulus * math.exp(2.0 * mean) * sinhc(gaps[i])
        for j in range(3):
            hessian[i, j] = stiffness if i == j else 0.0
    if curvature != 0.0:
        _add_rank_one(e, curvature, hessian)


@compiled()
def first_invariant(e: Reals) -> float:
    """I1 - 3 of isochoric log stretches e (3,), without cancellation: sum 4 e_i^2 phi2(2 e_i)."""
    total = 0.0
    for i in range(3):
        total += 4.0 * e[i] * e[i] * phi2(2.0 * e[i])
    return total


@compiled()
def higher_energy(x: float, constants: Reals) -> float:
    """Yeoh's sum C_i0 x^i over i >= 2 of x = I1 - 3, MPa."""
    first = 2 * int(constants[0]) + 1
    total = 0.0
    for k in range(constants.size - 1, first - 1, -1):
        total = total * x + constants[k]
    return total * x * x


@compiled()
def higher_moduli(x: float, constants: Reals) -> tuple[float, float]:
    """2 W' and 4 W'' of ``higher_energy``, derivatives by I1; MPa."""
    first = 2 * int(constants[0]) + 1
    slope = 0.0
    second = 0.0
    for k in range(constants.size - 1, first - 1, -1):
        order = k - first + 2
        slope = slope * x + order * constants[k]
        second = second * x + order * (order - 1) * constants[k]
    return 2.0 * slope * x, 4.0 * second


@compiled()
def _add_rank_one(e: Reals, factor: float, hessian: Reals) -> None:
    """Add ``factor`` times d_i d_j, where d_i = l_i^2 - 1; the 1 has no deviatoric part."""
    squares = np.empty(3)
    for i in range(3):
        squares[i] = 2.0 * e[i] * phi1(2.0 * e[i])
    for i in range(3):
        for j in range(3):
            hessian[i, j] += factor * squares[i] * squares[j]
