"""Rigid cylinders and spheres: derivatives, shells shrunk onto them, forces, bad input."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from meshes import box_mesh, tube_mesh
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.spatial.transform import Rotation

from solver import (
    Mesh,
    Ogden,
    Problem,
    RigidCylinder,
    RigidPlane,
    RigidSphere,
    Solution,
    SolverOptions,
    Supports,
    contact_forces,
    potential,
    reaction,
    sensitivities,
    solve,
    work,
)
from solver.assembly.assembly import Assembly
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.pairs.pair import PlaneUnknowns, at_points
from solver.assembly.state import State
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
Round = RigidCylinder | RigidSphere
RUBBER = Ogden.neo_hooke(1.0)
THIRDS = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
EXACT = SolverOptions(tolerance=1e-9, maximum_iterations=20)


def askew(load: float) -> tuple[float, float, float]:
    return (-0.8 * load**2, 0.0, 0.1 * load)


ASKEW = {
    "cylinder": RigidCylinder("x1", 0.2, (1.9, 0.2, 0.5), (1, 3, -2), 0.7, askew),
    "sphere": RigidSphere("x1", 0.2, (1.9, 0.4, 0.6), 0.7, askew),
}


def slopes(function: Callable[[float], Array | float], step: float = 1e-6) -> Array | float:
    return (function(step) - function(-step)) / (2 * step)


@pytest.mark.parametrize("name", ASKEW)
def test_residual_and_tangent_are_derivatives_of_the_energy_at_each_load(
    box: Meshes, name: str
) -> None:
    material, load = Ogden.neo_hooke(1.0, 20.0), 0.7
    assembly = Assembly(
        Problem(box((2, 1, 1)), material, Supports(("x0",)), contacts=(ASKEW[name],))
    )
    size, random = assembly.numbering.size, np.random.default_rng(2)
    place = random.uniform(-0.05, 0.05, size)

    def shaken(vector: Array) -> State:
        return State(*assembly.numbering.expand(vector))

    def contact_residual(vector: Array) -> Array:
        residual = np.zeros(size)
        assembly.contacts.add(shaken(vector), False, residual, np.zeros(0), load)
        return residual

    residual, values = contact_residual(place), np.zeros(len(assembly.pattern.indices))
    values, pattern = assembly.contacts.add(shaken(place), True, np.zeros(size), values, load)
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=(size, size))
    assert abs(residual).max() > 0.01
    for _ in range(3):
        along = random.normal(size=size)

        def energy(step: float, along: Array = along) -> float:
            return assembly.contacts.energy(shaken(place + step * along), load)

        def moved(step: float, along: Array = along) -> Array:
            return contact_residual(place + step * along)

        assert residual @ along == pytest.approx(slopes(energy), rel=1e-6)
        action = upper @ along + upper.T @ along - upper.diagonal() * along
        numerical = slopes(moved)
        assert abs(action - numerical).max() < 1e-6 * abs(numerical).max()


def rod_over_a_block(radius: float, kind: str, motion: Callable[[float], Array] | None) -> Round:
    if kind == "sphere":
        return RigidSphere("z1", 0.01, (0.5, 0.5, 1.01 + radius), radius, motion)
    return RigidCylinder("z1", 0.01, (0.5, 0, 1.01 + radius), (0, 1, 0), radius, motion)


@pytest.mark.parametrize("kind", ["cylinder", "sphere"])
@pytest.mark.parametrize("led", ["rod", "block"])
@pytest.mark.thorough
def test_a_thin_rod_or_small_ball_does_not_get_into_a_block_in_one_step(
    kind: str, led: str
) -> None:
    """A gap that is measured on the block's surface is positive again behind it."""

    def down(load: float) -> Array:
        return np.array([0, 0, -0.15 * load])

    def up(positions: Array, load: float) -> Array:
        return np.broadcast_to([0, 0, 0.15 * load], positions.shape)

    supports = Supports(("z0",)) if led == "rod" else Supports(prescribed={"z0": up})
    rod = rod_over_a_block(0.1, kind, down if led == "rod" else None)
    problem = Problem(box_mesh((4, 4, 2)), RUBBER, supports, contacts=(rod,))
    solution = solve(problem, options=SolverOptions(first_step=1.0))
    (found,) = contact_forces(solution)
    assert solution.refused_steps > 0
    assert found.force[2] < -0.01 and found.gap < 0


@pytest.mark.parametrize("radius", [0.05, 0.02])
def test_a_rod_too_thin_for_the_mesh_stops_the_path_before_it_is_in_the_block(
    radius: float,
) -> None:
    rod = rod_over_a_block(radius, "cylinder", lambda load: np.array([0, 0, -0.2 * load]))
    problem = Problem(box_mesh((4, 4, 2)), RUBBER, Supports(("z0",)), contacts=(rod,))
    solution = solve(problem, options=SolverOptions(smallest_step=0.02))
    assert not solution.converged
    assert "the surface 'z1' would pass through the cylinder" in solution.message
    assert solution.displacement[:, 2].min() > -0.2


@pytest.mark.parametrize("kind", ["cylinder", "sphere"])
def test_a_point_on_an_axis_or_centre_is_pushed_somewhere_across(kind: str) -> None:
    mesh = box_mesh((1, 1, 1))
    rod = rod_over_a_block(0.05, kind, None)
    (pair,) = contact_pairs(Problem(mesh, RUBBER, Supports(("z0",)), contacts=(rod,)))
    state = State.zero(pair.problem)
    point = at_points(pair.face, mesh.nodes)[0, 0]
    moved = replace(state, displacement=np.broadcast_to(rod.place(0.0) - point, mesh.nodes.shape))
    normals = pair.normals(moved, 0.0)
    assert np.linalg.norm(normals, axis=2) == pytest.approx(1.0)
    if isinstance(rod, RigidCylinder):
        assert normals @ rod.direction == pytest.approx(0.0, abs=1e-12)
    residual = np.zeros(3 * len(mesh.nodes))
    pair.add(moved, 0.0, PlaneUnknowns(np.zeros(0), 0.0), residual, np.zeros(0), None)
    assert np.isfinite(residual).all() and abs(residual).max() > 0


def test_a_last_correction_that_loses_the_contact_changes_its_pressure_without_bound() -> None:
    mesh = box_mesh((1, 1, 1))
    rod = rod_over_a_block(0.6, "sphere", None)
    (pair,) = contact_pairs(Problem(mesh, RUBBER, Supports(("z0",)), contacts=(rod,)))
    apart = State.zero(pair.problem)
    touching = replace(apart, displacement=mesh.nodes * [0, 0, 0.05])
    assert pair.change(touching, apart, 0.0) == np.inf
    assert pair.change(apart, apart, 0.0) == 0
    assert pair.change(apart, touching, 0.0) == pytest.approx(1.0)


@pytest.mark.parametrize("name", ASKEW)
def test_the_rate_of_the_residual_knows_that_rigid_bodies_move(box: Meshes, name: str) -> None:
    problem = Problem(box((2, 1, 1)), RUBBER, Supports(("x0",)), contacts=(ASKEW[name],))
    newton = Newton(problem, Loading.of(problem, 0.0), EXACT)
    state, load = State.zero(problem), 0.7
    rate = newton.rate(state, load, newton.evaluate(state, load))
    expected = slopes(lambda step: newton.evaluate(state, load + step, tangent=False).residual)
    assert abs(expected).max() > 0.1
    assert abs(rate - expected).max() < 1e-5 * abs(expected).max()


def inner_radius(solution: Solution, axes: int) -> float:
    """Mean distance of the inner surface's nodes from the centre, or from the z axis."""
    nodes = solution.problem.mesh.surface_nodes("inside")
    places = (solution.problem.mesh.nodes + solution.displacement)[nodes, :axes]
    return float(np.linalg.norm(places, axis=1).mean())


def borne_by_core(inner: float, outer: float, reached: float, power: int) -> float:
    """Pressure between walls of a neo-Hooke tube (1) or hollow sphere (2) of which r follows R."""
    radii, weights = np.polynomial.legendre.leggauss(40)
    first = inner + (outer - inner) * (radii + 1) / 2
    grown = reached ** (power + 1) - inner ** (power + 1)
    now = (first ** (power + 1) + grown) ** (1 / (power + 1))
    stretch = now / first
    difference = stretch**2 - stretch ** (-2 * power)
    growth = (first / now) ** power  # dr / dR
    return float((weights * power * difference / now * growth).sum() * (outer - inner) / 2)


@pytest.mark.parametrize("divisions", [4, 6])
def test_a_shell_under_outer_pressure_shrinks_onto_a_sphere_as_its_closed_form_says(
    sphere: Meshes, divisions: int
) -> None:
    mesh, pressure = sphere(10.0, 15.0, 2, divisions), 0.3
    core = RigidSphere("inside", 0.1, (0, 0, 0), 9.9)
    problem = Problem(mesh, RUBBER, THIRDS, ("outside",), contacts=(core,))
    solution = solve(problem, pressure, EXACT)
    assert solution.converged
    (contact,) = contact_forces(solution)
    reached = inner_radius(solution, 3)
    closed = pressure + borne_by_core(10.0, 15.0, reached, 2)
    assert 0.05 < closed < 0.3 and contact.gap < 0
    eighth = np.pi * reached**2 / 4
    error = {4: 0.02, 6: 0.01}[divisions]  # the triangles are not quite the sphere
    assert contact.force == pytest.approx(3 * [closed * eighth], rel=error)
    assert contact.peak_pressure == pytest.approx(closed, rel=5 * error)
    assert contact.area == pytest.approx(2 * eighth, rel=error)
    if solution.negative_pivots is not None:
        assert solution.negative_pivots == len(mesh.vertices)


def test_a_tube_under_outer_pressure_shrinks_onto_a_cylinder_as_its_closed_form_says() -> None:
    mesh, pressure = tube_mesh(10.0, 20.0, 2.0, (4, 8, 1), np.pi / 2), 0.2
    planes = Supports(symmetry={"start": 1, "end": 0, "z0": 2, "z1": 2})
    core = RigidCylinder("inside", 0.1, (0, 0, 55.0), (0, 0, -4), 9.9)
    solution = solve(Problem(mesh, RUBBER, planes, ("outside",), contacts=(core,)), pressure, EXACT)
    assert solution.converged
    (contact,) = contact_forces(solution, about=(0, 0, 1.0))
    reached = inner_radius(solution, 2)
    closed = pressure + borne_by_core(10.0, 20.0, reached, 1)
    assert 0.05 < closed < 0.2 and contact.gap < 0
    force = closed * reached * 2
    assert contact.force == pytest.approx([force, force, 0], rel=2e-3, abs=1e-6)
    assert contact.moment == pytest.approx(np.zeros(3), abs=0.01 * force)
    assert contact.area == pytest.approx(np.pi * reached, rel=1e-3)


def indented(box: Meshes, turn: Array | None = None) -> Solution:
    """A clamped block that a cylinder is led into askew."""
    turn = np.eye(3) if turn is None else turn
    mesh = box((2, 2, 2), (2.0, 2.0, 1.0))
    cylinder = RigidCylinder(
        "z1", 0.01, tuple(turn @ (1.2, 0.8, 1.75)), tuple(turn @ (1, 2, 0.1)), 0.6,
        lambda load: load * turn @ (0.05, 0, -0.3),
    )  # fmt: skip
    there = Mesh(mesh.nodes @ turn.T, mesh.tets, mesh.surfaces)
    return solve(Problem(there, RUBBER, Supports(("z0",)), contacts=(cylinder,)), options=EXACT)


def test_a_turned_problem_has_the_turned_answer_and_the_clamp_bears_the_force(box: Meshes) -> None:
    turn = Rotation.from_rotvec((0.7, -1.1, 0.4)).as_matrix()
    plain, turned = indented(box), indented(box, turn)
    assert plain.converged and turned.converged
    assert abs(plain.displacement).max() > 0.05
    assert turned.displacement @ turn == pytest.approx(plain.displacement, abs=1e-7)
    (one,), (other,) = contact_forces(plain), contact_forces(turned)
    assert one.force[2] < -0.05 and one.gap < 0
    assert turn.T @ other.force == pytest.approx(one.force, rel=1e-6, abs=1e-9)
    assert turn.T @ other.moment == pytest.approx(one.moment, rel=1e-6, abs=1e-9)
    held = reaction(plain, "z0")
    assert held.force + one.force == pytest.approx(np.zeros(3), abs=1e-7)
    assert held.moment + one.moment == pytest.approx(np.zeros(3), abs=1e-7)


def test_a_sphere_of_large_radius_is_a_plane(box: Meshes) -> None:
    """Over a face of unit size the surface of a sphere of radius R leaves it by 1 / R."""
    plane = RigidPlane("z1", 1e-2, (0, 0, -1), (0, 0, 1.1), lambda load: (0, 0, -0.3 * load))
    mesh, forces = box((1, 1, 1)), []
    radius = 1e6
    ball = RigidSphere("z1", 1e-2, (0, 0, 1.1 + radius), radius, plane.motion)
    for contact in (plane, ball):
        solution = solve(Problem(mesh, RUBBER, THIRDS, contacts=(contact,)), options=EXACT)
        assert solution.converged
        forces.append(contact_forces(solution)[0].force[2])
    assert forces[1] == pytest.approx(forces[0], rel=1e-4)


def test_work_of_a_sphere_that_is_led_is_the_energy_stored(box: Meshes) -> None:
    ball = RigidSphere("z1", 0.02, (0.5, 0.5, 1.6), 0.6, lambda load: (0, 0, -0.2 * load))
    problem = Problem(box((2, 2, 2)), RUBBER, Supports(("z0",)), contacts=(ball,))
    path = solve(problem, options=EXACT, stops=tuple(np.linspace(0.05, 0.95, 19)))
    assert path.converged and len(path.at_stops) == 19
    done = work((*path.at_stops, path))
    assert done.planes > 0.001
    assert done.total == pytest.approx(potential(path).stored, rel=0.01)


@pytest.mark.parametrize("shape", ["cylinder", "sphere"])
def test_derivatives_by_the_shape_are_those_of_problems_solved_anew(
    box: Meshes, shape: str
) -> None:
    """The response is the volume under the face that is pressed."""
    tight = SolverOptions(tolerance=1e-11, maximum_iterations=30)
    mesh = box((2, 2, 1), (2.0, 2.0, 1.0))
    contact: Round = RigidCylinder("z1", 0.05, (1.0, 1.0, 1.7), (0, 1, 0), 0.6, sinking)
    if shape == "sphere":
        contact = RigidSphere("z1", 0.05, (0.9, 1.1, 1.7), 0.6, sinking)
    velocity = mesh.nodes * [0.1, 0.05, 0.2] * mesh.nodes[:, 2:]
    supports = Supports(("z0",))

    def solved(step: float) -> Solution:
        problem = Problem(
            mesh.moved(mesh.nodes + step * velocity), RUBBER, supports, ("z1",),
            contacts=(contact,),
        )  # fmt: skip
        found = solve(problem, 0.02, tight)
        assert found.converged
        return found

    found = sensitivities(solved(0.0), {"shape": velocity})
    numerical = slopes(lambda step: solved(step).path[-1].volume, 1e-4)
    assert found.derivatives["volume"]["shape"] == pytest.approx(numerical, rel=1e-5)


def sinking(load: float) -> tuple[float, float, float]:
    return (0.0, 0.0, -0.25 * load)


BALL = RigidSphere("z1", 0.01, (0.5, 0.5, 1.7), 0.6)
ROD = RigidCylinder("z1", 0.01, (0.5, 0.5, 1.7), (1, 0, 0), 0.6)


@pytest.mark.parametrize(
    ("plain", "change", "words"),
    [
        (BALL, {"surface": "lid"}, "no surface is called 'lid'"),
        (BALL, {"penetration": 0.0}, "penetration = 0 mm must be above 0"),
        (BALL, {"radius": -1.0}, "radius of the rigid sphere = -1 mm must be above 0"),
        (ROD, {"radius": float("nan")}, "radius of the rigid cylinder .mm. must be a finite"),
        (BALL, {"centre": (0, 1)}, "centre of the rigid sphere must be 3 finite numbers"),
        (ROD, {"direction": (0, 0, 0)}, "direction of the rigid cylinder must not have length"),
        (ROD, {"point": 1.0}, "point of the rigid cylinder must be 3 finite numbers"),
        (ROD, {"motion": (0, 0, -1)}, "motion of a rigid cylinder must be a function"),
        (BALL, {"motion": lambda load: (0, 0, 1)}, "motion of the sphere of 'z1' must be zero"),
        (BALL, {"centre": (0.5, 0.5, 1.5)}, r"'z1' lies 0\.09\d+ mm inside its sphere before any"),
        (ROD, {"point": (0, 0.5, 1.5)}, r"'z1' lies 0\.09\d+ mm inside its cylinder before any"),
    ],
)
def test_a_round_body_that_means_nothing_is_refused(
    box: Meshes, plain: Round, change: dict[str, object], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        contact = replace(plain, **change)
        solve(Problem(box((2, 2, 1)), RUBBER, Supports(("z0",)), contacts=(contact,)))
