"""The Ogden material at a point against closed forms of many digits."""

from __future__ import annotations

import json
from decimal import Decimal, getcontext
from pathlib import Path

import numpy as np
import pytest

from solver import Ogden
from solver.kernels.hyperelastic import shear_stiffness
from solver.material import ogden

getcontext().prec = 50
CASES = {
    case["name"].split("_")[0]: case["reference"]
    for case in json.loads((Path(__file__).parents[1] / "data/ogden_points.json").read_text())[
        "cases"
    ]
}
YEOH = Ogden.yeoh(0.6, -0.05, 0.008)
NINJAFLEX = Ogden((0.19825, 3.2778), (3.05, -0.0054))
TRELOAR = Ogden((0.4095, 0.003, 0.01), (1.3, 5.0, -2.0))
EXPONENTS = {  # log stretches of each mode over ln(lambda); the last is free of stress
    "uniaxial": ("1", "-0.5", "-0.5"),
    "equibiaxial": ("1", "1", "-2"),
    "planar": ("1", "0", "-1"),
}


def log(number: str) -> Decimal:
    return Decimal(number).ln()


def nominal_stress(material: Ogden, stretch: str, mode: str) -> float:
    logs = [float(Decimal(exponent) * log(stretch)) for exponent in EXPONENTS[mode]]
    stress = material.principal_stresses(logs)
    return (stress[0] - stress[2]) / float(stretch)


@pytest.mark.parametrize(("material", "case"), [(NINJAFLEX, "M1"), (TRELOAR, "M2")])
@pytest.mark.parametrize("mode", EXPONENTS)
def test_nominal_stress_equals_the_closed_form(material: Ogden, case: str, mode: str) -> None:
    for stretch, stresses in CASES[case].items():
        assert nominal_stress(material, stretch, mode) == pytest.approx(
            stresses[mode], rel=2e-13 if abs(float(stretch) - 1) > 0.01 else 1e-11
        )


def test_divided_differences_are_exact_at_near_equal_stretches() -> None:
    for row in CASES["M4"]:
        lower = log(row["base"])
        gap = (1 + Decimal(row["relgap"])).ln()
        logs = np.array([float(lower), float(lower + gap), 0.0])
        gaps = np.array([float(gap), float(lower), -float(lower + gap)])
        stress, divided = np.empty(3), np.empty(3)
        ogden.response(logs[[1, 0, 2]], gaps, NINJAFLEX.values, stress, np.empty((3, 3)), divided)
        assert divided[0] == pytest.approx(float(row["T"]), rel=1e-13)
        shear = shear_stiffness(divided[0], float(gap), stress[0] + stress[1])
        assert shear == pytest.approx(float(row["C"]), rel=2e-12)


def test_energy_keeps_its_digits_down_to_vanishing_strain() -> None:
    for row in CASES["M5"]:
        first, second = log(row["l1"]), log(row["l2"])
        logs = [float(first), float(second), float(-first - second)]
        assert NINJAFLEX.energy(logs) == pytest.approx(float(row["W"]), rel=1e-13)


def test_a_vanishing_exponent_is_hencky() -> None:
    logs = np.array([0.7, -0.3, -0.4])
    hencky = Ogden((1.3,), (0.0,))
    assert hencky.energy(logs) == pytest.approx(1.3 * (logs**2).sum(), rel=1e-15)
    assert hencky.principal_stresses(logs) == pytest.approx(2 * 1.3 * logs, rel=1e-15)
    for alpha in (1e-300, 1e-12, -1e-12):
        near = Ogden((1.3,), (alpha,))
        assert near.energy(logs) == pytest.approx(hencky.energy(logs), rel=1e-11)


def test_stress_is_the_derivative_of_the_energy() -> None:
    logs, direction = np.array([0.5, -0.1, -0.4]), np.array([0.3, 0.4, -0.7])
    step = 1e-5
    slope = NINJAFLEX.energy(logs + step * direction) - NINJAFLEX.energy(logs - step * direction)
    stress = NINJAFLEX.principal_stresses(logs)
    assert slope / (2 * step) == pytest.approx(stress @ direction, rel=1e-9)


STRETCHES = ("0.3", "0.999999999", "1.000001", "1.01", "2", "5.5")


def yeoh_by_definition(material: Ogden, stretch: str, mode: str) -> tuple[Decimal, Decimal]:
    """W and nominal stress 2 (l1^2 - l3^2) / l dW/dI1 in 50 digits, as the textbook has them."""
    squares = [(2 * Decimal(exponent) * log(stretch)).exp() for exponent in EXPONENTS[mode]]
    x = sum(squares) - 3
    constants = [Decimal(material.mu[0]) / 2, *(Decimal(c) for c in material.higher)]
    energy = sum(c * x ** (i + 1) for i, c in enumerate(constants))
    slope = sum((i + 1) * c * x**i for i, c in enumerate(constants))
    return energy, 2 * (squares[0] - squares[2]) / Decimal(stretch) * slope


@pytest.mark.parametrize("mode", EXPONENTS)
@pytest.mark.parametrize("stretch", STRETCHES)
def test_yeoh_keeps_the_digits_of_its_definition(stretch: str, mode: str) -> None:
    energy, stress = yeoh_by_definition(YEOH, stretch, mode)
    logs = [float(Decimal(exponent) * log(stretch)) for exponent in EXPONENTS[mode]]
    assert YEOH.energy(logs) == pytest.approx(float(energy), rel=3e-14)
    assert nominal_stress(YEOH, stretch, mode) == pytest.approx(float(stress), rel=3e-14)


def test_the_first_invariant_does_not_cancel() -> None:
    for small in ("1e-12", "1e-8", "1e-3", "0.4"):
        e = [Decimal(small), Decimal(small) / 2, -Decimal(small) * 3 / 2]
        exact = sum((2 * part).exp() for part in e) - 3
        ours = ogden.first_invariant(np.array([float(part) for part in e]))
        assert ours == pytest.approx(float(exact), rel=1e-15)


def test_higher_moduli_are_the_derivatives_by_the_first_invariant() -> None:
    e, higher = np.array([0.7, -0.1, -0.6]), np.array([-0.05, 0.008, 0.002])
    x = ogden.first_invariant(e)
    by_hand = np.polynomial.Polynomial([0, 0, *higher])
    constants = ogden.packed([0.4], [2.0], higher).values
    first, second = ogden.higher_moduli(x, constants)
    assert first == pytest.approx(2 * by_hand.deriv()(x), rel=1e-14)
    assert second == pytest.approx(4 * by_hand.deriv(2)(x), rel=1e-14)
    assert ogden.higher_energy(x, constants) == pytest.approx(by_hand(x), rel=1e-14)


def test_names_of_the_field_are_cases_of_ogden() -> None:
    logs, mooney = np.array([0.5, 0.1, -0.6]), Ogden.mooney_rivlin(0.3, 0.1)
    first, second = np.exp(2 * logs).sum() - 3, np.exp(-2 * logs).sum() - 3
    assert mooney.energy(logs) == pytest.approx(0.3 * first + 0.1 * second, rel=1e-14)
    assert Ogden.neo_hooke(0.6).energy(logs) == pytest.approx(0.3 * first, rel=1e-14)
    assert Ogden.yeoh(0.3) == Ogden.neo_hooke(0.6)
    assert Ogden.yeoh(0.3, 0.2).energy(logs) == pytest.approx(0.3 * first + 0.2 * first**2)


def test_initial_shear_modulus_is_the_sum_of_mu() -> None:
    assert NINJAFLEX.shear_modulus == pytest.approx(3.47605)
    gamma = 1e-6
    stress = NINJAFLEX.principal_stresses([gamma / 2, 0.0, -gamma / 2])
    assert (stress[0] - stress[2]) / 2 == pytest.approx(3.47605 * gamma, rel=1e-6)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (dict(mu=(1.0,), alpha=(2.0, 3.0)), "same number of terms"),
        (dict(mu=(), alpha=()), "at least one"),
        (dict(mu=(-1.0,), alpha=(2.0,)), r"mu must be positive and finite, got -1\.0 MPa"),
        (dict(mu=(float("nan"),), alpha=(2.0,)), "mu must be positive"),
        (dict(mu=(1.0,), alpha=(float("inf"),)), "alpha must be finite"),
        (dict(mu=(1.0,), alpha=(2.0,), bulk_modulus=0.0), "bulk_modulus must be positive"),
        (dict(mu=(1.0,), alpha=(2.0,), higher=(float("nan"),)), "higher must be finite, got nan"),
        (dict(mu=(1.0,), alpha=(2.0,), volumetric="cubic"), "must be quadratic or logarithmic"),
    ],
)
def test_impossible_constants_are_refused_in_one_sentence(arguments: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Ogden(**arguments)
