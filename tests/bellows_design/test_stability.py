"""Where a material is stable, against closed forms and sets of constants known to fail."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bellows_design.homogeneous import MODES, nominal_stress
from bellows_design.stability import HIGHEST, LOWEST, stability

POSITIVE = st.floats(1e-4, 1e3)
EXPONENTS = st.floats(-12, 12)


@given(st.lists(st.tuples(POSITIVE, EXPONENTS), min_size=1, max_size=3))
@settings(max_examples=60, deadline=None)
def test_positive_constants_are_stable_at_every_strain(terms: list[tuple[float, float]]) -> None:
    mu, alpha = zip(*terms, strict=True)
    found = stability(mu, alpha)
    assert found.everywhere and found.covers(LOWEST, HIGHEST)
    assert found.shear_modulus == pytest.approx(sum(mu))


def test_mooney_rivlin_with_a_negative_second_constant_fails_where_its_stiffness_does() -> None:
    """Along planar tension k = 2 (λ² + c λ⁻²), 2 (1 + c), 2 (λ⁻² + c λ²) with c = μ₂/μ₁."""
    ratio = -0.1
    found = stability((1.0, ratio), (2.0, -2.0)).of("planar")

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
    found = stability(mu, alpha)
    assert found.shear_modulus > 0 and not found.everywhere
    assert any(each.lowest > LOWEST or each.highest < HIGHEST for each in found.ranges)
    assert all(each.lowest < 1 < each.highest for each in found.ranges)
    assert found.covers(0.999, 1.001) and not found.covers(LOWEST, HIGHEST)


def test_a_negative_initial_modulus_is_stable_nowhere() -> None:
    found = stability((-1.0,), (2.0,))
    assert not found.everywhere and not found.covers(1.0, 1.0)
    assert all((each.lowest, each.highest) == (1.0, 1.0) for each in found.ranges)


def test_henckys_load_peaks_at_e() -> None:
    """P = 3 μ ln λ / λ in uniaxial tension, and likewise in the other tests: the peak is at e."""
    for each in stability((1.0,), (0.0,)).ranges:
        assert each.load_rises_to == pytest.approx(np.e, rel=1e-9)
        assert each.complete


def test_the_load_peak_is_the_largest_nominal_stress() -> None:
    mu, alpha = (1.0,), (0.7,)
    line = np.linspace(1.0, HIGHEST, 200_001)
    for each in stability(mu, alpha).ranges:
        stress = nominal_stress(MODES[each.mode], line, mu, alpha)
        peak = line[stress.argmax()]
        assert each.load_rises_to == pytest.approx(peak, rel=1e-3)


def test_neo_hooke_carries_more_load_at_every_stretch() -> None:
    assert all(each.load_rises_to == HIGHEST for each in stability((1.0,), (2.0,)).ranges)
