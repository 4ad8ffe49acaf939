"""The load path: equilibrium, convergence, cut-back, restart, refusal."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from solver import (
    Event,
    Mesh,
    Ogden,
    Problem,
    SlenderAxis,
    SolverOptions,
    Supports,
    solve,
    transfer,
)

Meshes = Callable[..., Mesh]
THREE_PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=40)
M1 = json.loads((Path(__file__).parents[1] / "data/ogden_points.json").read_text())["cases"][0]


def pulled(mesh: Mesh, material: Ogden) -> Problem:
    """A block between three symmetry planes, loaded on its face x1."""
    return Problem(mesh, material, THREE_PLANES, ("x1",))


def actuator(
    bellows: Meshes, material: Ogden, axis: bool = True, refinement: int = 1, bubbles: int = 4
) -> Problem:
    """Half of a small bellows that bends under pressure inside."""
    mesh = bellows(bubbles, refinement)
    supports = Supports(clamped=("root",), symmetry={"symmetry": 1})
    middles = [0.0, *(2.0 + 1.4 * np.arange(2 * bubbles - 1)), mesh.nodes[:, 0].max()]
    stations = SlenderAxis(tuple(middles)) if axis else None
    return Problem(mesh, material, supports, ("cavity",), axis=stations)


def asked_for(problem: Problem) -> float:
    """How small the last correction must be by default, mm: two walks may differ by so much."""
    return SolverOptions().tolerance * problem.mesh.size


@pytest.mark.parametrize("stretch", ["0.9", "1.1", "1.25"])
def test_a_pulled_block_of_distorted_elements_stretches_as_the_closed_form_says(
    box: Meshes, ninjaflex: Ogden, stretch: str
) -> None:
    cauchy = M1["reference"][stretch]["uniaxial"] * float(stretch)
    mesh = box((2, 2, 2), distortion=0.25)
    solution = solve(pulled(mesh, ninjaflex), -cauchy, TIGHT)
    assert solution.converged, solution.message
    stretches = np.array([float(stretch), float(stretch) ** -0.5, float(stretch) ** -0.5])
    assert solution.displacement == pytest.approx(mesh.nodes * (stretches - 1), abs=1e-7)
    assert solution.hydrostatic_pressure == pytest.approx(-cauchy / 3, abs=1e-6)


def test_a_finite_bulk_modulus_changes_the_volume_by_the_pressure(box: Meshes) -> None:
    material = Ogden((1.0,), (2.0,), bulk_modulus=20.0)
    everywhere = ("x1", "y1", "z1")
    mesh = box((2, 1, 1))
    solution = solve(Problem(mesh, material, THREE_PLANES, everywhere), 0.8, TIGHT)
    assert solution.converged
    ratio = (1 - 0.8 / 20.0) ** (1 / 3)  # q = -K (J - 1)
    assert solution.displacement == pytest.approx(mesh.nodes * (ratio - 1), abs=1e-9)
    assert solution.hydrostatic_pressure == pytest.approx(0.8, abs=1e-9)


def test_uniform_pressure_does_not_deform_an_incompressible_body(
    box: Meshes, ninjaflex: Ogden
) -> None:
    mesh = box((3, 2, 2), (3.0, 1.0, 1.0), distortion=0.2)
    supports = Supports(clamped=("x0",))
    solution = solve(Problem(mesh, ninjaflex, supports, ("x1", "y0", "y1", "z0", "z1")), 2.0)
    assert solution.converged
    assert abs(solution.displacement).max() < 1e-12
    assert solution.hydrostatic_pressure == pytest.approx(2.0, abs=1e-10)


def test_newton_ends_quadratically(bellows: Meshes, ninjaflex: Ogden) -> None:
    events: list[Event] = []
    options = SolverOptions(first_step=1.0, tolerance=1e-11, reuse=0, linear_solver="superlu")
    solution = solve(actuator(bellows, ninjaflex), 0.05, options, events.append)
    assert solution.converged and solution.load_steps == 1, solution.message
    corrections = np.array([e.correction for e in events if e.kind == "iteration"])
    tail = corrections[corrections < 0.5]
    assert len(tail) >= 4
    assert (tail[1:] <= np.maximum(2 * tail[:-1] ** 2, 1e-12)).all(), corrections


def test_unloading_returns_to_zero(bellows: Meshes, ninjaflex: Ogden) -> None:
    problem = actuator(bellows, ninjaflex)
    loaded = solve(problem, 0.05)
    assert loaded.converged and abs(loaded.displacement).max() > 1.0
    unloaded = solve(
        problem, 0.0, TIGHT, initial=(loaded.displacement, loaded.hydrostatic_pressure)
    )
    assert unloaded.converged and unloaded.refused_steps == 0
    assert unloaded.newton_iterations > 2
    assert abs(unloaded.displacement).max() < 1e-10
    assert abs(unloaded.hydrostatic_pressure).max() < 1e-10


def test_a_restart_from_the_solution_stays_there(bellows: Meshes, ninjaflex: Ogden) -> None:
    problem = actuator(bellows, ninjaflex)
    first = solve(problem, 0.05)
    again = solve(problem, 0.05, initial=(first.displacement, first.hydrostatic_pressure))
    assert again.converged and again.newton_iterations == 1
    assert again.displacement == pytest.approx(first.displacement, abs=asked_for(problem))
    assert [point.pressure for point in again.path] == [0.0, 0.05]


def test_two_runs_are_equal_bit_by_bit(bellows: Meshes, ninjaflex: Ogden) -> None:
    first, second = (solve(actuator(bellows, ninjaflex), 0.05) for _ in range(2))
    assert np.array_equal(first.displacement, second.displacement)
    assert first.path == second.path


def test_superlu_finds_the_same_solution(bellows: Meshes, ninjaflex: Ogden) -> None:
    problem = actuator(bellows, ninjaflex)
    usual = solve(problem, 0.05)
    portable = solve(problem, 0.05, SolverOptions(linear_solver="superlu"))
    assert portable.converged and portable.linear_solver == "superlu"
    assert portable.displacement == pytest.approx(usual.displacement, abs=1e-8)
    assert portable.newton_iterations == usual.newton_iterations


@pytest.mark.thorough
def test_a_body_that_turns_far_needs_finite_motions(bellows: Meshes, ninjaflex: Ogden) -> None:
    turning = solve(actuator(bellows, ninjaflex, bubbles=8), 0.36)
    adding = solve(actuator(bellows, ninjaflex, axis=False, bubbles=8), 0.36)
    assert turning.converged and adding.converged, (turning.message, adding.message)
    assert turning.rotation > 180
    assert turning.displacement == pytest.approx(adding.displacement, abs=1e-4)
    assert turning.newton_iterations <= 0.7 * adding.newton_iterations


def test_cutback_recovers_a_step_that_is_too_long(bellows: Meshes, ninjaflex: Ogden) -> None:
    problem = actuator(bellows, ninjaflex, axis=False)
    events: list[Event] = []
    options = SolverOptions(first_step=1.0, maximum_iterations=5)
    solution = solve(problem, 0.2, options, events.append)
    careful = solve(problem, 0.2)
    assert solution.converged, solution.message
    assert solution.refused_steps == sum(e.kind == "refused" for e in events) > 0
    assert solution.displacement == pytest.approx(careful.displacement, abs=asked_for(problem))


def test_a_load_out_of_reach_returns_the_last_good_state(sphere: Meshes) -> None:
    material = Ogden((1.0,), (2.0,))
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    problem = Problem(sphere(10.0, 11.0, 1, 3), material, supports, ("inside",))
    solution = solve(problem, 0.2, SolverOptions(smallest_step=1e-2))  # bursts at 0.118
    assert not solution.converged
    assert 0.1 < solution.pressure < 0.119
    assert solution.message.startswith(f"stopped at {solution.pressure:.4g} of 0.2 MPa: ")
    assert solution.path[-1].pressure == solution.pressure
    again = solve(problem, solution.pressure)
    assert again.converged
    assert again.displacement == pytest.approx(solution.displacement, abs=1e-2)


def test_a_useless_start_falls_back_to_the_load_path(bellows: Meshes, ninjaflex: Ogden) -> None:
    problem = actuator(bellows, ninjaflex)
    usual = solve(problem, 0.05)
    nodes = problem.mesh.nodes
    inside_out = (-2.0 * nodes, np.zeros(len(problem.mesh.vertices)))
    solution = solve(problem, 0.05, initial=inside_out)
    assert solution.converged and solution.refused_steps == 1
    assert solution.displacement == pytest.approx(usual.displacement, abs=1e-6)


def test_the_listener_hears_every_iteration_and_step(bellows: Meshes, ninjaflex: Ogden) -> None:
    events: list[Event] = []
    solution = solve(actuator(bellows, ninjaflex), 0.1, listener=events.append)
    kinds = [event.kind for event in events]
    assert kinds.count("iteration") == solution.newton_iterations
    assert kinds.count("step") == solution.load_steps == len(solution.path) - 1
    steps = [event for event in events if event.kind == "step"]
    assert [e.load * 0.1 for e in steps] == pytest.approx([p.pressure for p in solution.path[1:]])
    assert [e.rotation for e in steps] == [p.rotation for p in solution.path[1:]]
    assert sum(point.iterations for point in solution.path) == solution.newton_iterations


@pytest.mark.slow
def test_a_coarse_solution_starts_a_finer_mesh_at_full_load(
    bellows: Meshes, ninjaflex: Ogden
) -> None:
    coarse = solve(actuator(bellows, ninjaflex, bubbles=4), 0.1)
    fine = actuator(bellows, ninjaflex, bubbles=4, refinement=2)
    walked = solve(fine, 0.1)
    carried = solve(fine, 0.1, initial=transfer(coarse, fine.mesh))
    assert carried.converged and carried.refused_steps == 0
    assert carried.newton_iterations < walked.newton_iterations
    assert carried.displacement == pytest.approx(walked.displacement, abs=asked_for(fine))
    assert carried.rotation == pytest.approx(walked.rotation, abs=1e-3)
    assert carried.rotation == pytest.approx(coarse.rotation, rel=0.1)


def test_transfer_reproduces_quadratic_fields(
    box: Meshes, sphere: Meshes, ninjaflex: Ogden
) -> None:
    from dataclasses import replace

    mesh = box((3, 2, 2), distortion=0.2)
    solution = solve(pulled(mesh, ninjaflex), 0.0)

    def field(x: np.ndarray) -> np.ndarray:
        return np.stack([x[:, 0] ** 2, x[:, 1] * x[:, 2], 1 - 3 * x[:, 0] * x[:, 2]], axis=1)

    linear = mesh.nodes[mesh.vertices] @ [1.0, -2.0, 0.5]
    given = replace(solution, displacement=field(mesh.nodes), hydrostatic_pressure=linear)
    other = box((4, 3, 5), (1.02, 1.02, 1.02))  # reaches slightly beyond the old mesh
    displacement, pressure = transfer(given, other)
    assert displacement == pytest.approx(field(other.nodes), abs=1e-12)
    assert pressure == pytest.approx(other.nodes[other.vertices] @ [1.0, -2.0, 0.5], abs=1e-12)


def test_another_body_is_no_finer_mesh(box: Meshes, ninjaflex: Ogden) -> None:
    """Fields are not extrapolated far beyond the body that they belong to."""
    solution = solve(pulled(box((3, 2, 2)), ninjaflex), 0.0)
    moved = box((3, 2, 2))
    longer, away = box((3, 2, 2), (9.0, 1.0, 1.0)), Mesh(moved.nodes + 5, moved.tets)
    for other, words in ((longer, "differ by 8 mm"), (away, "differ by 5 mm")):
        with pytest.raises(ValueError, match=words):
            transfer(solution, other)
