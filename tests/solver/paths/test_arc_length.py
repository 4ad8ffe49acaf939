"""Paths through limit points, volume control, and what is said of them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from films import BentStrip
from inertia import needs_inertia
from meshes import box_mesh

from solver import (
    Membrane,
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Trace,
    Traction,
    cavity_volume,
    inflate,
    solve,
    trace,
)

Meshes = Callable[..., Mesh]
Array = np.ndarray
CASE = json.loads((Path(__file__).parents[1] / "data/thick_sphere.json").read_text())["cases"][0]
NINJAFLEX = CASE["reference"]["NinjaFlex_A10_B12"]
MAXIMUM = NINJAFLEX["limit_points"][0]
PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
TRELOAR = Ogden((0.4095, 0.003, 0.01), (1.3, 5.0, -2.0))


def volume_at(stretch: float) -> float:
    """Volume inside an octant whose inner radius of 10 mm is stretched."""
    return np.pi * (10 * stretch) ** 3 / 6


def stretch_at(volume: float) -> float:
    return float(np.cbrt(6 * volume / np.pi)) / 10


@pytest.fixture(scope="module")
def ball(sphere: Meshes, ninjaflex: Ogden) -> Problem:
    return Problem(sphere(10.0, 12.0, 2, 4), ninjaflex, PLANES, ("inside",))


@pytest.fixture(scope="module")
def traced(ball: Problem) -> Trace:
    return trace(ball, 1.0, until=lambda point: stretch_at(point.volume) > 1.7)


@pytest.fixture(scope="module")
def pumped(ball: Problem) -> Solution:
    return inflate(ball, volume_at(1.7), stops=[volume_at(1.1), volume_at(1.5)])


def test_the_path_passes_the_limit_point_of_the_closed_form(traced: Trace) -> None:
    (limit,) = traced.limits
    assert limit.kind == "maximum"
    assert limit.point.pressure == pytest.approx(MAXIMUM["P"], rel=3e-3)
    assert stretch_at(limit.point.volume) == pytest.approx(MAXIMUM["lambda_a"], rel=0.01)


@needs_inertia
def test_a_balloon_is_stable_up_to_its_limit_point_and_not_beyond(traced: Trace) -> None:
    peak = traced.points.index(traced.limits[0].point)
    assert all(point.stable for point in traced.points[:peak])
    assert not any(point.stable for point in traced.points[peak + 1 :])
    assert len(traced.points) > peak + 2


@needs_inertia
def test_volume_control_meets_the_closed_form_on_both_sides_of_the_limit(pumped: Solution) -> None:
    assert pumped.converged, pumped.message
    for stretch, stable in (("1.1", True), ("1.5", False)):
        volume = volume_at(float(stretch))
        (point,) = (p for p in pumped.path if p.volume == pytest.approx(volume, rel=1e-9))
        expected = NINJAFLEX["P_of_lambda_a"][stretch]
        assert point.pressure == pytest.approx(expected, rel=5e-3)
        assert point.stable is stable


def test_volume_control_and_arc_length_find_the_same_path(ball: Problem, traced: Trace) -> None:
    for point in (traced.points[3], traced.points[-1]):
        pumped = inflate(ball, point.volume)
        assert pumped.pressure == pytest.approx(point.pressure, rel=1e-6)
        assert pumped.stable is point.stable


def test_an_inflated_body_is_in_equilibrium_under_its_pressure(
    ball: Problem, pumped: Solution
) -> None:
    half = inflate(ball, volume_at(1.2))
    again = solve(ball, half.pressure, SolverOptions(tolerance=1e-8))
    assert cavity_volume(ball.mesh, again.displacement, ("inside",)) == pytest.approx(
        volume_at(1.2), rel=1e-6
    )


@needs_inertia
def test_a_pressure_beyond_the_limit_is_reported_as_such(ball: Problem) -> None:
    solution = solve(ball, 1.5)
    assert not solution.converged
    assert solution.limit == pytest.approx(MAXIMUM["P"], rel=3e-3)
    assert f"limit at p = {solution.limit:.4g} MPa" in solution.message
    assert solution.stable and solution.pressure < solution.limit


def test_without_inertia_the_determinant_still_tells_an_unstable_state(ball: Problem) -> None:
    """SuperLU knows the sign of the determinant only: enough for one unstable mode."""
    options = SolverOptions(linear_solver="superlu")
    path = trace(ball, 1.0, options, until=lambda point: stretch_at(point.volume) > 1.6)
    peak = path.points.index(path.limits[0].point)
    assert all(point.stable is None for point in path.points[:peak])
    assert all(point.stable is False for point in path.points[peak + 1 :])
    beyond = solve(ball, 1.5, options)
    assert not beyond.converged and beyond.limit == pytest.approx(MAXIMUM["P"], rel=3e-3)


@needs_inertia
def test_a_pressure_within_the_limit_mentions_none(ball: Problem) -> None:
    solution = solve(ball, 0.9)
    assert solution.converged and solution.stable and solution.limit is None


def test_a_state_on_a_distant_branch_is_not_passed_off_as_the_way_up(sphere: Meshes) -> None:
    """Treloar's balloon has a stable, far larger state above its maximum of 0.0523 MPa."""
    balloon = Problem(sphere(10.0, 11.0, 1, 4), TRELOAR, PLANES, ("inside",))
    solution = solve(balloon, 0.06, SolverOptions(first_step=1.0))
    assert not solution.converged
    assert solution.limit == pytest.approx(0.0523, rel=0.02)


def test_the_bubbles_of_a_bellows_balloon_at_a_limit_too(cell: Mesh, ninjaflex: Ogden) -> None:
    """Walked by load and traced by arc length, with a moving plane: the same limit."""
    middles = Supports(symmetry={"x0": 0, "y0": 1})
    problem = Problem(cell, ninjaflex, middles, ("cavity",), moving_plane="x1")
    walked = solve(problem, 1.0)
    traced = trace(problem, 1.0, steps=12, until=lambda point: point.stable is False)
    assert not walked.converged and walked.limit is not None
    assert traced.limits[0].point.pressure == pytest.approx(walked.limit, rel=1e-3)
    assert walked.pressure == pytest.approx(walked.limit, rel=0.01)


def test_a_compressed_strip_loses_its_stability_at_eulers_load(box: Meshes) -> None:
    """Plane strain: E I = mu h^3 / 3 per depth; held against turning at one end, free at the other.

    P = pi^2 E I / (4 L^2).
    """
    mesh, length, height = box((12, 1, 1), (10.0, 0.5, 0.5)), 10.0, 0.5
    load = np.pi**2 * height**3 / 3 / (4 * length**2) / height

    def held(positions: Array, _load: float) -> Array:
        motion = np.full(positions.shape, np.nan)
        motion[:, 0] = 0.0
        motion[np.isclose(positions[:, 2], height / 2), 2] = 0.0
        return motion

    strip = Problem(
        mesh,
        Ogden((1.0,), (2.0,)),
        Supports(symmetry={"y0": 1, "y1": 1}, prescribed={"x0": held}),
        loads=(Traction("x1", (-2 * load, 0.0, 0.0)),),
    )
    path = trace(strip, steps=30, longest_step=0.0002)
    assert path.limits[0].kind == "bifurcation"
    assert path.limits[0].point.load == pytest.approx(0.5, rel=0.08)
    solution = solve(strip)
    assert not solution.converged
    assert "stability is lost at" in solution.message
    assert solution.load == pytest.approx(0.5, rel=0.02)


def test_a_path_knows_what_a_led_end_does_to_a_stiff_film() -> None:
    """A strip is bent to a ring, its film inside: 20 corrections in 6 points; without, 36 in 8."""
    film = Membrane("z0", 4100.0, 0.0, 0.5, wrinkles=False)
    body = BentStrip(0.025, 20.0, 2.5, 2.0, 0.03, film)
    path = trace(body.problem(box_mesh((6, 1, 2), (10.0, 2.5, 2.0))))
    assert path.points[-1].load >= 1
    assert sum(point.iterations for point in path.points) < 28
