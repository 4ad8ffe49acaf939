"""Limits are where the load turns or stability changes, between equilibria that were found."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from inertia import needs_inertia
from meshes import box_mesh, doubled_mesh, tube_mesh

from solver import (
    Limit,
    Mesh,
    Ogden,
    PathPoint,
    Problem,
    RigidPlane,
    SolverOptions,
    Supports,
    Trace,
    Traction,
    solve,
    trace,
)
from solver.errors import SolverError

Array = np.ndarray
NEO_HOOKE = Ogden.neo_hooke(1.0)
PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})

LENGTH, WIDTH, HEIGHT = 20.0, 1.5, 1.0
EULER = np.pi**2 * 3.0 * WIDTH * HEIGHT**3 / 12 / (4 * LENGTH**2)
"""Critical dead end load of a column clamped at one end, free at the other, E = 3, N."""


def column(mesh: Mesh, root: str, tip: str, axis: int, loads: float) -> Problem:
    """A clamped column under so many Euler loads."""
    traction = [0.0, 0.0, 0.0]
    traction[axis] = -loads * EULER / (WIDTH * HEIGHT)
    load = Traction(tip, (traction[0], traction[1], traction[2]))
    return Problem(mesh, NEO_HOOKE, Supports((root,)), loads=(load,))


def lopsided(loads: float) -> Problem:
    """On a mesh without mirror symmetry: an imperfection that parts the branches."""
    return column(box_mesh((20, 2, 2), (LENGTH, WIDTH, HEIGHT)), "x0", "x1", 0, loads)


def symmetric(loads: float) -> Problem:
    """On a mesh and its mirror image at the column's middle plane."""
    half = box_mesh((1, 2, 20), (HEIGHT / 2, WIDTH, LENGTH))
    return column(doubled_mesh(half), "z0", "z1", 2, loads)


@needs_inertia
@pytest.mark.parametrize(
    ("pose", "loads", "first_step"),
    [(lopsided, 5.0, 0.1), (symmetric, 2.0, 0.03), (symmetric, 3.0, 0.1), (symmetric, 8.0, 0.3)],
)
@pytest.mark.thorough
def test_a_column_buckles_at_the_same_load_whatever_mesh_and_first_step(
    pose: Callable[[float], Problem], loads: float, first_step: float
) -> None:
    """1.012 to 1.020 Euler loads on these meshes: the clamp shortens the column a little."""
    options = SolverOptions(first_step=first_step)
    path = trace(pose(loads), options=options, until=lambda point: point.stable is False)
    (limit,) = path.limits
    before, behind = (loads * point.load for point in limit.between)
    assert limit.kind == "bifurcation" and limit.point == limit.between[1]
    assert limit.between[0].stable and not limit.between[1].stable
    assert 1.008 < before < behind < 1.025
    assert behind - before < 3e-3


@needs_inertia
def test_a_walk_by_load_says_where_a_column_buckles() -> None:
    solution = solve(symmetric(2.0))
    assert not solution.converged and solution.stopped_by == "limit"
    assert 2.0 * (solution.limit or 0.0) == pytest.approx(1.0145, abs=5e-3)
    assert "stability is lost at" in solution.message


@pytest.mark.parametrize(
    ("loads", "linear_solver"),
    [
        pytest.param(3.0, "superlu", marks=pytest.mark.slow),
        (3.0, "auto"),
        pytest.param(8.0, "auto", marks=[needs_inertia, pytest.mark.slow]),
    ],
)
@pytest.mark.thorough
def test_a_walk_that_bends_away_before_it_buckles_says_where(
    loads: float, linear_solver: str
) -> None:
    solution = solve(lopsided(loads), options=SolverOptions(linear_solver=linear_solver))
    assert not solution.converged and solution.stopped_by == "limit"
    assert loads * (solution.limit or 0.0) == pytest.approx(1.0185, abs=5e-3)
    assert solution.stable is not False and "stability is lost" in solution.message


@pytest.mark.slow
@needs_inertia
def test_so_does_one_in_a_stage_that_begins_near_the_critical_load() -> None:
    solution = solve(lopsided(3.0), after=solve(lopsided(0.8)))
    assert solution.stopped_by == "limit"
    assert 0.8 + 2.2 * (solution.limit or 0.0) == pytest.approx(1.0185, abs=5e-3)


@needs_inertia
def test_a_ring_under_pressure_from_outside_buckles_at_levys_load() -> None:
    """p = 3 E I / ((1 - nu^2) R^3) in plane strain; the load is passed by 2 and by 50 times."""
    mesh = tube_mesh(9.5, 10.5, 1.0, (1, 16, 1), np.pi)
    symmetry = {"start": 1, "end": 1, "z0": 2, "z1": 2}
    supports = Supports(symmetry=symmetry, nodes={(9.5, 0.0, 0.0): 0})
    ring = Problem(mesh, NEO_HOOKE, supports, ("outside",))
    for pressure in (0.003, 0.05):
        solution = solve(ring, pressure)
        assert solution.stopped_by == "limit"
        assert solution.limit == pytest.approx(0.001, rel=0.015)


def test_a_bracket_that_could_not_be_narrowed_is_told_as_one() -> None:
    before, behind = (PathPoint(0.1 * load, 0.0, 1, 0.0, 0.0, load) for load in (0.5, 0.8))
    text = Limit("bifurcation", behind, (before, behind)).describe
    assert (
        text(0.1) == "stability is lost between p = 0.05 MPa and p = 0.08 MPa, where the body "
        "buckles"
    )
    assert "between 50 % of the load and 80 % of the load" in text(0.0)


@pytest.mark.parametrize("gap", [0.0, 0.1])
def test_a_plane_that_moves_is_load_enough_also_before_it_touches(gap: float) -> None:
    plane = RigidPlane("x1", 1e-4, (-1, 0, 0), (1 + gap, 0, 0), lambda load: (-0.4 * load, 0, 0))
    mesh = box_mesh((2, 2, 2), (1.0, 1.0, 1.0))
    path = trace(Problem(mesh, NEO_HOOKE, PLANES, contacts=(plane,)))
    assert_monotonic(path)
    assert path.message == "the asked load is reached."
    end = mesh.surface_nodes("x1")
    for point, state in zip(path.points, path.states, strict=True):
        expected = min(1.0, 1 + gap - 0.4 * point.load)
        assert 1 + state.displacement[end, 0] == pytest.approx(expected, abs=4e-4)


def test_both_sides_of_a_limit_point_are_lower_and_near(sphere: Callable[..., Mesh]) -> None:
    ball = Problem(sphere(10.0, 11.0, 1, 2), NEO_HOOKE, PLANES, ("inside",))
    (limit,) = trace(ball, 0.2, steps=25).limits
    assert limit.kind == "maximum"
    loads = [point.load for point in limit.between]
    assert all(0.95 * limit.point.load < load <= limit.point.load for load in loads)
    volumes = [point.volume for point in (limit.between[0], limit.point, limit.between[1])]
    assert volumes == sorted(volumes)


def assert_monotonic(path: Trace) -> None:
    loads = [point.load for point in path.points]
    assert loads == sorted(set(loads)) and loads[0] == 0.0
    assert not path.limits


def apart(positions: Array, load: float) -> Array:
    """Both ends of a sheet led apart by 7.5 mm, clamped sideways."""
    motion = np.zeros(positions.shape)
    motion[:, 0] = np.where(positions[:, 0] > 25, 3.75, -3.75) * load
    return motion


@pytest.mark.parametrize("quarter", [False, True])
def test_a_thin_sheet_that_is_stretched_is_not_followed_into_compression(quarter: bool) -> None:
    """Bending is so soft that a lopsided mesh makes the first tangent point out of the plane."""
    if quarter:
        mesh = box_mesh((5, 2, 1), (25.0, 10.0, 0.1))
        supports = Supports((), {"x0": 0, "y0": 1}, {"x1": lambda x, load: apart(x + 1, load)})
    else:
        mesh = box_mesh((10, 4, 1), (50.0, 20.0, 0.1))
        supports = Supports((), {}, {"x0": apart, "x1": apart})
    path = trace(Problem(mesh, NEO_HOOKE, supports), steps=5 if quarter else 25)
    assert_monotonic(path)
    assert quarter or path.message == "the asked load is reached."


MOTIONS = {
    "stops": ([0, 0.1, 1], [0, 1, 1]),
    "turns back": ([0, 0.3, 1], [0, 1, -0.5]),
    "starts late": ([0, 0.4, 1], [0, 0, 1]),
    "goes by stairs": ([0, 0.2, 0.4, 0.6, 1], [0, 0.5, 0.5, 1, 1]),
}


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("pressure", [0.0, 0.1])
def test_a_kink_of_a_led_motion_is_no_limit(motion: str, pressure: float) -> None:
    def led(positions: Array, load: float) -> Array:
        displacement = np.full(positions.shape, np.nan)
        displacement[:, 0] = 1.2 * np.interp(load, *MOTIONS[motion])
        return displacement

    supports = Supports(symmetry=PLANES.symmetry, prescribed={"x1": led})
    bar = Problem(box_mesh((4, 1, 1), (4.0, 1.0, 1.0)), NEO_HOOKE, supports, ("y1",))
    path = trace(bar, pressure)
    assert_monotonic(path)
    assert path.message == "the asked load is reached."
    last = max(number for number, point in enumerate(path.points) if point.load < 1)
    stop = path.points[last].load * (pressure or 1.0)
    walked = solve(bar, pressure, SolverOptions(tolerance=1e-9), stops=[stop]).at_stops[0]
    assert path.states[last].displacement == pytest.approx(walked.displacement, abs=1e-4)


def test_a_bar_that_is_pulled_has_no_limit() -> None:
    """lambda^2 - 1/lambda = p/mu rises for ever."""
    bar = Problem(box_mesh((4, 1, 1), (4.0, 1.0, 1.0)), NEO_HOOKE, PLANES, ("x1",))
    assert_monotonic(trace(bar, -2.0, steps=12))


def test_a_path_without_any_load_is_refused() -> None:
    body = Problem(box_mesh((1, 1, 1)), NEO_HOOKE, Supports(("x0",)))
    with pytest.raises(
        SolverError, match="trace: no load moves the body: pressure = 0 MPa, 0 dead"
    ):
        trace(body)


def test_a_motion_that_leads_every_unknown_can_be_traced() -> None:
    """Nothing of a body of one element is free where all its nodes are led but its pressure."""

    def sheared(positions: Array, load: float) -> Array:
        return load * np.stack([0.5 * positions[:, 1], 0 * positions[:, 0], 0 * positions[:, 0]], 1)

    faces = dict.fromkeys(("x0", "x1", "y0", "y1", "z0", "z1"), sheared)
    material = Ogden((1.0,), (2.0,), bulk_modulus=50.0)
    path = trace(Problem(box_mesh((2, 2, 2)), material, Supports((), {}, faces)))
    assert_monotonic(path)
    assert path.message == "the asked load is reached."
