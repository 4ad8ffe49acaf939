"""A path ends where a state is not accepted, where its budget is spent, or at a distant limit."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from solver import Event, Mesh, Ogden, Problem, SolverOptions, Supports, inflate, solve
from solver.assembly.state import State
from solver.nonlinear.attempts import Attempt
from solver.nonlinear.events import Guard
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.paths import stopping
from solver.paths.outcome import figures
from solver.paths.step_control import StepControl

PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
LIMIT = 0.118
"""MPa. Highest pressure of the ball below on its mesh."""


@pytest.fixture(scope="module")
def ball(sphere: Callable[..., Mesh]) -> Problem:
    """A neo-Hookean ball of 10 mm radius and 1 mm wall, mu = 1 MPa."""
    return Problem(sphere(10.0, 11.0, 1, 2), Ogden((1.0,), (2.0,)), PLANES, ("inside",))


@pytest.fixture(scope="module")
def cell_problem(cell: Mesh, ninjaflex: Ogden) -> Problem:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    return Problem(cell, ninjaflex, supports, ("cavity",), moving_plane="x1")


def moved_less_than(millimetres: float) -> Guard:
    def guard(state: State) -> str:
        far = np.abs(state.displacement).max() > millimetres
        return f"a node moved more than {millimetres:g} mm" if far else ""

    return guard


def test_a_path_ends_before_the_first_state_that_is_not_accepted(cell_problem: Problem) -> None:
    free = solve(cell_problem, 0.1)
    bound = 0.4 * np.abs(free.displacement).max()
    held = solve(cell_problem, 0.1, guard=moved_less_than(bound))
    assert not held.converged and held.stopped_by == "guard" and held.limit is None
    assert held.message.endswith(f"MPa: a node moved more than {bound:g} mm.")
    reached = np.abs(held.displacement).max()
    assert 0.99 * bound < reached <= bound  # located to a thousandth of the load


def test_the_same_pressure_is_found_from_a_start_at_the_whole_load(cell_problem: Problem) -> None:
    free = solve(cell_problem, 0.1)
    guard = moved_less_than(0.7 * np.abs(free.displacement).max())
    from_zero = solve(cell_problem, 0.1, guard=guard)
    start = (free.displacement, free.hydrostatic_pressure)
    unloaded = solve(cell_problem, 0.1, initial=start, guard=guard)
    assert unloaded.stopped_by == from_zero.stopped_by == "guard"
    assert unloaded.pressure == pytest.approx(from_zero.pressure, abs=3e-3 * 0.1)


def test_a_guard_that_accepts_everything_changes_no_bit(cell_problem: Problem) -> None:
    free, guarded = (solve(cell_problem, 0.1, guard=guard) for guard in (None, lambda _: ""))
    assert np.array_equal(free.displacement, guarded.displacement)
    assert guarded.converged and guarded.stopped_by == ""


def test_after_its_steps_are_spent_a_path_ends_with_an_equilibrium(cell_problem: Problem) -> None:
    options = SolverOptions(first_step=0.01, growth=1.01, maximum_steps=4)
    ended = solve(cell_problem, 0.1, options)
    assert not ended.converged and ended.stopped_by == "budget"
    assert ended.load_steps + ended.refused_steps == 4 and 0 < ended.load < 0.1
    assert ended.message.endswith("MPa: the budget of 4 steps is spent.")
    start = (ended.displacement, ended.hydrostatic_pressure)
    assert solve(cell_problem, ended.pressure, initial=start).newton_iterations == 1


def test_without_time_a_path_ends_at_once_and_says_so(ball: Problem) -> None:
    for problem, solved in (
        (ball, lambda options: solve(ball, 0.05, options)),
        (ball, lambda options: inflate(ball, 700.0, options)),
    ):
        ended = solved(SolverOptions(seconds=1e-9))
        assert not ended.converged and "the budget of 1e-09 s is spent" in ended.message
        assert np.array_equal(ended.displacement, np.zeros_like(problem.mesh.nodes))


def test_a_listener_sees_the_budget_being_spent(cell_problem: Problem) -> None:
    spent: list[float] = []

    def listen(event: Event) -> None:
        spent.append(event.spent)

    solve(cell_problem, 0.05, SolverOptions(first_step=0.1, maximum_steps=20), listen)
    assert spent == sorted(spent) and 0 < spent[-1] < 1


@pytest.mark.parametrize("times", [2, 30, 1000])
def test_a_limit_is_found_however_far_above_it_the_load_is(ball: Problem, times: float) -> None:
    """Growing loads over one limit: it does not move, and the last state lies just below it."""
    ended = solve(ball, times * LIMIT)
    assert not ended.converged and ended.stopped_by == "limit"
    assert ended.limit == pytest.approx(LIMIT, rel=0.01)
    assert 0.9 * LIMIT < ended.pressure <= ended.limit


def test_a_smallest_step_shrinks_with_the_position_but_never_to_nothing() -> None:
    control = StepControl(2.0, 0.35, 1e-3, scale=0.05)
    assert control.smallest_at(1.0) == control.smallest_at(0.05) == 1e-3
    assert control.smallest_at(0.005) == pytest.approx(1e-4)
    assert 0 < control.smallest_at(0.0) < 1e-8
    assert StepControl(2.0, 0.35, 1e-3).smallest_at(0.0) == 1e-3


def test_where_the_end_of_a_path_fails_the_full_tolerance_a_lower_equilibrium_is_kept(
    cell_problem: Problem, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not the unloaded body, which says nothing."""
    newton = Newton(cell_problem, Loading.of(cell_problem, 0.1), SolverOptions())
    good = solve(cell_problem, 0.05)
    usual = Newton.correct

    def stubborn(self: Newton, guess: State, load: float, *more: float) -> Attempt:
        if load > 0.49:
            return Attempt(guess, 1, "the full tolerance is not met")
        return usual(self, guess, load, *more)

    monkeypatch.setattr(Newton, "correct", stubborn)
    points = tuple(newton.point(good.state, load, 1, True) for load in (0.0, 0.3, 0.5))
    state, load, kept, tolerance = stopping._last_equilibrium(newton, good.state, 0.5, points)
    assert tolerance == newton.options.tolerance
    assert load == pytest.approx(0.98 * 0.5)
    assert [point.load for point in kept] == [0.0, 0.3, load]
    assert np.abs(state.displacement).max() < np.abs(good.displacement).max()


def test_a_path_that_never_meets_the_full_tolerance_keeps_the_last_state(ball: Problem) -> None:
    """Not the unloaded body: what was reached, corrected as far as that goes, and it says so."""
    unattainable = 1e-20
    ended = solve(ball, 0.5 * LIMIT, SolverOptions(tolerance=unattainable))
    assert not ended.converged and ended.stopped_by == "step"
    assert 0.7 < ended.load < 1 and ended.path[-1].load == ended.load
    assert "its last state is in equilibrium to" in ended.message
    there = solve(ball, ended.pressure, SolverOptions(tolerance=1e-12))
    assert ended.displacement == pytest.approx(there.displacement, abs=1e-8)


def test_no_message_has_a_zero_with_a_sign(ball: Problem) -> None:
    ended = solve(ball, -0.01, SolverOptions(seconds=1e-9))
    assert ended.message.startswith("stopped at 0 of -0.01 MPa")
    assert not np.signbit(ended.path[0].pressure) and not np.signbit(ended.pressure)
    assert figures(-0.0) == "0" and figures(-0.25) == "-0.25"
