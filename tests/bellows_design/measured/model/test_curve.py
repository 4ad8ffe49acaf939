"""Curves for other stiffnesses; the similarity that makes one curve tell all of them."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import bellows_mesh

from bellows_design.errors import UnreachedError
from bellows_design.measured.model.course import of_slow_rise
from bellows_design.measured.model.curve import (
    BetweenFactors,
    ScaledByPressure,
    StoredCurve,
    Zeroed,
)
from solver import Ogden, Problem, SolverOptions, Supports, reaction, solve

TIGHT = SolverOptions(tolerance=1e-10, loose_tolerance=1e-10, maximum_iterations=40)
PRESSURE = np.linspace(0, 0.1, 11)


def curve(scale: float = 1.0, reach: float = 0.1) -> StoredCurve:
    pressure = np.linspace(0, reach, 11)
    return StoredCurve(pressure, scale * 1000 * pressure**2, 0.01 * pressure)


@pytest.mark.parametrize(
    ("bulk", "clamped"),
    [(np.inf, ("root",)), (20.0, ("root", "tip"))],
    ids=["free, incompressible", "blocked, with a bulk modulus"],
)
def test_stiffness_and_pressure_are_one_number_of_the_solver(
    bulk: float, clamped: tuple[str, ...]
) -> None:
    """f(p; s) = f(p/s; 1) and F(p; s) = s F(p/s; 1), with all moduli scaled."""
    factor, pressure, mesh = 1.7, 0.03, bellows_mesh(1)
    soft = Ogden((0.5, 0.2), (2.0, -2.0), bulk_modulus=bulk)
    stiff = Ogden((0.5 * factor, 0.2 * factor), (2.0, -2.0), bulk_modulus=bulk * factor)
    supports = Supports(clamped=clamped, symmetry={"symmetry": 1})
    reference = solve(Problem(mesh, soft, supports, ("cavity",)), pressure, TIGHT)
    scaled = solve(Problem(mesh, stiff, supports, ("cavity",)), factor * pressure, TIGHT)
    size = np.abs(reference.displacement).max()
    assert size > 1e-3
    assert np.abs(scaled.displacement - reference.displacement).max() < 1e-6 * size
    force, scaled_force = reaction(reference, "root").force, reaction(scaled, "root").force
    assert np.abs(scaled_force - factor * force).max() < 1e-6 * np.abs(factor * force).max()


def test_one_curve_tells_all_factors() -> None:
    angle, force = ScaledByPressure(curve()), ScaledByPressure(curve(), by_force=True)
    at = np.array([0.04, 0.06])
    assert angle.values(at, 2.0) == pytest.approx(1000 * (at / 2) ** 2, rel=1e-2)
    assert force.values(at, 2.0) == pytest.approx(2 * angle.values(at, 2.0))
    assert force.errors(at, 2.0) == pytest.approx(2 * angle.errors(at, 2.0))
    assert angle.reach(2.0) == pytest.approx(0.2)
    assert np.isnan(angle.values(np.array([0.21]), 2.0)).all()
    table = force.table(at, np.array([1.0, 2.0]))
    assert table[:, 1] == pytest.approx(force.values(at, 2.0))


def test_several_curves_are_exact_at_their_factors_and_agree_with_one_where_that_is_exact() -> None:
    factors = (0.6, 1.0, 1.7)
    one = ScaledByPressure(curve())
    exact = {
        s: StoredCurve(s * PRESSURE, one.values(s * PRESSURE, s), 0 * PRESSURE) for s in factors
    }
    several, at = BetweenFactors(exact), np.array([0.02, 0.05])
    for factor in (*factors, 1.3):
        assert several.values(at, factor) == pytest.approx(one.values(at, factor), rel=0.02)
    # A spring beside the body that stays as it is: f = p / (s + 1).
    spring = {s: StoredCurve(PRESSURE, PRESSURE / (s + 1), PRESSURE * 0) for s in factors}
    found = BetweenFactors(spring).values(at / 2, 1.3)
    assert found == pytest.approx(at / 2 / 2.3, rel=3e-3)
    assert BetweenFactors(spring).table(at / 2, np.array([1.0, 1.3]))[:, 1] == pytest.approx(found)


def test_a_zeroed_curve_is_nothing_at_its_zero_and_takes_its_error_with_it() -> None:
    plain = ScaledByPressure(curve())
    zeroed, at = Zeroed(plain, 0.03), np.array([0.03, 0.08])
    assert zeroed.values(at)[0] == 0 and zeroed.errors(at)[0] == 0
    assert zeroed.values(at, 1.5)[1] == pytest.approx(float(np.diff(plain.values(at, 1.5))[0]))
    assert zeroed.errors(at)[1] == pytest.approx(float(np.ptp(plain.errors(at))))


def test_the_error_between_points_is_foreseen() -> None:
    between = np.linspace(0.01, 0.1, 400)
    for exact in (lambda p: np.sin(12 * p), lambda p: np.exp(40 * p), lambda p: np.tanh(30 * p)):
        found = StoredCurve(PRESSURE, exact(PRESSURE), 0 * PRESSURE)
        missed = np.abs(found.values(between) - exact(between)).max()
        assert missed < found.errors(between).max() < 40 * missed


def test_a_curve_of_one_point_is_refused() -> None:
    with pytest.raises(UnreachedError, match="no curve to compare with"):
        StoredCurve(np.array([0.0]), np.array([0.0]), np.array([0.0]), "It ends at once.")


def test_a_rising_pressure_jumps_where_the_pressure_falls_with_the_volume() -> None:
    pressure = np.array([0.0, 1.0, 2.0, 1.5, 1.0, 2.0, 3.0])
    value = np.array([0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0])
    ascending, read = of_slow_rise(pressure, value)
    assert (np.diff(ascending) > 0).all() and ascending[-1] == 3
    assert np.interp(1.99, ascending, read) < 2.0  # still before the jump
    assert np.interp(2.02, ascending, read) == pytest.approx(8.0, abs=0.1)  # behind it
    never, last = of_slow_rise(pressure[:5], value[:5])
    assert never[-1] == 2 and last[-1] == 2
