"""Contact with planes behind which a mirror image stands: its equations, and what it does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array

from solver import (
    Checkpoint,
    Contact,
    Event,
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    solve,
)
from solver.assembly.assembly import Assembly
from solver.assembly.contact import image_gaps, lowest_gaps
from solver.assembly.state import State
from solver.kernels.contact import contact_law
from solver.linear.sparsity import Pattern

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
MIDDLES = Supports(symmetry={"x0": 0, "y0": 1})
DEPTH = 0.2
"""mm. So soft that both parts of the contact's law are met in one state."""

NEIGHBOUR = Contact("outside", DEPTH)
CONTACTS = {
    "moving plane": (NEIGHBOUR,),
    "fixed plane, some nodes on the moving one": (Contact("cavity", DEPTH, axis=2, position=0.3),),
    "both": (NEIGHBOUR, Contact("cavity", DEPTH, axis=0), Contact("outside", DEPTH, axis=1)),
}


def cell_problem(mesh: Mesh, material: Ogden, contacts: tuple[Contact, ...]) -> Problem:
    return Problem(mesh, material, MIDDLES, ("cavity",), moving_plane="x1", contacts=contacts)


def crossing_state(assembly: Assembly) -> State:
    """Turned and shifted, all free nodes moved so far at random that many cross their planes."""
    random = np.random.default_rng(3).uniform(-0.6, 0.6, assembly.numbering.size)
    random[assembly.numbering.plane] = (-0.35, -0.2)
    return moved(assembly, State.zero(assembly.problem), random)


def moved(assembly: Assembly, state: State, vector: Array) -> State:
    """The state after a change of all unknowns, exactly."""
    change = State(*assembly.numbering.expand(vector))
    added = State(state.displacement + change.displacement, state.hydrostatic_pressure)
    assert assembly.plane is not None
    return assembly.plane.finite(state, change, added)


def contact_part(assembly: Assembly, state: State) -> tuple[Array, Array, Pattern]:
    """Residual, tangent and its pattern of the contacts alone."""
    residual = np.zeros(assembly.numbering.size)
    values = np.zeros(len(assembly.pattern.indices))
    return (residual, *assembly.contacts.add(state, True, residual, values))


def action(pattern: Pattern, values: Array, vector: Array) -> Array:
    """The tangent's upper triangle and its mirror image times a vector."""
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=2 * (len(vector),))
    return upper @ vector + upper.T @ vector - upper.diagonal() * vector


def slope(function: Callable[[float], Array | float], h: float = 1e-6) -> Array | float:
    return (function(h) - function(-h)) / (2 * h)


def directions(assembly: Assembly) -> dict[str, Array]:
    """Unit changes of tilt and shift, and changes at random."""
    unit, random = np.eye(assembly.numbering.size), np.random.default_rng(6)
    return {
        "tilt": unit[assembly.numbering.plane[0]],
        "shift": unit[assembly.numbering.plane[1]],
        **{f"random {n}": random.normal(size=assembly.numbering.size) for n in range(3)},
    }


@pytest.mark.parametrize("name", CONTACTS)
def test_residual_and_tangent_are_derivatives_of_the_contact_energy(
    cell: Mesh, ninjaflex: Ogden, name: str
) -> None:
    assembly = Assembly(cell_problem(cell, ninjaflex, CONTACTS[name]))
    state = crossing_state(assembly)
    residual, values, pattern = contact_part(assembly, state)
    assert assembly.contacts.energy(state) > 0.1
    for direction_name, direction in directions(assembly).items():

        def energy(step: float, direction: Array = direction) -> float:
            return assembly.contacts.energy(moved(assembly, state, step * direction))

        def gradient(step: float, direction: Array = direction) -> Array:
            return contact_part(assembly, moved(assembly, state, step * direction))[0]

        scale = abs(residual).sum() * abs(direction).max()
        assert residual @ direction == pytest.approx(slope(energy), abs=1e-7 * scale)
        numerical = slope(gradient)
        error = action(pattern, values, direction) - numerical
        assert abs(error).max() <= 1e-5 * abs(numerical).max(), direction_name


def test_the_law_is_the_derivative_of_its_energy_on_both_sides_of_the_smoothing() -> None:
    for gap in (-0.3, -0.11, -0.09, -0.02, 0.05):
        energy = slope(lambda h, gap=gap: contact_law(gap + h, 7.0, 0.1)[0])
        pressure = slope(lambda h, gap=gap: contact_law(gap + h, 7.0, 0.1)[1])
        _, force, stiffness = contact_law(gap, 7.0, 0.1)
        assert (force, stiffness) == pytest.approx((-energy, -pressure), abs=1e-5)
    before, after = contact_law(-0.1 + 1e-12, 7.0, 0.1), contact_law(-0.1 - 1e-12, 7.0, 0.1)
    assert before == pytest.approx(after, abs=1e-9)


def test_a_surface_in_the_moving_plane_feels_nothing_of_it(cell: Mesh, ninjaflex: Ogden) -> None:
    assembly = Assembly(cell_problem(cell, ninjaflex, (Contact("x1", DEPTH),)))
    residual, values, _ = contact_part(assembly, crossing_state(assembly))
    assert abs(residual).max() < 1e-20 and abs(values).max() < 1e-10


def test_nothing_that_touches_means_not_one_bit_changed(cell: Mesh, ninjaflex: Ogden) -> None:
    apart = cell_problem(cell, ninjaflex, CONTACTS["both"])
    without, having = (solve(replace(apart, contacts=c), 0.05) for c in ((), apart.contacts))
    assert min(lowest_gaps(apart, having.displacement, np.array(having.plane))) > 0
    assert np.array_equal(having.displacement, without.displacement)
    assert np.array_equal(having.hydrostatic_pressure, without.hydrostatic_pressure)
    assert having.path == without.path and having.plane == without.plane


def squeezed(box: Meshes, material: Ogden, depth: float, pressure: float = 1.5) -> Solution:
    """A block under pressure on its sides grows along z until it meets a plane 0.1 mm away."""
    mesh = box((2, 2, 2))
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    contact = Contact("z1", depth, axis=2, position=1.1)
    problem = Problem(mesh, material, supports, ("x1", "y1"), contacts=(contact,))
    return solve(problem, pressure, SolverOptions(tolerance=1e-9, maximum_iterations=30))


@pytest.mark.parametrize("depth", [0.05, 0.001])
def test_a_block_presses_on_a_plane_as_its_closed_form_says(
    box: Meshes, ninjaflex: Ogden, depth: float
) -> None:
    """Uniform stretch l along z, sides under p: the plane bears (p - tau(l)) / l per first area."""
    solution, pressure = squeezed(box, ninjaflex, depth), 1.5
    assert solution.converged
    (gap,) = lowest_gaps(solution.problem, solution.displacement, np.zeros(2))
    stretch = 1.1 - gap
    logs = np.log(stretch) * np.array([-0.5, -0.5, 1.0])
    stresses = ninjaflex.principal_stresses(logs)
    borne = (pressure - (stresses[2] - stresses[0])) / stretch
    stiffness = ninjaflex.shear_modulus / depth
    _, contact_pressure, _ = contact_law(gap, stiffness, 0.1 * depth)
    assert borne > 0.3
    assert contact_pressure == pytest.approx(borne, rel=1e-6)
    sides = solution.displacement[solution.problem.mesh.surface_nodes("x1"), 0]
    assert 1 + sides == pytest.approx(stretch**-0.5, rel=1e-8)


def test_what_is_let_through_shrinks_with_the_depth_asked_for(
    box: Meshes, ninjaflex: Ogden
) -> None:
    through = []
    for depth in (0.01, 0.001, 0.0001):
        solution = squeezed(box, ninjaflex, depth)
        through.append(-lowest_gaps(solution.problem, solution.displacement, np.zeros(2))[0])
    assert through[0] < 0.01
    assert through[:-1] == pytest.approx(10 * np.array(through[1:]), rel=0.1)


def test_a_body_on_the_other_side_is_held_there(box: Meshes, ninjaflex: Ogden) -> None:
    """The side is the body's own: a block below the plane stays below, one above it above."""
    mesh = box((2, 2, 2))
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z1": 2})
    contact = Contact("z0", 0.001, axis=2, position=-0.1)
    problem = Problem(mesh, ninjaflex, supports, ("x1", "y1"), contacts=(contact,))
    solution = solve(problem, 1.5)
    lowest = (mesh.nodes + solution.displacement)[:, 2].min()
    assert -0.101 < lowest < -0.1


def test_opposite_walls_of_a_chamber_meet_in_a_vacuum_and_the_cell_stays_stable(
    cell: Mesh, ninjaflex: Ogden
) -> None:
    problem = cell_problem(cell, ninjaflex, (Contact("cavity", 0.003, axis=0), NEIGHBOUR))
    bare, held = (solve(replace(problem, contacts=c), -0.2) for c in ((), problem.contacts))
    assert bare.converged and held.converged
    through = [lowest_gaps(problem, s.displacement, np.array(s.plane))[0] for s in (bare, held)]
    assert through[0] < -0.4  # without contact they pass through each other
    assert -0.01 * 0.6 < through[1] < 0  # less than a hundredth of a wall
    assert held.path[-1].volume > bare.path[-1].volume + 1
    if held.negative_pivots is not None:
        assert held.negative_pivots == len(cell.vertices)


def test_a_run_in_which_walls_touch_is_resumed_to_the_same_bits(
    cell: Mesh, ninjaflex: Ogden
) -> None:
    problem = cell_problem(cell, ninjaflex, (Contact("cavity", 0.003, axis=0), NEIGHBOUR))
    seen: list[Checkpoint] = []

    def keep(event: Event) -> None:
        if event.checkpoint is not None:
            seen.append(event.checkpoint)

    def touches(state: State) -> bool:
        return min(lowest_gaps(problem, state.displacement, state.plane)) < 0

    whole = solve(problem, -0.2, listener=keep)
    assert whole.converged and touches(whole.state)
    halfway = next(checkpoint for checkpoint in seen[:-1] if touches(checkpoint.reached))
    again = solve(problem, -0.2, resume=halfway)
    assert np.array_equal(again.displacement, whole.displacement)
    assert again.path == whole.path


def test_the_gap_to_an_image_is_twice_that_to_the_plane(cell: Mesh, ninjaflex: Ogden) -> None:
    problem = cell_problem(cell, ninjaflex, CONTACTS["both"])
    still = image_gaps(problem, np.zeros_like(cell.nodes), np.zeros(2))
    assert still[0] == pytest.approx(2 * 0.4)  # half of the gap between bubbles
    assert still[1] == pytest.approx(2 * 0.4)  # half of a chamber
    assert still[2] is None  # nothing outside faces the plane y = 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nowhere", 0.1), "no surface is called 'nowhere'"),
        (("outside", 0.0), "penetration = 0 mm must be above 0"),
        (("outside", float("nan")), "penetration = nan mm"),
        (("outside", 0.1, 3), "axis must be 0, 1 or 2, got 3"),
        (("outside", 0.1, 0, float("inf")), "position = inf mm"),
    ],
)
def test_a_contact_that_means_nothing_is_refused(
    cell: Mesh, ninjaflex: Ogden, arguments: tuple[str, float], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        cell_problem(cell, ninjaflex, (Contact(*arguments),))


def test_a_contact_with_the_moving_plane_needs_one(box: Meshes, ninjaflex: Ogden) -> None:
    with pytest.raises(ValueError, match="needs an axis"):
        Problem(box(), ninjaflex, Supports(("x0",)), ("x1",), contacts=(Contact("z1", 0.1),))


def test_a_surface_beyond_its_plane_from_the_start_is_refused(
    box: Meshes, ninjaflex: Ogden
) -> None:
    contact = Contact("z1", 0.1, axis=2, position=0.75)
    problem = Problem(box(), ninjaflex, Supports(("x0",)), ("x1",), contacts=(contact,))
    with pytest.raises(ValueError, match=r"'z1' lies 0\.25 mm beyond"):
        solve(problem, 0.1)
