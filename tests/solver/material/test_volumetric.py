"""The volumetric laws against closed forms of many digits."""

from __future__ import annotations

from decimal import Decimal, getcontext

import pytest

from solver.material.volumetric import volume_energy, volume_law

getcontext().prec = 50


@pytest.mark.parametrize("ratio", ["-30", "-1", "-1e-6", "1e-9", "0.01", "2", "50"])
def test_logarithmic_volume_law_holds_full_precision(ratio: str) -> None:
    s, bulk = Decimal(ratio), Decimal(7)
    theta = (s * s + 1).sqrt() - s
    energy = bulk / 4 * (theta**2 - 1 - 2 * theta.ln()) + s * bulk * (theta - 1)
    q, compliance = float(s * bulk), 1 / 7
    swelling, flexibility = volume_law(q, compliance, True)
    assert swelling == pytest.approx(float(theta - 1), rel=2e-15)
    assert flexibility == pytest.approx(float(theta / (s * s + 1).sqrt() / bulk), rel=5e-14)
    assert volume_energy(q, compliance, True) == pytest.approx(float(energy), rel=2e-14)


def test_both_volume_laws_are_one_when_incompressible_and_when_nearly_so() -> None:
    for q in (-3.0, 0.0, 0.7):
        for logarithmic in (False, True):
            assert volume_law(q, 0.0, logarithmic) == (0.0, 0.0)
            assert volume_energy(q, 0.0, logarithmic) == 0.0
    quadratic, logarithmic = (volume_law(1.0, 1e-9, law) for law in (False, True))
    assert logarithmic == pytest.approx(quadratic, rel=2e-9)
