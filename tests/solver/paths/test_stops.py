"""Whole curves: equilibria at given pressures on the way to the last one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from solver import Mesh, Ogden, PathPoint, Problem, Solution, SolverOptions, Supports, solve

STOPS = (0.07, 0.02, 0.05)
TIGHT = SolverOptions(tolerance=1e-9, loose_tolerance=1e-9, maximum_iterations=40)


@pytest.fixture(scope="module")
def problem(cell: Mesh, ninjaflex: Ogden) -> Problem:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    return Problem(cell, ninjaflex, supports, ("cavity",), moving_plane="x1")


@pytest.fixture(scope="module")
def up(problem: Problem) -> Solution:
    return solve(problem, 0.1, TIGHT, stops=STOPS)


def at(solution: Solution, pressure: float) -> PathPoint:
    """The one point of the path at a pressure."""
    (point,) = (point for point in solution.path if abs(point.pressure - pressure) < 1e-15)
    return point


def test_the_path_has_the_exact_pressures_in_ascending_order(up: Solution) -> None:
    pressures = [point.pressure for point in up.path]
    assert up.converged and pressures[0] == 0 and pressures[-1] == up.pressure == 0.1
    assert (np.diff(pressures) > 0).all()
    for stop in STOPS:
        assert at(up, stop).pressure == pytest.approx(stop, abs=1e-16)


def test_a_stop_is_the_equilibrium_a_solve_up_to_it_finds(problem: Problem, up: Solution) -> None:
    for stop in STOPS:
        alone = solve(problem, stop, TIGHT).path[-1]
        passed = at(up, stop)
        assert passed.rotation == pytest.approx(alone.rotation, rel=1e-6)
        assert passed.max_von_mises == pytest.approx(alone.max_von_mises, rel=1e-6)
        assert passed.volume == pytest.approx(alone.volume, rel=1e-6)


def test_the_same_states_are_found_going_up_and_coming_down(problem: Problem, up: Solution) -> None:
    start = (up.displacement, up.hydrostatic_pressure)
    down = solve(problem, 0.1, TIGHT, initial=start, stops=STOPS)
    assert down.converged and down.refused_steps == 0
    pressures = [point.pressure for point in down.path]
    assert pressures[0] == 0 and pressures[-1] == 0.1 and (np.diff(pressures) > 0).all()
    for stop in STOPS:
        one, other = at(up, stop), at(down, stop)
        assert other.rotation == pytest.approx(one.rotation, rel=1e-6)
        assert other.max_von_mises == pytest.approx(one.max_von_mises, rel=1e-6)
        assert other.volume == pytest.approx(one.volume, rel=1e-6)
    assert down.displacement == pytest.approx(up.displacement, abs=1e-7)


def test_stops_at_their_usual_tolerance_are_accurate_too(problem: Problem, up: Solution) -> None:
    usual = solve(problem, 0.1, stops=STOPS)
    for stop in STOPS:
        assert at(usual, stop).rotation == pytest.approx(at(up, stop).rotation, rel=1e-4)


def test_the_asked_pressure_may_be_a_stop_and_a_stop_may_be_named_twice(problem: Problem) -> None:
    solution = solve(problem, 0.05, stops=(0.05, 0.02, 0.02))
    assert [point.pressure for point in solution.path].count(0.05) == 1
    assert at(solution, 0.02).rotation > 0


def test_suction_has_stops_below_zero(problem: Problem) -> None:
    solution = solve(problem, -0.02, stops=(-0.01,))
    assert solution.converged
    assert 0 > at(solution, -0.01).rotation > solution.rotation


@pytest.mark.parametrize("stop", [0.0, -0.01, 0.1001, float("nan"), float("inf")])
def test_a_stop_that_is_not_on_the_way_is_refused(problem: Problem, stop: float) -> None:
    with pytest.raises(ValueError, match=r"^stops must lie between 0 and the pressure of 0\.1 MPa"):
        solve(problem, 0.1, stops=(0.05, stop))


def test_without_pressure_stops_are_fractions_of_the_load(problem: Problem) -> None:
    with pytest.raises(ValueError, match="stops must lie between 0 and the whole load, 1"):
        solve(problem, 0.0, stops=(1.5,))


def test_a_load_out_of_reach_keeps_the_stops_it_passed(sphere: Callable[..., Mesh]) -> None:
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    ball = Problem(sphere(10.0, 11.0, 1, 2), Ogden((1.0,), (2.0,)), supports, ("inside",))
    options = SolverOptions(smallest_step=1e-2)
    solution = solve(ball, 0.2, options, stops=(0.05, 0.19))  # bursts at 0.118
    assert not solution.converged and solution.pressure < 0.13
    pressures = [point.pressure for point in solution.path]
    assert pytest.approx(0.05, abs=1e-15) in pressures and max(pressures) == solution.pressure
