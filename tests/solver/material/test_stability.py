"""Where a material is stable, against closed forms and sets of constants known to fail."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver import Ogden
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.ogden import packed
from solver.material.stability import (
    HIGHEST,
    LOWEST,
    drucker_margin,
    shear_margin,
    stability,
)

POSITIVE = st.floats(1e-4, 1e3)
EXPONENTS = st.floats(-12, 12)


@given(st.lists(st.tuples(POSITIVE, EXPONENTS), min_size=1, max_size=3))
@settings(max_examples=60, deadline=None)
def test_positive_constants_are_stable_at_every_strain(terms: list[tuple[float, float]]) -> None:
    mu, alpha = zip(*terms, strict=True)
    found = stability(packed(mu, alpha))
    assert found.everywhere and found.covers(LOWEST, HIGHEST)
    assert found.shear_modulus == pytest.approx(sum(mu))


def test_mooney_rivlin_with_a_negative_second_constant_fails_where_its_stiffness_does() -> None:
    """Along planar tension k = 2 (λ² + c λ⁻²), 2 (1 + c), 2 (λ⁻² + c λ²) with c = μ₂/μ₁."""
    ratio = -0.1
    found = stability(packed((1.0, ratio), (2.0, -2.0))).of("planar")

    def product(stretch: float) -> float:
        square = stretch**2
        k = square + ratio / square, 1 + ratio, 1 / square + ratio * square
        return k[0] * k[1] + k[1] * k[2] + k[2] * k[0]

    assert not found.complete and found.lowest == pytest.approx(1 / found.highest, rel=1e-9)
    assert product(found.highest * (1 - 1e-6)) > 0 > product(found.highest * (1 + 1e-6))


@pytest.mark.parametrize(
    ("mu", "alpha"),
    [((1.0, -0.4), (2.0, -2.0)), ((0.5, -0.2), (1.3, 5.0)), ((-0.1, 0.5), (8.0, 2.0))],
)
def test_sets_of_mixed_sign_are_flagged_with_their_range(
    mu: tuple[float, ...], alpha: tuple[float, ...]
) -> None:
    found = stability(packed(mu, alpha))
    assert found.shear_modulus > 0 and not found.everywhere
    assert any(each.lowest > LOWEST or each.highest < HIGHEST for each in found.ranges)
    assert all(each.lowest < 1 < each.highest for each in found.ranges)
    assert found.covers(0.999, 1.001) and not found.covers(LOWEST, HIGHEST)


def test_a_negative_initial_modulus_is_stable_nowhere() -> None:
    found = stability(packed((-1.0,), (2.0,)))
    assert not found.everywhere and not found.covers(1.0, 1.0)
    assert all((each.lowest, each.highest) == (1.0, 1.0) for each in found.ranges)


def test_henckys_load_peaks_at_e() -> None:
    """P = 3 μ ln λ / λ in uniaxial tension, and likewise in the other tests: the peak is at e."""
    for each in stability(packed((1.0,), (0.0,))).ranges:
        assert each.load_rises_to == pytest.approx(np.e, rel=1e-9)
        assert each.complete


def test_the_load_peak_is_the_largest_nominal_stress() -> None:
    mu, alpha = (1.0,), (0.7,)
    line = np.linspace(1.0, HIGHEST, 200_001)
    for each in stability(packed(mu, alpha)).ranges:
        stress = nominal_stress(MODES[each.mode], line, packed(mu, alpha))
        peak = line[stress.argmax()]
        assert each.load_rises_to == pytest.approx(peak, rel=1e-3)


def test_neo_hooke_carries_more_load_at_every_stretch() -> None:
    assert all(each.load_rises_to == HIGHEST for each in stability(packed((1.0,), (2.0,))).ranges)


YEOH = packed((0.8,), (2.0,), (-0.12, 0.002))


def states(count: int, size: float, seed: int = 4) -> np.ndarray:
    """Random isochoric principal log stretches (count, 3)."""
    logs = np.random.default_rng(seed).uniform(-size, size, (count, 3))
    return logs - logs.mean(axis=1, keepdims=True)


def test_druckers_margin_is_the_least_curvature_of_the_energy() -> None:
    """Against second differences of the solver's own energy, in two directions of the plane."""
    material = Ogden((0.8, 0.1), (2.0, -1.5), higher=(-0.06, 0.002))
    constants = material.constants
    basis = np.array([[2.0, -1.0, -1.0], [0.0, 3**0.5, -(3**0.5)]]) / 6**0.5
    step = 1e-3
    for logs in states(20, 0.8):
        energy = {
            (i, j): material.energy(logs + step * np.array([i, j]) @ basis)
            for i in (-1, 0, 1)
            for j in (-1, 0, 1)
        }
        straight = [
            energy[1, 0] - 2 * energy[0, 0] + energy[-1, 0],
            energy[0, 1] - 2 * energy[0, 0] + energy[0, -1],
        ]
        mixed = (energy[1, 1] - energy[1, -1] - energy[-1, 1] + energy[-1, -1]) / 4
        curvature = np.array([[straight[0], mixed], [mixed, straight[1]]]) / step**2
        least = np.linalg.eigvalsh(curvature)[0]
        assert drucker_margin(logs[None], constants)[0] == pytest.approx(least, rel=1e-4, abs=1e-4)


def test_the_shear_margin_is_the_least_ratio_of_stress_to_strain_differences() -> None:
    material = Ogden((0.8,), (2.0,), higher=(-0.12, 0.002))
    for logs in states(20, 1.0):
        stress = material.principal_stresses(logs)
        ratios = [
            (stress[i] - stress[j]) / (logs[i] - logs[j]) for i, j in ((0, 1), (1, 2), (2, 0))
        ]
        assert shear_margin(logs[None], YEOH)[0] == pytest.approx(min(ratios), rel=1e-10)


def test_yeoh_with_a_negative_second_constant_is_flagged_where_its_slope_falls() -> None:
    assert stability(packed((0.8,), (2.0,), (0.01, 0.002))).everywhere
    found = stability(packed((0.8,), (2.0,), (-0.12, 0.002)))
    assert found.shear_modulus == 0.8 and not found.everywhere
    uniaxial = found.of("uniaxial")
    for stretch, stable in ((0.999 * uniaxial.highest, True), (1.001 * uniaxial.highest, False)):
        logs = np.log(stretch) * np.array([[1.0, -0.5, -0.5]])
        margin = min(drucker_margin(logs, YEOH)[0], shear_margin(logs, YEOH)[0])
        assert bool(margin > 0) is stable


def test_the_nominal_stress_of_yeoh_peaks_where_its_slope_says() -> None:
    yeoh = packed((0.8,), (2.0,), (-0.02, 1e-4))
    line = np.linspace(1.0, HIGHEST, 100_001)
    for each in stability(yeoh).ranges:
        stress = nominal_stress(MODES[each.mode], line, yeoh)
        falling = np.flatnonzero(np.diff(stress) < 0)
        peak = line[falling[0]] if falling.size else HIGHEST
        assert each.load_rises_to == pytest.approx(peak, rel=1e-3)
