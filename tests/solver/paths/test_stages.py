"""Loads in stages, each from the equilibrium of the one before; states at stops."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from inertia import needs_inertia
from numpy.typing import NDArray
from two_materials import HARD, layered

from solver import (
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    reaction,
    solve,
    trace,
)
from solver.errors import SolverError

Meshes = Callable[..., Mesh]
Points = NDArray[np.float64]

NEO_HOOKE = Ogden((1.0,), (2.0,))
TIGHT = SolverOptions(tolerance=1e-9)
PLANES = {"x0": 0, "y0": 1, "z0": 2}


def lead(by: float) -> Callable[[Points, float], Points]:
    """Leads a face along x by so much; it may slide in its plane."""

    def motion(positions: Points, load: float) -> Points:
        displacement = np.full(positions.shape, np.nan)
        displacement[:, 0] = load * by
        return displacement

    return motion


def led(mesh: Mesh, by: float, loads: tuple[Traction, ...] = ()) -> Problem:
    return Problem(mesh, NEO_HOOKE, Supports((), PLANES, {"x1": lead(by)}), loads=loads)


def pulled_across(mesh: Mesh, stress: float, lead_by: float = 0.0) -> Problem:
    return led(mesh, lead_by, (Traction("y1", (0.0, stress, 0.0)),))


def test_a_block_stretched_first_and_pulled_across_then_follows_the_closed_form(
    box: Meshes,
) -> None:
    """Held at 1.5 times its length, drawn across: nominal stress mu (b - 1 / (a^2 b^3))."""
    stretched = solve(led(box(), 0.5), options=TIGHT)
    stress = 0.7
    both = solve(pulled_across(stretched.problem.mesh, stress), options=TIGHT, after=stretched)
    assert both.converged
    a, b = (1 + both.displacement[:, axis].max() for axis in (0, 1))
    assert a == pytest.approx(1.5, rel=1e-12)
    assert b - 1 / (a**2 * b**3) == pytest.approx(stress, rel=1e-8)
    force = -reaction(both, "x0").force[0]
    assert force == pytest.approx(a - 1 / (a**3 * b**2), rel=1e-8)


def test_what_is_reached_does_not_depend_on_the_order_of_the_stages(box: Meshes) -> None:
    mesh = box()
    at_once = solve(pulled_across(mesh, 0.7, lead_by=0.5), options=TIGHT)
    pulled = solve(pulled_across(mesh, 0.7), options=TIGHT)
    then_led = solve(pulled_across(mesh, 0.7, lead_by=0.5), options=TIGHT, after=pulled)
    # before the second stage x1 was free to move along x only as its support allowed: held
    assert then_led.displacement == pytest.approx(at_once.displacement, abs=1e-8)


def test_a_motion_of_a_stage_starts_where_the_one_before_ended(box: Meshes) -> None:
    first = solve(led(box(), 0.3), options=TIGHT)
    second = solve(led(first.problem.mesh, 0.2), options=TIGHT, after=first)
    at_once = solve(led(first.problem.mesh, 0.5), options=TIGHT)
    assert second.displacement == pytest.approx(at_once.displacement, abs=1e-8)
    assert second.path[0].load == 0 and second.path[0].max_von_mises > 0.5


def test_a_body_that_its_support_lets_go_returns_to_rest(box: Meshes) -> None:
    """The reaction fades as a dead force: halfway half of it is left."""
    held = solve(led(box(), 0.5), options=TIGHT)
    force = -reaction(held, "x0").force[0]
    free = Problem(held.problem.mesh, NEO_HOOKE, Supports((), PLANES))
    released = solve(free, options=TIGHT, after=held, stops=(0.5,))
    assert np.abs(released.displacement).max() < 1e-8
    (halfway,) = released.at_stops
    stretch = 1 + halfway.displacement[:, 0].max()
    assert stretch - stretch**-2 == pytest.approx(force / 2, rel=1e-7)
    assert reaction(halfway, "x0").force[0] == pytest.approx(-force / 2, rel=1e-7)


def test_a_stage_with_the_loads_of_the_one_before_changes_nothing(box: Meshes) -> None:
    mesh = box((2, 1, 1))
    problem = Problem(mesh, NEO_HOOKE, Supports(("x0",)), ("z0",), (Traction("x1", (0.1, 0, 0)),))
    first = solve(problem, 0.05, TIGHT)
    again = solve(problem, 0.05, TIGHT, after=first)
    assert again.displacement == pytest.approx(first.displacement, abs=1e-10)
    assert all(point.pressure == pytest.approx(0.05) for point in again.path)


def test_the_pressure_of_a_stage_goes_on_from_that_of_the_one_before(box: Meshes) -> None:
    mesh = box((2, 1, 1))
    problem = Problem(mesh, NEO_HOOKE, Supports(("x0",)), ("z0",))
    first = solve(problem, 0.02, TIGHT)
    on = solve(problem, 0.05, TIGHT, after=first, stops=(0.03, 0.04))
    at_once = solve(problem, 0.05, TIGHT, stops=(0.03, 0.04))
    assert on.displacement == pytest.approx(at_once.displacement, abs=1e-8)
    assert [stop.pressure for stop in on.at_stops] == pytest.approx([0.03, 0.04])
    for ours, theirs in zip(on.at_stops, at_once.at_stops, strict=True):
        assert ours.displacement == pytest.approx(theirs.displacement, abs=1e-8)
    down = solve(problem, 0.0, TIGHT, after=on)
    assert np.abs(down.displacement).max() < 1e-8 and down.message == "reached 0 of 0 MPa."


def test_another_surface_under_pressure_takes_over(box: Meshes) -> None:
    mesh = box((2, 1, 1))
    below, side = (Problem(mesh, NEO_HOOKE, Supports(("x0",)), (name,)) for name in ("z0", "y1"))
    changed = solve(side, 0.03, TIGHT, after=solve(below, 0.02, TIGHT))
    assert changed.displacement == pytest.approx(solve(side, 0.03, TIGHT).displacement, abs=1e-8)


def test_a_cell_with_a_moving_plane_goes_on_in_stages(cell: Mesh, ninjaflex: Ogden) -> None:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    problem = Problem(cell, ninjaflex, supports, ("cavity",), moving_plane="x1")
    on = solve(problem, 0.06, TIGHT, after=solve(problem, 0.03, TIGHT))
    assert on.rotation == pytest.approx(solve(problem, 0.06, TIGHT).rotation, rel=1e-7)


def test_every_stop_has_its_state_whichever_way_the_path_goes(box: Meshes) -> None:
    mesh = box((2, 1, 1))
    problem = Problem(mesh, NEO_HOOKE, Supports(("x0",)), ("z0",))
    up = solve(problem, 0.05, TIGHT, stops=(0.02, 0.05, 0.04))
    start = up.displacement, up.hydrostatic_pressure
    down = solve(problem, 0.05, TIGHT, stops=(0.04, 0.02), initial=start)
    for path in (up, down):
        assert [stop.pressure for stop in path.at_stops] == pytest.approx([0.02, 0.04])
        for stop in path.at_stops:
            alone = solve(problem, stop.pressure, TIGHT)
            assert stop.converged and stop.path[-1].pressure == stop.pressure
            assert stop.displacement == pytest.approx(alone.displacement, abs=1e-8)


def test_a_path_that_stops_keeps_the_states_at_the_stops_before(box: Meshes) -> None:
    problem = Problem(box((2, 1, 1)), NEO_HOOKE, Supports(("x0",)), ("z0",))
    options = replace(TIGHT, maximum_steps=2, first_step=0.1, growth=1.01)
    stopped = solve(problem, 0.05, options, stops=(0.005, 0.04))
    assert stopped.stopped_by == "budget"
    assert [stop.pressure for stop in stopped.at_stops] == pytest.approx([0.005])


def test_a_traced_path_starts_from_a_stage_too(box: Meshes) -> None:
    held = solve(led(box(), 0.5), options=TIGHT)
    path = trace(pulled_across(held.problem.mesh, 0.4), after=held)
    far = held.problem.mesh.surface_nodes("y1")
    b = 1 + path.states[-1].displacement[far, 1].mean()
    load = path.points[-1].load
    assert load >= 1 and b - 1 / (1.5**2 * b**3) == pytest.approx(0.4 * load, rel=1e-6)


@needs_inertia
def test_a_column_that_its_support_drops_is_said_to_be_unstable_from_the_start(box: Meshes) -> None:
    """Held at its tip it bears twice Euler's load of the free one, 0.0023 N; led away it bends."""
    mesh = box((20, 2, 2), (20.0, 1.5, 1.0))
    load = (Traction("x1", (-0.0031, 0.0, 0.0)),)
    held = solve(Problem(mesh, NEO_HOOKE, Supports(("x0",), {"x1": (1, 2)}), loads=load))
    freed = Problem(mesh, NEO_HOOKE, Supports(("x0",)), loads=load)
    dropped = solve(freed, after=held)
    assert held.converged and not dropped.converged and dropped.load == 0
    assert dropped.stable is False and "the stage begins with is unstable" in dropped.message
    assert np.array_equal(dropped.displacement, held.displacement)


def test_a_stage_with_other_materials_is_left_by_what_they_do_not_bear(box: Meshes) -> None:
    mesh = layered()
    problem = pulled_across(mesh, 0.7)
    stiffer = replace(problem, materials={"hard": HARD})
    first = solve(problem, options=TIGHT)
    then, at_once = solve(stiffer, options=TIGHT, after=first), solve(stiffer, options=TIGHT)
    assert np.abs(first.displacement - at_once.displacement).max() > 0.1
    assert then.displacement == pytest.approx(at_once.displacement, abs=1e-8)


def test_a_stage_with_other_regions_is_refused(box: Meshes) -> None:
    mesh = layered()
    plain, layers = (solve(pulled_across(each, 0.1)) for each in (replace(mesh, regions={}), mesh))
    for first, then in ((plain, layers), (layers, plain)):
        with pytest.raises(SolverError, match=r"after: .* the same regions; it has others"):
            solve(then.problem, after=first)


def test_a_stage_on_another_mesh_is_refused(box: Meshes) -> None:
    first: Solution = solve(led(box((1, 1, 1)), 0.1))
    with pytest.raises(SolverError, match="same mesh"):
        solve(led(box((2, 1, 1)), 0.1), after=first)


@pytest.mark.parametrize("stop", [0.02, 0.06])
def test_a_stop_outside_the_pressures_of_a_stage_is_refused(box: Meshes, stop: float) -> None:
    problem = Problem(box((1, 1, 1)), NEO_HOOKE, Supports(("x0",)), ("z0",))
    first = solve(problem, 0.03)
    with pytest.raises(SolverError, match=r"between 0\.03 and the pressure of 0.05 MPa"):
        solve(problem, 0.05, after=first, stops=(stop,))
