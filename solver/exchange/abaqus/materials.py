"""Hyperelastic materials as Abaqus and CalculiX take them.

Both have Ogden's energy in the form of ``solver.material.ogden``,
W = sum 2 mu_k / alpha_k^2 (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3) + sum (J - 1)^2i / D_i
of isochoric stretches, and polynomials of their invariants: W = sum C_ij (I1 - 3)^i (I2 - 3)^j.
Sources: Abaqus Analysis User's Guide, Hyperelastic behaviour of rubberlike materials; G. Dhondt,
CalculiX CrunchiX User's Manual, ``*HYPERELASTIC``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from solver.errors import SolverError
from solver.material.law import Hyperelastic
from solver.material.mooney_rivlin import MooneyRivlin
from solver.material.ogden import Ogden

VALUES_IN_A_LINE = 8
HIGHEST_ORDER = 3
"""Of a polynomial in an input file of either program."""

MOST_TERMS = {"abaqus": 6, "calculix": 4}
"""Of Ogden's law."""

SMALLEST_ALPHA = 0.2
"""CalculiX loses its digits in 1 / alpha^2 below: it fails with 0.05, not with 0.2 (prototype 1's
rubber has -0.0054). At a log strain of 0.5 the two terms differ from one by 0.08 % in energy."""

BULK_TO_SHEAR = 20.0
"""Bulk modulus of incompressible materials for CalculiX, in shear moduli (Poisson's ratio 0.475):
it has no element for less compressible ones; more locks its tetrahedra."""


def material_lines(name: str, material: Hyperelastic, program: str) -> Iterator[str]:
    """``*MATERIAL`` and what belongs to it; ``program`` is abaqus or calculix.

    Raises ``SolverError`` for an energy that the program does not have.
    """
    yield f"*MATERIAL, NAME={name}"
    kind, values, order = _law(name, material, program)
    yield f"*HYPERELASTIC, {kind}"
    first, *rest = _bulk_constants(material, program, order)
    yield from _rows([*values, first, *rest])


def differences(material: Hyperelastic, program: str) -> Iterator[str]:
    """What differs from the material as it is computed with here, a sentence each."""
    if program == "calculix" and math.isinf(material.bulk_modulus):
        yield (
            f"incompressible rubber has a bulk modulus of {BULK_TO_SHEAR:g} shear moduli, as "
            "CalculiX has no hybrid element"
        )
    elif math.isfinite(material.bulk_modulus) and material.volumetric == "logarithmic":
        yield "the volumetric part is K (J - 1)^2 / 2 instead of K (J^2 - 1 - 2 ln J) / 4"
    if program == "calculix" and isinstance(material, Ogden) and not _has_invariants(material):
        yield (
            "CalculiX's form of Ogden's law diverges in thin-walled bodies; laws of the invariants "
            "(Yeoh's, Mooney and Rivlin's) do not"
        )
        for alpha in material.alpha:
            if abs(alpha) < SMALLEST_ALPHA:
                yield (
                    f"Ogden's term of alpha = {alpha:g} is two of +-{SMALLEST_ALPHA:g}, the same "
                    "to third order in the log strain"
                )


def _has_invariants(material: Ogden) -> bool:
    """Whether an energy is one of I1 and I2."""
    return set(material.alpha) <= {2.0, -2.0}


def compressible(material: Hyperelastic, program: str) -> float:
    """The bulk modulus, MPa, that a deck has; infinite for an incompressible material."""
    if program == "calculix" and math.isinf(material.bulk_modulus):
        return BULK_TO_SHEAR * material.shear_modulus
    return material.bulk_modulus


def _bulk_constants(material: Hyperelastic, program: str, order: int) -> list[float]:
    """D1, D2, ... of (J - 1)^2i / D_i; zero for none."""
    return [2.0 / compressible(material, program), *(0.0 for _ in range(order - 1))]


def _law(name: str, material: Hyperelastic, program: str) -> tuple[str, list[float], int]:
    """Parameters of ``*HYPERELASTIC``, constants without D, and how many D there are."""
    if isinstance(material, MooneyRivlin):
        c = material
        return "POLYNOMIAL, N=2", [c.c10, c.c01, c.c20, c.c11, c.c02], 2
    if not isinstance(material, Ogden):
        raise SolverError(f"deck: {type(material).__name__} has no form in an input file.")
    if _has_invariants(material):
        return _polynomial(name, material)
    if material.higher:
        raise SolverError(
            f"deck: the material {name!r} has Yeoh's higher terms besides Ogden's with alpha = "
            f"{', '.join(f'{alpha:g}' for alpha in material.alpha)}; an input file has no such law."
        )
    return _ogden(name, material, program)


def _ogden(name: str, material: Ogden, program: str) -> tuple[str, list[float], int]:
    pairs = list(zip(material.mu, material.alpha, strict=True))
    if program == "calculix":
        pairs = [pair for mu, alpha in pairs for pair in _far_from_zero(mu, alpha)]
    if any(alpha == 0 for _, alpha in pairs):
        raise SolverError(
            f"deck: the material {name!r} has a term of Ogden's law with alpha = 0, Hencky's, "
            "which Abaqus does not have."
        )
    if len(pairs) > MOST_TERMS[program]:
        raise SolverError(
            f"deck: the material {name!r} has {len(pairs)} terms of Ogden's law; {program} takes "
            f"{MOST_TERMS[program]}."
        )
    return f"OGDEN, N={len(pairs)}", [value for pair in pairs for value in pair], len(pairs)


def _far_from_zero(mu: float, alpha: float) -> list[tuple[float, float]]:
    """A term (mu, alpha), or two of +-``SMALLEST_ALPHA`` in its place.

    With log stretches e_i whose sum is 0 a term is mu sum (e^2 + alpha e^3 / 3 + alpha^2 e^4 / 12
    + ...), so that weights of (1 +- alpha / beta) / 2 at +-beta keep the first two.
    """
    if abs(alpha) >= SMALLEST_ALPHA:
        return [(mu, alpha)]
    share = alpha / SMALLEST_ALPHA
    return [(mu * (1 + share) / 2, SMALLEST_ALPHA), (mu * (1 - share) / 2, -SMALLEST_ALPHA)]


def _polynomial(name: str, material: Ogden) -> tuple[str, list[float], int]:
    """Neo-Hooke, Mooney-Rivlin, Yeoh, or the polynomial that has both invariants."""
    c10, c01 = (
        sum(mu for mu, own in zip(material.mu, material.alpha, strict=True) if own == alpha) / 2
        for alpha in (2.0, -2.0)
    )
    higher = material.higher
    if len(higher) >= HIGHEST_ORDER and any(higher[HIGHEST_ORDER - 1 :]):
        raise SolverError(
            f"deck: the material {name!r} has Yeoh's terms up to the order {len(higher) + 1}; an "
            f"input file has {HIGHEST_ORDER}."
        )
    if not any(higher):
        if c01 == 0:
            return "NEO HOOKE", [c10], 1
        return "MOONEY-RIVLIN", [c10, c01], 1
    c20, c30 = (*higher, 0.0)[:2]
    if c01 == 0:
        return "YEOH", [c10, c20, c30], 3
    return "POLYNOMIAL, N=3", [c10, c01, c20, 0, 0, c30, 0, 0, 0], 3


def _rows(values: Sequence[float]) -> Iterator[str]:
    texts = [repr(float(value)) for value in values]
    for start in range(0, len(texts), VALUES_IN_A_LINE):
        yield ", ".join(texts[start : start + VALUES_IN_A_LINE])
