"""Nominal stresses of the three tests, against digits and derivatives taken otherwise."""

from __future__ import annotations

import json
from decimal import Decimal, getcontext
from pathlib import Path

import numpy as np
import pytest

from solver.material.homogeneous import (
    BIAXIAL,
    MODES,
    PLANAR,
    UNIAXIAL,
    nominal_stress,
)
from solver.material.ogden import packed

getcontext().prec = 50
POINTS = Path(__file__).parents[1] / "data/ogden_points.json"
CASES = {
    case["name"].split("_")[0]: case["reference"]
    for case in json.loads(POINTS.read_text("utf-8"))["cases"]
}
NAMES = {"uniaxial": UNIAXIAL, "equibiaxial": BIAXIAL, "planar": PLANAR}
NINJAFLEX = (0.19825, 3.2778), (3.05, -0.0054)
TRELOAR = (0.4095, 0.003, 0.01), (1.3, 5.0, -2.0)


@pytest.mark.parametrize(("constants", "case"), [(NINJAFLEX, "M1"), (TRELOAR, "M2")])
@pytest.mark.parametrize("name", NAMES)
def test_stresses_equal_the_reference_of_many_digits(
    constants: tuple[tuple[float, ...], tuple[float, ...]], case: str, name: str
) -> None:
    for stretch, stresses in CASES[case].items():
        stress = nominal_stress(NAMES[name], np.array([float(stretch)]), packed(*constants))[0]
        # a stretch next to 1 carries its own rounding, 1e-16/(λ − 1), into the stress
        digits = 3e-13 if abs(float(stretch) - 1) > 0.01 else 3e-11
        assert stress == pytest.approx(stresses[name], rel=digits)


@pytest.mark.parametrize("alpha", ["-7.5", "-2", "-0.0054", "1e-9", "0.3", "2", "25"])
@pytest.mark.parametrize("stretch", ["0.0625", "0.5", "0.984375", "1.0009765625", "1.5", "16"])
def test_stresses_equal_the_power_law_in_fifty_digits(alpha: str, stretch: str) -> None:
    """P = 2 μ/α (λ^(α n₁) − λ^(α n₃)) / λ, with n the exponents of the test."""
    for mode in MODES.values():
        exact, power = Decimal(stretch), Decimal(float(alpha))
        ends = [exact ** (power * Decimal(mode.exponents[i])) for i in (0, 2)]
        stress = 2 * (ends[0] - ends[1]) / power / exact
        ours = nominal_stress(mode, np.array([float(stretch)]), packed((1.0,), (float(alpha),)))[0]
        assert ours == pytest.approx(float(stress), rel=2e-13)


def test_a_vanishing_exponent_is_hencky() -> None:
    stretch = np.array([0.3, 1.0, 2.5])
    for mode in MODES.values():
        hencky = 2 * mode.gap * np.log(stretch) / stretch
        assert nominal_stress(mode, stretch, packed((1.0,), (0.0,))) == pytest.approx(
            hencky, rel=1e-15
        )


def test_stress_is_the_derivative_of_the_energy() -> None:
    """dW = P dλ, with twice the work in equibiaxial tension."""
    mu, alpha, step = np.array([0.4, 0.05]), np.array([1.7, -4.0]), 1e-5

    def energy(stretches: np.ndarray) -> np.ndarray:
        powers = (stretches[..., None] ** alpha).sum(axis=1) - 3
        return (2 * mu / alpha**2 * powers).sum(axis=-1)

    stretch = np.array([0.6, 0.9, 1.2, 3.0])
    for mode in MODES.values():
        ahead, behind = (mode.principal_stretches(stretch + s) for s in (step, -step))
        slope = (energy(ahead) - energy(behind)) / (2 * step)
        work = 2 if mode is BIAXIAL else 1
        assert work * nominal_stress(mode, stretch, packed(mu, alpha)) == pytest.approx(
            slope, rel=1e-7
        )


def test_no_stress_without_strain() -> None:
    for mode in MODES.values():
        assert nominal_stress(mode, np.array([1.0]), packed(*TRELOAR))[0] == 0.0


@pytest.mark.parametrize("stretch", ["0.2", "0.9999999", "1.000030517578125", "1.3", "4"])
def test_yeohs_stress_equals_its_definition_in_fifty_digits(stretch: str) -> None:
    """P = 2 (λ₁² − λ₃²)/λ Σ i Cᵢ₀ (I₁ − 3)^(i−1)."""
    exact = Decimal(float(stretch))
    constants = [Decimal(number) for number in (0.8 / 2, -0.03, 0.002)]
    for mode in MODES.values():
        squares = [exact ** (2 * Decimal(exponent)) for exponent in mode.exponents]
        x = sum(squares) - 3
        slope = sum((i + 1) * c * x**i for i, c in enumerate(constants))
        expected = 2 * (squares[0] - squares[2]) / exact * slope
        yeoh = packed((0.8,), (2.0,), (-0.03, 0.002))
        ours = nominal_stress(mode, np.array([float(stretch)]), yeoh)
        assert ours[0] == pytest.approx(float(expected), rel=2e-13)
