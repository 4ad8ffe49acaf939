"""Volume control: limits and branches, loads that act first, pressure from outside, states."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from inertia import needs_inertia
from meshes import cell_mesh, mapped_box, sphere_mesh, tube_mesh
from thick_walls import (
    closed_tube_at,
    highest_in_closed_tube,
    sphere_outside,
    sphere_pressure,
    tube_state,
)
from two_materials import HARD, beyond

from solver import (
    Contact,
    Mesh,
    Ogden,
    PathPoint,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    cavity_volume,
    inflate,
    peak_von_mises,
    reaction,
    solve,
    write_vtu,
)
from solver.errors import SolverError
from solver.nonlinear.checkpoint import Checkpoint
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.paths.bordering import equilibrium_point
from solver.paths.volume.held import HeldVolume, volume_of

Meshes = Callable[..., Mesh]
Points = np.ndarray

NEO_HOOKE = Ogden((1.0,), (2.0,))
NINJAFLEX = Ogden(mu=(0.19825, 3.2778), alpha=(3.05, -0.0054))
PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
TIGHT = SolverOptions(tolerance=1e-8)
LIMIT = highest_in_closed_tube(NINJAFLEX, 5.0, 6.0)


def tube(around: int, layers: int) -> Problem:
    """Half of a slice of a tube with closed ends that are free to move."""

    def place(cube: Points) -> Points:
        radius, angle = 5 + cube[:, 1], np.pi * cube[:, 2]
        return np.stack([2 * cube[:, 0], radius * np.sin(angle), -radius * np.cos(angle)], 1)

    supports = Supports(symmetry={"x0": 0, "z0": 1, "z1": 1})
    mesh = mapped_box((1, layers, around), place)
    return Problem(mesh, NINJAFLEX, supports, ("y0",), moving_plane="x1")


def at_rest(problem: Problem) -> float:
    mesh = problem.mesh
    return cavity_volume(mesh, np.zeros_like(mesh.nodes), problem.pressurised)


def grown(problem: Problem, factor: float, first_step: float | None = None) -> Solution:
    """With so many times the volume at rest."""
    return inflate(problem, factor * at_rest(problem), replace(TIGHT, first_step=first_step))


@pytest.mark.parametrize("first_step", [0.02, 0.1, 0.3])
def test_the_pressure_that_loses_stability_is_the_maximum_not_the_last_step(
    first_step: float,
) -> None:
    pumped = grown(tube(6, 1), 5.0, first_step=first_step)
    assert pumped.converged
    assert pumped.limit == pytest.approx(LIMIT, rel=1e-4)
    assert f"it is unstable beyond {LIMIT:.4g} MPa, at 255" in pumped.message
    highest = max(pumped.path, key=lambda point: point.pressure)
    assert highest.pressure == pumped.limit
    assert not pumped.bifurcations


@needs_inertia
@pytest.mark.parametrize("first_step", [0.02, 0.05, 0.1, 0.3])
def test_a_path_keeps_to_the_closed_form_or_says_where_another_branch_begins(
    first_step: float,
) -> None:
    """On a mesh that is coarse around, other shapes branch off at 7.3 times the volume."""
    problem = tube(6, 1)
    pumped = grown(problem, 10.2, first_step=first_step)
    pressure = closed_tube_at(NINJAFLEX, 5.0, 6.0, 10.2)
    assert pumped.converged
    assert (pumped.stable_at_volume is False) == (abs(pumped.pressure / pressure - 1) < 1e-3)
    assert "another branch" in pumped.message
    begins = pumped.bifurcations[0]
    assert begins in pumped.path
    assert begins.volume == pytest.approx(7.3 * at_rest(problem), rel=0.04)
    assert pumped.limit == pytest.approx(LIMIT, rel=1e-4)


@needs_inertia
@pytest.mark.parametrize("contacts", [(), (Contact("y1", 0.01, 2, -1e3),)])
def test_small_steps_take_the_stable_branch_and_say_so(contacts: tuple[Contact, ...]) -> None:
    """Also where a problem has contacts of which none is touched."""
    problem = replace(tube(6, 1), contacts=contacts)
    volume = 10.2 * at_rest(problem)
    pumped = inflate(problem, volume, replace(TIGHT, first_step=0.02, growth=1.001))
    pressure = closed_tube_at(NINJAFLEX, 5.0, 6.0, 10.2)
    assert pumped.converged and pumped.stable_at_volume
    assert 0.99 < pumped.pressure / pressure < 0.995
    assert "it turns onto another branch" in pumped.message
    assert pumped.bifurcations[0].volume == pytest.approx(7.3 * at_rest(problem), rel=0.04)


@needs_inertia
def test_where_no_branch_begins_none_is_reported() -> None:
    """A mesh with two layers has no such branch."""
    pumped = grown(tube(3, 2), 10.2)
    assert pumped.pressure == pytest.approx(closed_tube_at(NINJAFLEX, 5.0, 6.0, 10.2), rel=2e-4)
    assert pumped.bifurcations == () and "branch" not in pumped.message
    assert all(point.stable_at_volume for point in pumped.path)


def test_a_path_that_bends_smoothly_has_no_branches(bellows: Meshes, ninjaflex: Ogden) -> None:
    mesh = bellows(1)
    supports = Supports(clamped=("root",), symmetry={"symmetry": 1})
    pumped = grown(Problem(mesh, ninjaflex, supports, ("cavity",)), 2.5)
    assert pumped.converged and pumped.rotation > 20
    assert pumped.bifurcations == () and pumped.limit is None


@needs_inertia
@pytest.mark.parametrize(("stretch", "falls"), [(1.1, False), (2.0, True)])
def test_modes_at_a_held_volume_are_those_of_the_bordered_tangent(
    stretch: float, falls: bool
) -> None:
    problem = Problem(sphere_mesh(10.0, 11.0, 1, 2), NINJAFLEX, PLANES, ("inside",))
    pumped = grown(problem, stretch**3)
    newton = Newton(problem, Loading.of(problem, 1.0), TIGHT)
    found = equilibrium_point(newton, pumped.state, pumped.pressure)
    held = HeldVolume.of(newton, found, volume_of(newton, pumped.state))
    equilibrium = newton.evaluate(pumped.state, pumped.pressure)
    bordered = with_border(newton, equilibrium.tangent, equilibrium.force)
    negative = int((np.linalg.eigvalsh(bordered) < 0).sum())
    assert (held.compliance < 0) == falls
    assert held.unstable_modes == negative - 1 - len(problem.mesh.vertices)


def with_border(newton: Newton, values: Points, force: Points) -> Points:
    """The dense tangent, bordered by the derivative of the volume."""
    from scipy.sparse import csr_array

    pattern, size = newton.assembly.pattern, len(force)
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=(size, size)).toarray()
    tangent = upper + np.triu(upper, 1).T
    return np.block([[tangent, force[:, None]], [force[None], np.zeros((1, 1))]])


def test_without_inertia_the_limit_is_found_all_the_same() -> None:
    options = replace(TIGHT, linear_solver="superlu")
    problem = tube(3, 1)
    pumped = inflate(problem, 5 * at_rest(problem), options)
    assert pumped.limit == pytest.approx(LIMIT, rel=1e-3)
    assert all(point.stable_at_volume is None for point in pumped.path)


def stretched_along(to: float) -> Callable[[Points, float], Points]:
    def motion(positions: Points, load: float) -> Points:
        displacement = np.full(positions.shape, np.nan)
        displacement[:, 2] = load * (to - 1) * positions[:, 2]
        return displacement

    return motion


@pytest.mark.parametrize("along", [1.5, 0.8])
def test_a_tube_led_to_a_length_first_then_inflated_follows_the_closed_form(along: float) -> None:
    mesh = tube_mesh(5.0, 6.0, 1.0, (2, 3, 1), np.pi / 2)
    symmetry = {"start": 1, "end": 0, "z0": 2}
    supports = Supports((), symmetry, {"z1": stretched_along(along)})
    problem = Problem(mesh, NINJAFLEX, supports, ("inside",))
    stretches = [factor / np.sqrt(along) for factor in (1.2, 2.0)]
    volumes = [at_rest(problem) * stretch**2 * along for stretch in stretches]
    pumped = inflate(problem, volumes[-1], TIGHT, stops=volumes)
    assert pumped.converged and len(pumped.at_stops) == 1
    for stretch, volume, found in zip(stretches, volumes, (*pumped.at_stops, pumped), strict=True):
        pressure, force = tube_state(NINJAFLEX, 5.0, 6.0, stretch, along)
        axial = (force + pressure * np.pi * (5 * stretch) ** 2) / 4
        assert found.pressure == pytest.approx(pressure, rel=1e-4)
        assert found.path[-1].volume == pytest.approx(volume, rel=1e-9)
        assert reaction(found, "z1").force[2] == pytest.approx(axial, rel=1e-3)


def test_dead_loads_act_wholly_before_the_volume_changes() -> None:
    """A hollow sphere drawn outwards by dead tractions t: they leave t B^2 / b^2 on its outside."""
    stress = 0.05
    mesh = sphere_mesh(10.0, 12.0, 2, 5)
    drawn = Traction("outside", lambda x: stress * x / np.linalg.norm(x, axis=1, keepdims=True))
    problem = Problem(mesh, NEO_HOOKE, PLANES, ("inside",), (drawn,))
    loaded = solve(problem, 0.0, TIGHT)
    pumped = grown(problem, 1.4**3)
    start = next(point for point in pumped.path if point.load == 1)
    assert start.pressure == 0
    assert start.volume == pytest.approx(loaded.path[-1].volume, rel=1e-9)
    outside = stress * (12 / sphere_outside(10.0, 12.0, 1.4)) ** 2
    pressure = sphere_pressure(NEO_HOOKE, 10.0, 12.0, 1.4) - outside
    assert pumped.pressure == pytest.approx(pressure, rel=1e-3)
    assert all(point.load == 1 for point in pumped.path if point.pressure)


def test_loads_that_are_not_reached_end_the_walk_before_any_pressure() -> None:
    mesh = sphere_mesh(10.0, 12.0, 1, 2)
    drawn = Traction("outside", lambda x: 0.1 * x / np.linalg.norm(x, axis=1, keepdims=True))
    problem = Problem(mesh, NEO_HOOKE, PLANES, ("inside",), (drawn,))
    ended = inflate(problem, 1000.0, SolverOptions(maximum_steps=2))
    assert not ended.converged and ended.pressure == 0 and ended.stopped_by == "budget"
    assert ended.message.startswith("the loads before the volume: stopped at")
    assert all(point.pressure == 0 for point in ended.path)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_pressure_from_outside_follows_the_closed_form(sign: float) -> None:
    """A hollow sphere: the volume is that of the ball within its outside, of either sign."""
    problem = Problem(sphere_mesh(5.0, 10.0, 3, 4), NEO_HOOKE, PLANES, ("outside",))
    whole = sign * abs(at_rest(problem))
    volumes = [whole * (sphere_outside(5.0, 10.0, at) / 10) ** 3 for at in (0.95, 0.9)]
    pumped = inflate(problem, volumes[-1], TIGHT, stops=volumes)
    assert pumped.converged and at_rest(problem) < 0
    for stretch, found in zip((0.95, 0.9), (*pumped.at_stops, pumped), strict=True):
        pressure = -sphere_pressure(NEO_HOOKE, 5.0, 10.0, stretch)
        assert found.pressure == pytest.approx(pressure, rel=2e-3)
    assert pumped.path[-1].volume == pytest.approx(volumes[-1], rel=1e-9)


def test_a_block_squeezed_from_all_sides_takes_k_times_its_loss_of_volume(box: Meshes) -> None:
    material = Ogden((1.0,), (2.0,), bulk_modulus=5.0)
    squeezed = grown(Problem(box((1, 1, 1)), material, PLANES, ("x1", "y1", "z1")), 0.8)
    assert squeezed.pressure == pytest.approx(5.0 * (1 - 0.8), rel=1e-8)


@needs_inertia
def test_a_thin_sphere_pressed_from_outside_buckles_where_shells_do() -> None:
    """Zoelly 1915: p = 2 E (t / R)^2 / sqrt(3 (1 - nu^2)); thickness and mesh add a little."""
    problem = Problem(sphere_mesh(10.0, 12.0, 1, 4), NEO_HOOKE, PLANES, ("outside",))
    pressed = grown(problem, 0.85)
    thin = 2 * 3.0 * (2 / 11) ** 2 / np.sqrt(3 * 0.75)
    assert pressed.limit == pytest.approx(thin, rel=0.15)
    assert pressed.bifurcations[0].stable_at_volume is False
    assert "unstable at a held volume too" in pressed.message


def test_a_flat_membrane_is_blown_up_from_no_volume(box: Meshes, ninjaflex: Ogden) -> None:
    supports = Supports(clamped=("x1", "y1"), symmetry={"x0": 0, "y0": 1})
    problem = Problem(box((3, 3, 1), (10.0, 10.0, 0.5)), ninjaflex, supports, ("z0",))
    pumped = inflate(problem, 80.0, TIGHT)
    again = solve(problem, pumped.pressure, TIGHT)
    assert again.path[-1].volume == pytest.approx(80.0, rel=1e-5)


def test_a_volume_goes_on_from_a_stage_beyond_the_limit_of_the_pressure() -> None:
    """There no pressure holds the body, and only the volume can go on."""
    problem = tube(12, 1)
    first = grown(problem, 4.0, 0.02)
    assert first.limit is not None and first.stable is False
    on = inflate(problem, 4.5 * at_rest(problem), TIGHT, after=first)
    at_once = grown(problem, 4.5, 0.02)
    assert on.pressure == pytest.approx(at_once.pressure, rel=1e-6)
    assert on.path[0].volume == pytest.approx(first.path[-1].volume)
    assert on.load_steps < at_once.load_steps


def test_a_goal_a_thousand_times_the_volume_is_reached() -> None:
    """Ten times as large: its first step, a tenth, turns elements inside out."""
    ball = Problem(sphere_mesh(10.0, 12.0, 1, 2), NEO_HOOKE, PLANES, ("inside",))
    rest = cavity_volume(ball.mesh, np.zeros_like(ball.mesh.nodes), ("inside",))
    solution = inflate(ball, 1000 * rest)
    assert solution.converged and solution.refused_steps > 0
    expected = sphere_pressure(NEO_HOOKE, 10.0, 12.0, 10.0)
    assert solution.pressure == pytest.approx(expected, rel=3e-3)


def test_the_volume_that_there_is_already_takes_no_step() -> None:
    """Also where it is off by rounding."""
    ball = Problem(sphere_mesh(10.0, 12.0, 1, 2), NEO_HOOKE, PLANES, ("inside",))
    blown = inflate(ball, 1500.0)
    for wanted in (1500.0, 1500.0 * (1 + 2e-16), blown.path[-1].volume):
        again = inflate(ball, wanted, after=blown)
        assert again.converged and again.load_steps == 0
        assert again.pressure == blown.pressure
    higher = inflate(ball, 1600.0, stops=(1500.0 * (1 + 2e-16),), after=blown)
    assert higher.converged and len(higher.at_stops) == 1
    assert higher.at_stops[0].pressure == blown.pressure


def test_a_volume_goes_on_from_a_pressure_with_other_loads_applied_first() -> None:
    """Blown up, pulled outwards at that pressure, blown up further: as pulled first."""
    mesh = sphere_mesh(10.0, 12.0, 1, 3)
    traction = (Traction("outside", lambda x: 0.1 * x / np.linalg.norm(x, axis=1)[:, None]),)
    plain = Problem(mesh, NEO_HOOKE, PLANES, ("inside",))
    pulled = Problem(mesh, NEO_HOOKE, PLANES, ("inside",), traction)
    wanted = 1.5 * cavity_volume(mesh, np.zeros_like(mesh.nodes), ("inside",))
    blown = solve(plain, 0.05, TIGHT)
    on = inflate(pulled, wanted, TIGHT, after=blown)
    at_once = inflate(pulled, wanted, TIGHT)
    assert on.converged and on.path[0].pressure == pytest.approx(0.05)
    assert on.pressure == pytest.approx(at_once.pressure, rel=1e-6)
    assert on.displacement == pytest.approx(at_once.displacement, abs=1e-6)


def test_a_volume_goes_on_from_a_stage_with_other_materials() -> None:
    """They meet the pressure first: the volume starts from where that leaves them."""
    cells = np.ones((3, 2, 3), int)
    cells[1, 0, 1] = 2
    mesh = cell_mesh(cells, [np.arange(4.0), np.array([0, 1.0, 1.6]), np.array([0, 0.6, 1.6, 2.0])])
    mesh = mesh.with_regions({"lid": beyond(mesh, 2, 1.6)})
    soft = Problem(mesh, Ogden.neo_hooke(1.0), Supports(("x0",), {"y0": 1}), ("cavity",))
    stiff = replace(soft, materials={"lid": HARD})
    first, there = solve(soft, 0.1), solve(stiff, 0.1)
    before, start = first.path[-1].volume, there.path[-1].volume
    assert start < before - 1e-3
    goal = before + 0.1 * (before - start)
    found = inflate(stiff, goal, after=first)
    assert found.converged, found.message
    loaded = next(point for point in found.path if point.load == 1)
    assert loaded.pressure == pytest.approx(0.1)
    assert loaded.volume == pytest.approx(start, rel=1e-6)
    assert found.pressure == pytest.approx(inflate(stiff, goal).pressure, rel=1e-6)


def test_states_at_stops_are_whole_solutions(tmp_path: Path) -> None:
    problem = Problem(sphere_mesh(10.0, 12.0, 1, 2), NINJAFLEX, PLANES, ("inside",))
    rest = at_rest(problem)
    pumped = inflate(problem, 6 * rest, TIGHT, stops=[2 * rest, 5 * rest])
    early, late = pumped.at_stops
    for stop, factor in ((early, 2), (late, 5)):
        volume = cavity_volume(problem.mesh, stop.displacement, ("inside",))
        assert volume == pytest.approx(factor * rest, rel=1e-9)
        assert stop.converged and stop.message.startswith(f"reached {volume:.6g} mm³, at ")
        assert stop.path == pumped.path[: len(stop.path)]
    assert peak_von_mises(early).value < peak_von_mises(late).value
    assert early.limit is None and late.limit == pumped.limit is not None
    write_vtu(tmp_path / "stop.vtu", early)
    assert (tmp_path / "stop.vtu").stat().st_size > 0


def test_a_checkpoint_keeps_what_is_known_of_held_volumes(tmp_path: Path) -> None:
    problem = Problem(sphere_mesh(10.0, 12.0, 1, 2), NINJAFLEX, PLANES, ("inside",))
    points = tuple(
        PathPoint(0.1, 2.0, 3, 4.0, 5.0, 1.0, stable, held)
        for stable, held in ((True, None), (None, False), (False, True))
    )
    zero = Loading.of(problem, 1.0).start
    Checkpoint(zero, 0.5, 0.1, zero, points, (1, 2, 3, 4)).save(tmp_path / "point")
    assert Checkpoint.load_from(tmp_path / "point").points == points


@pytest.mark.parametrize(
    ("volumes", "words"),
    [
        ((-1.0,), "must be positive"),
        ((0.0,), "must be positive"),
        ((200.0, 900.0, 800.0), "lie between"),
        ((float("nan"),), "must be finite"),
        ((float("inf"), 800.0), "must be finite"),
    ],
)
def test_volumes_out_of_order_are_refused(volumes: tuple[float, ...], words: str) -> None:
    ball = Problem(sphere_mesh(10.0, 12.0, 1, 2), NINJAFLEX, PLANES, ("inside",))
    with pytest.raises(SolverError, match=words):
        inflate(ball, volumes[-1], stops=volumes[:-1])


def test_surfaces_that_enclose_no_volume_are_refused(box: Meshes) -> None:
    bar = box((1, 1, 1))
    with pytest.raises(SolverError, match="a surface must be pressurised"):
        inflate(Problem(bar, NINJAFLEX, PLANES), 10.0)
    with pytest.raises(SolverError, match=r"'x1' enclose no volume: their rim is free at \(1, "):
        inflate(Problem(bar, NINJAFLEX, PLANES, ("x1",)), 10.0)
    with pytest.raises(SolverError, match="cannot change, whatever the pressure"):
        inflate(Problem(bar, NINJAFLEX, PLANES, ("x1", "y1", "z1")), 0.9)


def test_an_opening_that_slides_in_another_plane_normal_to_y_is_refused() -> None:
    """There the integral that stands for the volume is another quantity."""
    mesh = tube_mesh(5.0, 6.0, 1.0, (1, 2, 1), np.pi / 2)
    along_y = Mesh(mesh.nodes[:, [1, 2, 0]] + [0.0, 1.0, 0.0], mesh.tets, mesh.surfaces)
    symmetry = {"start": 0, "end": 2, "z0": 1, "z1": 1}
    with pytest.raises(SolverError, match="slides in a plane normal to y"):
        inflate(Problem(along_y, NINJAFLEX, Supports((), symmetry), ("inside",)), 10.0)
