"""Rigid planes: their equations, what bodies feel that are pressed against them, bad input."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from meshes import renamed
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.spatial.transform import Rotation

from solver import (
    Mesh,
    Ogden,
    PointForce,
    Problem,
    RigidPlane,
    SlenderAxis,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    contact_forces,
    inflate,
    reaction,
    solve,
    trace,
)
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
RUBBER = Ogden.neo_hooke(1.0)
THIRDS = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
EXACT = SolverOptions(tolerance=1e-9, maximum_iterations=20)


def lid(depth: float, travel: float = 0.5, height: float = 1.1) -> RigidPlane:
    """A plane that comes down on the face z1."""
    return RigidPlane("z1", depth, (0, 0, -3), (0, 0, height), lambda load: (0, 0, -travel * load))


def pressed(mesh: Mesh, plane: RigidPlane, options: SolverOptions = EXACT) -> Solution:
    solution = solve(Problem(mesh, RUBBER, THIRDS, contacts=(plane,)), options=options)
    assert solution.converged
    return solution


def slopes(function: Callable[[float], Array | float], step: float = 1e-6) -> Array | float:
    return (function(step) - function(-step)) / (2 * step)


def oblique(mesh: Mesh, bulk_modulus: float = np.inf) -> Assembly:
    """A clamped block that a plane runs into askew."""

    def motion(load: float) -> tuple[float, float, float]:
        return (-0.8 * load**2, 0.0, 0.1 * load)

    plane = RigidPlane("x1", 0.2, (-3, 1, 2), (1.4, 0.2, 0.5), motion)
    material = Ogden.neo_hooke(1.0, bulk_modulus)
    return Assembly(Problem(mesh, material, Supports(("x0",)), contacts=(plane,)))


def shaken(assembly: Assembly, vector: Array) -> State:
    return State(*assembly.numbering.expand(vector))


def test_residual_and_tangent_are_derivatives_of_the_energy_at_each_load(box: Meshes) -> None:
    assembly, load = oblique(box((2, 1, 1)), 20.0), 0.7
    size, random = assembly.numbering.size, np.random.default_rng(2)
    place = random.uniform(-0.05, 0.05, size)
    found = assembly.evaluate(shaken(assembly, place), 0.0, load=load)
    contact = np.zeros(size)
    assembly.contacts.add(shaken(assembly, place), False, contact, np.zeros(0), load)
    assert abs(contact).max() > 0.01
    upper = csr_array(
        (found.tangent, found.pattern.indices, found.pattern.indptr), shape=(size, size)
    )
    for _ in range(3):
        along = random.normal(size=size)

        def energy(step: float, along: Array = along) -> float:
            return assembly.energy(shaken(assembly, place + step * along), load)

        def residual(step: float, along: Array = along) -> Array:
            there = shaken(assembly, place + step * along)
            return assembly.evaluate(there, 0.0, False, load).residual

        assert found.residual @ along == pytest.approx(slopes(energy), rel=1e-6)
        action = upper @ along + upper.T @ along - upper.diagonal() * along
        numerical = slopes(residual)
        assert abs(action - numerical).max() < 1e-5 * abs(numerical).max()


def test_the_rate_of_the_residual_knows_that_planes_move(box: Meshes) -> None:
    problem = oblique(box((2, 1, 1))).problem
    problem = replace(problem, loads=(Traction("z1", (0, 0, 0.1)),))
    newton = Newton(problem, Loading.of(problem, 0.0), EXACT)
    state, load = State.zero(problem), 0.7

    def residual(step: float) -> Array:
        return newton.evaluate(state, load + step, tangent=False).residual

    rate = newton.rate(state, load, newton.evaluate(state, load))
    expected = slopes(residual)
    assert abs(expected).max() > 0.1
    assert abs(rate - expected).max() < 1e-5 * abs(expected).max()


def test_a_block_between_two_plates_bears_what_homogeneous_compression_says(box: Meshes) -> None:
    """Under the stretch reached, mu (1 / l^2 - l) per first area, pressure at l times as much."""
    solution = pressed(box((2, 2, 2)), lid(1e-3))
    stretch = 1 + solution.displacement[solution.problem.mesh.surface_nodes("z1"), 2]
    assert stretch == pytest.approx(stretch[0], abs=1e-12)
    borne = stretch[0] ** -2 - stretch[0]
    (contact,) = contact_forces(solution, about=(0.5, 0.5, 0.0))
    assert contact.force == pytest.approx([0, 0, -borne], rel=1e-9, abs=1e-12)
    shift = 0.5 * (stretch[0] ** -0.5 - 1)  # the middle of the quarter moves off the point
    assert contact.moment == pytest.approx([-borne * shift, borne * shift, 0], rel=1e-9, abs=1e-12)
    assert contact.area == pytest.approx(1 / stretch[0], rel=1e-9)
    assert contact.peak_pressure == pytest.approx(borne * stretch[0], rel=1e-9)
    assert contact.gap == pytest.approx(0.6 - stretch[0], abs=1e-12)
    assert reaction(solution, "z0").force == pytest.approx(-contact.force, abs=1e-9)


def test_the_force_converges_linearly_with_the_penetration_asked_for(box: Meshes) -> None:
    mesh, exact, errors = box((1, 1, 1)), 0.6**-2 - 0.6, []
    for depth in (1e-2, 1e-3, 1e-4):
        (contact,) = contact_forces(pressed(mesh, lid(depth)))
        errors.append(-contact.force[2] / exact - 1)
    assert abs(errors[-1]) < 2e-3
    assert errors[:-1] == pytest.approx(10 * np.array(errors[1:]), rel=0.15)


def test_a_plane_that_stands_still_is_a_contact_with_a_plane_of_symmetry(box: Meshes) -> None:
    from solver import Contact

    still = RigidPlane("z1", 0.01, (0, 0, -1), (7, -3, 1.1))
    problem = Problem(box((2, 2, 2)), RUBBER, THIRDS, ("x1", "y1"), contacts=(still,))
    mirror = replace(problem, contacts=(Contact("z1", 0.01, axis=2, position=1.1),))
    one, other = solve(problem, 1.0), solve(mirror, 1.0)
    assert one.displacement == pytest.approx(other.displacement, abs=1e-12)
    force, same = contact_forces(one)[0].force, contact_forces(other)[0].force
    assert force[2] < -0.1 and force == pytest.approx(same, abs=1e-12)


@pytest.mark.parametrize("travel", [0.1, 0.2, 0.3])
def test_the_default_tolerance_settles_the_force(sphere: Meshes, travel: float) -> None:
    """Though a correction of a tenth of the penetration changes a pressure by a tenth of mu."""
    mesh, forces = sphere(8.0, 10.0, 1, 5), []
    plane = RigidPlane(
        "outside", 0.01 * travel, (0, 0, -1), (0, 0, 10.05),
        lambda load: (0, 0, -load * (travel + 0.05)),
    )  # fmt: skip
    for options in (SolverOptions(), EXACT):
        solution = solve(Problem(mesh, RUBBER, THIRDS, contacts=(plane,)), options=options)
        assert solution.converged
        forces.append(contact_forces(solution)[0].force[2])
    assert forces[0] == pytest.approx(forces[1], rel=1e-3)


@pytest.mark.parametrize("depth", [0.1, 0.01])
@pytest.mark.parametrize("away", [0.0, 1.0, 10.0])
def test_the_default_tolerance_settles_the_force_on_a_soft_body_too(
    box: Meshes, depth: float, away: float
) -> None:
    """A bar bent by a plane: the clamp bears all of it, at pressures far below the modulus."""
    slanted = RigidPlane(
        "z1", depth, (-0.5, 0, -1), (10, 0, 1 + away), lambda load: (0, 0, -load * (3 + away))
    )
    problem = Problem(box((10, 2, 2), (10, 1, 1)), RUBBER, Supports(("x0",)), contacts=(slanted,))
    solution = solve(problem)
    assert solution.converged
    pushed = contact_forces(solution)[0].force
    assert reaction(solution, "x0").force == pytest.approx(-pushed, rel=5e-3, abs=1e-8)


@pytest.mark.parametrize("away", [0.0, 1.0, 100.0, 1e4])
def test_a_plane_may_come_from_far_away(box: Meshes, away: float) -> None:
    """Steps before the touch move nothing, the one after it the body at once."""
    plane = lid(1e-3, travel=0.3 + away, height=1.0 + away)
    solution = pressed(box((1, 1, 1)), plane)
    stretch = 1 + solution.displacement[:, 2].min()
    assert stretch == pytest.approx(0.7, abs=2e-3)
    force = contact_forces(solution)[0].force[2]
    assert -force == pytest.approx(stretch**-2 - stretch, rel=1e-6)


def test_a_turned_problem_has_the_turned_answer(box: Meshes) -> None:
    mesh, turn = box((2, 1, 1), (2, 1, 1)), Rotation.from_rotvec((0.7, -1.1, 0.4)).as_matrix()
    normal, point, travel = np.array([-3.0, 0, 2]), np.array([2.0, 0, 0]), np.array([-0.6, 0, 0])

    def solved(turned: Array) -> Solution:
        plane = RigidPlane(
            "x1", 0.01, tuple(turned @ (2 * normal)), tuple(turned @ (point - 0.05 * normal)),
            lambda load: load * turned @ travel,
        )  # fmt: skip
        there = Mesh(mesh.nodes @ turned.T, mesh.tets, mesh.surfaces)
        return solve(Problem(there, RUBBER, Supports(("x0",)), contacts=(plane,)), options=EXACT)

    plain, askew = solved(np.eye(3)), solved(turn)
    assert plain.converged and askew.converged
    assert abs(plain.displacement).max() > 0.1
    assert askew.displacement @ turn == pytest.approx(plain.displacement, abs=1e-7)
    (one,), (other,) = contact_forces(plain), contact_forces(askew)
    assert turn.T @ other.force == pytest.approx(one.force, rel=1e-6, abs=1e-9)
    assert turn.T @ other.moment == pytest.approx(one.moment, rel=1e-6, abs=1e-9)
    assert (other.area, other.peak_pressure) == pytest.approx((one.area, one.peak_pressure), 1e-6)
    held = reaction(plain, "x0")
    assert held.force + one.force == pytest.approx(np.zeros(3), abs=1e-7)
    assert held.moment + one.moment == pytest.approx(np.zeros(3), abs=1e-7)


def test_a_plane_that_goes_back_leaves_nothing_behind(box: Meshes) -> None:
    there_and_back = replace(lid(1e-3), motion=lambda load: (0, 0, -0.4 * np.sin(np.pi * load)))
    deepest: list[float] = []

    def watched(state: State) -> str:
        deepest.append(float(state.displacement[:, 2].min()))
        return ""

    problem = Problem(box((1, 1, 1)), RUBBER, THIRDS, contacts=(there_and_back,))
    solution = solve(problem, options=EXACT, guard=watched)
    assert solution.converged and min(deepest) < -0.2
    (contact,) = contact_forces(solution)
    assert abs(solution.displacement).max() < 1e-7
    assert abs(contact.force).max() == contact.area == contact.peak_pressure == 0
    assert contact.gap == pytest.approx(0.1, abs=1e-7)


def test_the_plate_and_the_clamp_share_what_the_pressure_exerts_on_a_sheet(box: Meshes) -> None:
    """The rim stays in its plane: the pressure's resultant is pressure times the first area."""
    mesh = renamed(box((4, 4, 1), (5.0, 5.0, 0.5)), {"x1": "rim", "y1": "rim"})
    supports = Supports(("rim",), symmetry={"x0": 0, "y0": 1})
    plate = RigidPlane("z1", 0.01, (0, 0, -1), (0, 0, 1.0))
    solution = solve(Problem(mesh, RUBBER, supports, ("z0",), contacts=(plate,)), 0.2)
    assert solution.converged
    (contact,) = contact_forces(solution)
    assert 0.2 * 25 * 0.3 < -contact.force[2] < 0.2 * 25
    held = reaction(solution, "rim").force
    assert held[2] + contact.force[2] == pytest.approx(-0.2 * 25, rel=1e-4)
    assert 1 < contact.area < 25


def test_a_slender_bar_leans_on_a_plane_the_same_with_an_axis_and_without(box: Meshes) -> None:
    mesh = box((12, 1, 2), (12.0, 1.0, 1.0))
    plane = RigidPlane("z1", 0.01, (0, 0, -1), (0, 0, 3.0))
    load = PointForce((12.0, 0.0, 0.0), (0.0, 0.0, 0.02))
    bare = Problem(mesh, RUBBER, Supports(("x0",), {"y0": 1}), loads=(load,), contacts=(plane,))
    along = replace(bare, axis=SlenderAxis((0.0, 3.0, 6.0, 9.0, 12.0)))
    one, other = solve(bare, options=EXACT), solve(along, options=EXACT)
    assert one.converged and other.converged
    assert one.displacement == pytest.approx(other.displacement, abs=1e-6)
    assert contact_forces(one)[0].force[2] < -0.005
    free = solve(replace(bare, contacts=()))
    assert free.displacement[:, 2].max() > 1.2 * one.displacement[:, 2].max()


def test_arc_length_follows_a_plane_that_moves(box: Meshes) -> None:
    """The lid stands on the block from the start: the path has a direction at no load."""
    touching = lid(0.01, travel=0.3, height=1.0)
    problem = Problem(box((1, 1, 1)), RUBBER, THIRDS, loads=(Traction("z1", (0, 0, -0.01)),))
    walked = trace(replace(problem, contacts=(touching,)), until=lambda point: point.load >= 1)
    last = walked.points[-1].load
    assert last >= 1 and not walked.limits
    state = walked.states[-1]
    assert state.displacement[:, 2].min() == pytest.approx(-0.3 * last, abs=0.02)


@pytest.mark.parametrize("depth", [1e-4, 1e-8])
@pytest.mark.thorough
def test_a_block_between_plates_is_lost_where_one_with_led_ends_is(
    box: Meshes, depth: float
) -> None:
    """However stiff the contact, the whole load is beyond: there the block would be unstable."""

    def led(positions: Array, load: float) -> Array:
        return np.broadcast_to([np.nan, np.nan, -0.5 * load], positions.shape)

    mesh = box((3, 3, 3))
    supports = replace(THIRDS, prescribed={"z1": led})
    loads = [solve(Problem(mesh, RUBBER, supports)).load]
    loads += [solve(Problem(mesh, RUBBER, THIRDS, contacts=(lid(depth, 0.5, 1.0),))).load]
    assert loads[0] < 0.995
    assert loads[1] == pytest.approx(loads[0], abs=5e-3)


def test_arc_length_follows_a_plane_that_comes_to_the_body(box: Meshes) -> None:
    """Nothing moves before the touch at a quarter of the load, which is a kink and no limit."""
    problem = Problem(box((2, 2, 2)), RUBBER, THIRDS, contacts=(lid(0.01, travel=0.4),))
    walked = trace(problem, until=lambda point: point.load >= 1)
    assert walked.points[-1].load >= 1 and not walked.limits
    touched = [
        (point.load, state.displacement[:, 2].min())
        for point, state in zip(walked.points, walked.states, strict=True)
        if point.load > 0.26
    ]
    assert len(touched) >= 3
    for load, moved in touched:
        assert moved == pytest.approx(0.1 - 0.4 * load, abs=0.03)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"surface": "lid"}, "no surface is called 'lid'"),
        ({"penetration": 0.0}, "penetration = 0 mm must be above 0"),
        ({"penetration": float("inf")}, "penetration .mm. must be a finite number"),
        ({"penetration": "deep"}, "penetration .mm. must be a finite number, got deep"),
        ({"normal": (0, 0, 0)}, "must not have length zero"),
        ({"normal": (0, 1)}, "normal of the rigid plane must be 3 finite numbers"),
        ({"normal": (0, 0, float("nan"))}, "normal of the rigid plane must be 3 finite numbers"),
        ({"point": 1.0}, "point of the rigid plane must be 3 finite numbers"),
        ({"point": (0, 0, float("inf"))}, "point of the rigid plane must be 3 finite numbers"),
        ({"motion": (0, 0, -1)}, "must be a function of the load"),
        ({"motion": lambda load: (0, 0, 1 - load / 2)}, "zero at no load, got 1 mm"),
        ({"motion": lambda load: -load}, "motion of the plane of 'z1' at load 0 .mm. must be 3"),
        ({"motion": lambda load: (0, 0, np.log(1 - load))}, "at load 1 .mm. must be 3 finite"),
        ({"normal": (0, 0, 1)}, "'z1' lies .* on the side to which the normal"),
        ({"point": (0, 0, 0.75)}, r"'z1' lies 0\.25 mm beyond its plane before any load"),
    ],
)
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_a_plane_that_means_nothing_is_refused(
    box: Meshes, change: dict[str, object], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        pressed(box((1, 1, 1)), replace(lid(0.01), **change))


@pytest.mark.parametrize("given", ["z1", 3.0, lid(0.01), ("z1",), (None,)])
def test_contacts_that_are_none_are_refused(box: Meshes, given: object) -> None:
    with pytest.raises(ValueError, match="contacts: needs"):
        Problem(box((1, 1, 1)), RUBBER, THIRDS, contacts=given)  # type: ignore[arg-type]


def test_a_body_that_only_planes_hold_is_refused(box: Meshes) -> None:
    with pytest.raises(ValueError, match="translation along z"):
        Problem(box(), RUBBER, Supports(symmetry={"x0": 0, "y0": 1}), contacts=(lid(0.01),))


def test_a_cell_takes_no_rigid_plane(cell: Mesh) -> None:
    plane = RigidPlane("outside", 0.1, (0, 0, -1), (0, 0, 9.0))
    middles = Supports(symmetry={"x0": 0, "y0": 1})
    with pytest.raises(ValueError, match="not rigid planes"):
        Problem(cell, RUBBER, middles, ("cavity",), moving_plane="x1", contacts=(plane,))


def test_volume_control_leads_planes_first(box: Meshes) -> None:
    """A sheet against a plate that has come down: the same state by pressure and by volume."""
    mesh = renamed(box((3, 3, 1), (5.0, 5.0, 0.5)), {"x1": "rim", "y1": "rim"})
    supports = Supports(("rim",), symmetry={"x0": 0, "y0": 1})
    plate = RigidPlane("z1", 0.02, (0, 0, -1), (0, 0, 1.5), lambda load: (0, 0, -0.5 * load))
    problem = Problem(mesh, RUBBER, supports, ("z0",), contacts=(plate,))
    blown = solve(problem, 0.2, EXACT)
    same = inflate(problem, blown.path[-1].volume, EXACT)
    assert blown.converged and same.converged
    assert same.pressure == pytest.approx(0.2, rel=1e-6)
    assert same.displacement == pytest.approx(blown.displacement, abs=1e-6)
    assert contact_forces(same)[0].force == pytest.approx(contact_forces(blown)[0].force, rel=1e-5)


def test_a_stage_goes_on_where_the_plane_stands(box: Meshes) -> None:
    """Pressed in two stages, pulled while pressed, and let go again."""
    half = lid(1e-3, travel=0.25)
    second = replace(half, point=(0, 0, 0.85))
    problem = Problem(box((1, 1, 1)), RUBBER, THIRDS, contacts=(half,))
    first = solve(problem, options=EXACT)
    onward = solve(replace(problem, contacts=(second,)), options=EXACT, after=first, stops=(0.5,))
    at_once = solve(replace(problem, contacts=(lid(1e-3),)), options=EXACT)
    assert onward.converged
    assert onward.displacement == pytest.approx(at_once.displacement, abs=1e-8)
    assert contact_forces(onward)[0].force == pytest.approx(contact_forces(at_once)[0].force, 1e-7)
    pair = (contact_forces(each)[0].force[2] for each in (onward.at_stops[0], onward))
    assert 0 > next(pair) > next(pair)
    gone = solve(replace(problem, contacts=()), options=EXACT, after=first)
    assert gone.converged and abs(gone.displacement).max() < 1e-7
