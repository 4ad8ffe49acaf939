"""Two surfaces of one mesh that touch: derivatives, balance, patches, presses, bad input."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from meshes import box_mesh, mapped_box
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.spatial.transform import Rotation

from solver import (
    Contact,
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    SurfaceContact,
    constant_changes,
    contact_forces,
    reaction,
    sensitivities,
    solve,
)
from solver.assembly.assembly import Assembly
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.state import State

Array = NDArray[np.float64]
RUBBER = Ogden.neo_hooke(1.0)
EXACT = SolverOptions(tolerance=1e-9, maximum_iterations=20)


def both(lower: Mesh, upper: Mesh) -> Mesh:
    """Two bodies as one mesh, with surfaces such as ``lower z1`` and ``upper z0``."""
    count = len(lower.nodes)
    surfaces = {f"lower {name}": triangles for name, triangles in lower.surfaces.items()}
    surfaces |= {f"upper {name}": each + count for name, each in upper.surfaces.items()}
    nodes, tets = np.concatenate([lower.nodes, upper.nodes]), upper.tets + count
    return Mesh(nodes, np.concatenate([lower.tets, tets]), surfaces)


def raised(mesh: Mesh, by: tuple[float, float, float]) -> Mesh:
    return mesh.moved(mesh.nodes + by)


def stack(
    lower: tuple[int, int, int] = (2, 2, 1), upper: tuple[int, int, int] = (3, 3, 1), gap: float = 0
) -> Mesh:
    """A unit cube on another one, whose meshes do not match."""
    return both(box_mesh(lower), raised(box_mesh(upper), (0, 0, 1 + gap)))


def led(by: float) -> Callable[[Array, float], Array]:
    def motion(positions: Array, load: float) -> Array:
        return np.broadcast_to([np.nan, np.nan, by * load], positions.shape)

    return motion


PLANES = {
    "lower z0": 2, "lower x0": 0, "lower y0": 1, "upper x0": 0, "upper y0": 1,
}  # fmt: skip
TOUCH = SurfaceContact("upper z0", "lower z1", 1e-3)


def pressed(mesh: Mesh, contact: SurfaceContact = TOUCH, travel: float = 0.5) -> Solution:
    supports = Supports(symmetry=PLANES, prescribed={"upper z1": led(-travel)})
    solution = solve(Problem(mesh, RUBBER, supports, contacts=(contact,)), options=EXACT)
    assert solution.converged
    return solution


def bumpy(divisions: tuple[int, int, int], seed: int) -> Mesh:
    """A block with curved top and bottom."""
    a, b = np.random.default_rng(seed).uniform(0.05, 0.15, 2)

    def place(cube: Array) -> Array:
        x, y, z = cube.T
        return np.column_stack([x, y, z + a * np.sin(2.1 * x + b) * np.cos(1.7 * y)])

    return mapped_box(divisions, place)


def test_residual_and_tangent_are_derivatives_of_the_contact_energy() -> None:
    """Bodies far in each other, so that all parts of the law, of triangles and edges are met."""
    mesh = both(bumpy((2, 2, 1), 1), raised(bumpy((3, 2, 1), 2), (0.1, -0.05, 0.9)))
    contact = SurfaceContact("upper z0", "lower z1", 0.3, reach=0.4)
    supports = Supports(("lower z0", "upper z1"))
    problem = Problem(mesh, RUBBER, supports, contacts=(contact,))
    later = np.full(mesh.nodes.shape, 1e-9)  # a later stage may begin in contact
    assembly = Assembly(problem, later)
    size, random = assembly.numbering.size, np.random.default_rng(5)
    place = random.uniform(-0.03, 0.03, size)

    def state(vector: Array) -> State:
        return State(*assembly.numbering.expand(vector))

    def forces(vector: Array) -> Array:
        residual = np.zeros(size)
        assembly.contacts.add(state(vector), False, residual, np.zeros(0))
        return residual

    values = np.zeros(len(assembly.pattern.indices))
    values, pattern = assembly.contacts.add(state(place), True, np.zeros(size), values)
    assert len(pattern.indices) > len(assembly.pattern.indices)
    upper, residual = csr_array((values, pattern.indices, pattern.indptr)), forces(place)
    assert abs(residual).max() > 0.01
    for _ in range(3):
        along, step = random.normal(size=size), 1e-6
        ahead, behind = place + step * along, place - step * along
        energies = [assembly.contacts.energy(state(each)) for each in (ahead, behind)]
        slope = (energies[0] - energies[1]) / (2 * step)
        assert residual @ along == pytest.approx(slope, rel=1e-6)
        numerical = (forces(ahead) - forces(behind)) / (2 * step)
        action = upper @ along + upper.T @ along - upper.diagonal() * along
        assert abs(action - numerical).max() < 1e-6 * abs(numerical).max()


@pytest.mark.parametrize(("gap", "travel", "reach"), [(0.0, 0.5, 0.05), (1.0, 1.4, 0.1)])
def test_blocks_do_not_pass_through_each_other_in_large_steps(
    gap: float, travel: float, reach: float
) -> None:
    mesh = stack((3, 3, 3), (3, 3, 3), gap)
    supports = Supports(symmetry=PLANES, prescribed={"upper z1": led(-travel)})
    contact = replace(TOUCH, penetration=1e-2, reach=reach)
    solution = solve(Problem(mesh, RUBBER, supports, contacts=(contact,)))
    (found,) = contact_forces(solution)
    assert solution.converged and solution.refused_steps > 0
    stretch = 1 - (travel - gap) / 2
    assert found.force[2] == pytest.approx(stretch**-2 - stretch, rel=0.05)
    assert -2e-2 < found.gap < 0


@pytest.mark.thorough
def test_a_path_that_only_a_pass_could_continue_says_what_is_in_the_way() -> None:
    """Less reach than contact of this pressure needs."""
    supports = Supports(symmetry=PLANES, prescribed={"upper z1": led(-0.6)})
    contact = replace(TOUCH, penetration=0.1, reach=0.02)
    options = SolverOptions(smallest_step=0.01)
    solution = solve(Problem(stack(), RUBBER, supports, contacts=(contact,)), options=options)
    assert not solution.converged
    assert "the surface 'upper z0' would pass through the surface 'lower z1'" in solution.message
    assert 0 < contact_forces(solution)[0].force[2] < 0.2


def test_action_is_reaction() -> None:
    mesh = both(bumpy((2, 2, 1), 1), raised(bumpy((3, 2, 1), 2), (0.1, -0.05, 0.9)))
    contact = SurfaceContact("upper z0", "lower z1", 0.3, reach=0.4)
    problem = Problem(mesh, RUBBER, Supports(("lower z0", "upper z1")), contacts=(contact,))
    (pair,) = contact_pairs(problem)
    state = State.zero(problem)
    forces = pair.forces(state, 1.0)
    size = np.linalg.norm(forces, axis=1).sum()
    assert size > 0.1
    assert forces.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12 * size)
    moment = np.cross(mesh.nodes, forces).sum(axis=0)
    assert moment == pytest.approx(np.zeros(3), abs=1e-12 * size)


@pytest.mark.parametrize("along", [0.05, 0.08, 0.3])
def test_flat_blocks_pushed_over_each_other_s_rim_feel_no_force_sideways(along: float) -> None:
    """Behind the rim, and beyond it on either side, there is none without friction."""
    mesh = both(box_mesh((2, 2, 1)), raised(box_mesh((2, 2, 1)), (0, 0, 0.98)))
    contact = SurfaceContact("upper z0", "lower z1", 1e-2, reach=0.3)
    supports = Supports(("lower z0", "upper z1"))
    problem = Problem(mesh, RUBBER, supports, contacts=(contact,))
    (pair,) = contact_pairs(problem)
    upper = mesh.nodes[:, 2] > 0.9 * 0.98
    upper[np.unique(mesh.surfaces["lower z1"])] = False
    moved = np.where(upper[:, None], [along, 0.02, 0], 0.0)
    forces = pair.forces(State(moved, np.zeros(0), np.zeros(2)), 1.0)[upper]
    assert forces[:, :2] == pytest.approx(0.0, abs=1e-12)
    assert forces[:, 2].sum() > 1


def test_blocks_of_matching_meshes_meet_as_a_block_meets_a_plane_of_symmetry() -> None:
    """Each lets the middle through by half of what two in contact let through."""
    lower = box_mesh((2, 2, 2))
    image = lower.nodes * [1, 1, -1] + [0, 0, 2.2]
    flipped = {name: each[:, [0, 2, 1, 5, 4, 3]] for name, each in lower.surfaces.items()}
    upper = Mesh(image, lower.tets[:, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]], flipped)
    planes = {"lower x0": 0, "lower y0": 1, "upper x0": 0, "upper y0": 1}
    squeezed = {"lower z0": led(0.3), "upper z0": led(-0.3)}
    ours = Problem(
        both(lower, upper), RUBBER, Supports(symmetry=planes, prescribed=squeezed),
        contacts=(SurfaceContact("upper z1", "lower z1", 2e-3),),
    )  # fmt: skip
    half = Supports(symmetry={"x0": 0, "y0": 1}, prescribed={"z0": led(0.3)})
    mirror = Problem(lower, RUBBER, half, contacts=(Contact("z1", 1e-3, 2, 1.1),))
    one, other = (solve(problem, options=EXACT) for problem in (ours, mirror))
    assert one.converged and other.converged
    count = len(lower.nodes)
    assert one.displacement[:count] == pytest.approx(other.displacement, abs=1e-7)
    force, same = contact_forces(one)[0].force, contact_forces(other)[0].force
    assert force == pytest.approx(-same, rel=1e-6, abs=1e-9)
    assert force[2] > 0.1


@pytest.mark.parametrize("divisions", [((2, 2, 1), (3, 3, 1)), ((4, 3, 1), (2, 2, 1))])
def test_the_patch_test_of_meshes_that_do_not_match(
    divisions: tuple[tuple[int, int, int], tuple[int, int, int]],
) -> None:
    """Blocks under homogeneous compression: the force is right, the stress nearly uniform.

    Pressure at quadrature points of one surface is not equivalent, node by node, to a uniform one
    on the other: the known error of one-pass integration. Points that slide off at the sides add to
    that.
    """
    solution = pressed(stack(*divisions))
    stretch = 1 - 0.25  # of each, but for the penetration
    expected = stretch**-2 - stretch
    (contact,) = contact_forces(solution)
    assert contact.force[2] == pytest.approx(expected, rel=1e-2)
    held = reaction(solution, "lower z0").force[2]
    assert held == pytest.approx(contact.force[2], rel=1e-8)
    assert -3e-3 < contact.gap < -0.5e-3  # it oscillates from point to point
    assert contact.area == pytest.approx(1 / stretch, rel=0.02)
    sides = solution.displacement[solution.problem.mesh.surface_nodes("lower x1"), 0]
    assert 1 + sides == pytest.approx(stretch**-0.5, abs=0.01)


def test_a_turned_problem_has_the_turned_answer() -> None:
    turn = Rotation.from_rotvec((0.7, -1.1, 0.4)).as_matrix()
    mesh = both(bumpy((2, 2, 1), 1), raised(bumpy((3, 2, 1), 2), (0.1, -0.05, 1.1)))
    contact = SurfaceContact("upper z0", "lower z1", 0.01)

    def solved(turned: Array) -> Solution:
        def motion(positions: Array, load: float) -> Array:
            return np.broadcast_to(load * turned @ (0.05, 0, -0.3), positions.shape)

        there = Mesh(mesh.nodes @ turned.T, mesh.tets, mesh.surfaces)
        supports = Supports(("lower z0",), prescribed={"upper z1": motion})
        found = solve(Problem(there, RUBBER, supports, contacts=(contact,)), options=EXACT)
        assert found.converged
        return found

    plain, turned = solved(np.eye(3)), solved(turn)
    assert turned.displacement @ turn == pytest.approx(plain.displacement, abs=1e-7)
    one, other = contact_forces(plain)[0], contact_forces(turned)[0]
    assert one.force[2] > 0.05
    assert turn.T @ other.force == pytest.approx(one.force, rel=1e-6)
    held = reaction(plain, "lower z0")
    assert held.force == pytest.approx(one.force, rel=1e-6)
    assert held.moment == pytest.approx(one.moment, rel=1e-6, abs=1e-8)


def test_surfaces_that_stay_apart_change_no_bit() -> None:
    mesh = stack(gap=0.5)
    supports = Supports(symmetry=PLANES, prescribed={"upper z1": led(-0.2)})
    problem = Problem(mesh, RUBBER, supports, contacts=(replace(TOUCH, reach=2.0),))
    having, without = (solve(replace(problem, contacts=c)) for c in (problem.contacts, ()))
    assert having.converged
    assert contact_forces(having)[0].gap == pytest.approx(0.3)
    assert np.array_equal(having.displacement, without.displacement)
    assert np.array_equal(having.hydrostatic_pressure, without.hydrostatic_pressure)


def test_blocks_in_contact_are_stable_and_a_lifted_one_leaves_nothing_behind() -> None:
    solution = pressed(stack())
    if solution.negative_pivots is not None:
        assert solution.negative_pivots == len(solution.problem.mesh.vertices)
    lifted = Supports(symmetry=PLANES, prescribed={"upper z1": led(0.6)})
    after = solve(replace(solution.problem, supports=lifted), options=EXACT, after=solution)
    assert after.converged
    assert contact_forces(after)[0].force == pytest.approx(np.zeros(3))
    lower = np.unique(after.problem.mesh.surfaces["lower z1"])
    assert after.displacement[lower] == pytest.approx(np.zeros((len(lower), 3)), abs=1e-7)


@pytest.mark.thorough
def test_derivatives_by_shape_and_material_are_those_of_problems_solved_anew() -> None:
    """The response is the volume under the pressed face of the upper block.

    A contact is the stiffer the stiffer its material.
    """
    tight = SolverOptions(tolerance=1e-11, maximum_iterations=30)
    mesh = both(bumpy((2, 2, 1), 1), raised(bumpy((3, 2, 1), 2), (0.1, -0.05, 1.06)))
    velocity = mesh.nodes * [0.1, 0.05, 0.1] * mesh.nodes[:, 2:]
    supports = Supports(("lower z0", "upper x1"))
    contact = SurfaceContact("upper z0", "lower z1", 0.05, reach=0.5)

    def solved(step: float, stiffer: float = 0.0) -> Solution:
        moved, rubber = mesh.moved(mesh.nodes + step * velocity), Ogden.neo_hooke(1.0 + stiffer)
        problem = Problem(moved, rubber, supports, ("upper z1",), contacts=(contact,))
        found = solve(problem, 0.3, tight)
        assert found.converged and found.negative_pivots in (None, len(mesh.vertices))
        return found

    start = solved(0.0)
    assert contact_forces(start)[0].force[2] > 0.02
    found = sensitivities(start, {"shape": velocity}, constant_changes(RUBBER))
    stiffer = found.derivatives["volume"]["mu_1"]
    step = 1e-4
    softly, stiffly = (solved(0.0, change).path[-1].volume for change in (-step, step))
    assert stiffer == pytest.approx((stiffly - softly) / (2 * step), rel=1e-4)
    numerical = (solved(step).path[-1].volume - solved(-step).path[-1].volume) / (2 * step)
    assert found.derivatives["volume"]["shape"] == pytest.approx(numerical, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"surface": "lid"}, "no surface is called 'lid'"),
        ({"other": "lid"}, "no surface is called 'lid'"),
        ({"other": "upper z0"}, "must touch another one, not itself"),
        ({"other": "upper x0"}, "'upper z0' and 'upper x0' share nodes"),
        ({"penetration": 0.0}, "penetration = 0 mm must be above 0"),
        ({"reach": -1.0}, "reach = -1 mm must be above 0"),
        ({"reach": "far"}, "contacts: reach"),
    ],
)
def test_contact_of_surfaces_that_means_nothing_is_refused(
    change: dict[str, object], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        Problem(
            stack(),
            RUBBER,
            Supports(("lower z0", "upper z1")),
            contacts=(replace(TOUCH, **change),),
        )


def test_surfaces_that_cross_before_any_load_are_refused() -> None:
    supports = Supports(("lower z0", "upper z1"))
    with pytest.raises(ValueError, match=r"'upper z0' lies 0\.05 mm behind 'lower z1' before any"):
        solve(Problem(stack(gap=-0.05), RUBBER, supports, contacts=(TOUCH,)))
