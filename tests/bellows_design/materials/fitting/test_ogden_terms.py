"""Stresses of single Ogden terms, against the law itself and against differences."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.materials.fitting.ogden_terms import unit_slopes, unit_stresses
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.ogden import packed


def test_a_terms_stress_is_the_laws() -> None:
    stretch, exponents = (
        np.array([0.2, 0.99, 1.0, 1.5, 6.0]),
        np.array([-7.0, -0.01, 0.0, 2.0, 9.0]),
    )
    for mode in MODES.values():
        ours = unit_stresses(mode.mean, mode.gap, np.log(stretch), exponents)
        for column, alpha in zip(ours.T, exponents, strict=True):
            law = nominal_stress(mode, stretch, packed((1.0,), (alpha,)))
            assert column == pytest.approx(law, rel=1e-13)


def test_slopes_in_the_exponent_equal_differences() -> None:
    logs, alpha, step = np.log(np.array([0.2, 0.9, 1.0001, 1.3, 7.0])), np.linspace(-9, 9, 19), 1e-5
    for mode in MODES.values():
        above, below = (
            unit_stresses(mode.mean, mode.gap, logs, alpha + shift) for shift in (step, -step)
        )
        slopes = unit_slopes(mode.mean, mode.gap, logs, alpha)
        scale = np.abs(unit_stresses(mode.mean, mode.gap, logs, alpha))
        assert np.abs(slopes - (above - below) / (2 * step)).max(initial=0, where=scale > 0) == (
            pytest.approx(0, abs=1e-7 * np.abs(slopes).max())
        )
