"""Linear springs: closed forms of bars, rigid bodies and columns on them, and bad input."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from inertia import needs_inertia
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.sparse import csr_array
from scipy.spatial.transform import Rotation

from solver import (
    FoundationSpring,
    Mesh,
    NodeSpring,
    Ogden,
    PointForce,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    reaction,
    solve,
)
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.nonlinear.linear_system import LinearSystem
from solver.problem.springs import Spring

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
RUBBER = Ogden.neo_hooke(1.0)
THIRDS = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
EXACT = SolverOptions(tolerance=1e-10, maximum_iterations=20)


def test_a_bar_pulls_its_spring_as_far_as_one_equation_says(box: Meshes) -> None:
    """mu (l - 1 / l^2) + k (l - 1) L = t with a foundation of stiffness k at the end of L."""
    mesh = box((3, 1, 1), (3.0, 1.0, 1.0))
    spring, load = FoundationSpring("x1", (0.2, 0, 0)), Traction("x1", (1.5, 0, 0))
    solution = solve(Problem(mesh, RUBBER, THIRDS, loads=(load,), springs=(spring,)), options=EXACT)
    exact = brentq(lambda s: s - s**-2 + 0.6 * (s - 1) - 1.5, 1.0, 3.0)
    assert exact > 1.5
    stretch = 1 + solution.displacement[mesh.surface_nodes("x1"), 0] / 3
    assert stretch == pytest.approx(exact, rel=1e-9)
    held = reaction(solution, "x0").force
    assert held == pytest.approx([exact**-2 - exact, 0, 0], rel=1e-8, abs=1e-9)


@pytest.mark.parametrize("linear_solver", ["auto", "superlu"])
def test_a_follower_pressure_pulls_a_bar_and_its_spring(box: Meshes, linear_solver: str) -> None:
    """mu (l - 1 / l^2) + k (l - 1) L = |p| / l, by a tangent without symmetry."""
    mesh = box((4, 1, 1), (4.0, 1.0, 1.0))
    problem = Problem(mesh, RUBBER, THIRDS, ("x1",), springs=(FoundationSpring("x1", (0.1, 0, 0)),))
    solution = solve(problem, -2.0, replace(EXACT, linear_solver=linear_solver))
    exact = brentq(lambda s: s - s**-2 + 0.4 * (s - 1) - 2 / s, 1.0, 3.0)
    assert solution.converged and exact > 1.3
    assert solution.displacement[:, 0].max() / 4 == pytest.approx(exact - 1, rel=1e-8)


def test_springs_on_all_nodes_of_an_end_are_one_spring(box: Meshes) -> None:
    """The end stays plane, so that only the sum of the springs matters."""
    mesh = box((2, 1, 1), (2.0, 1.0, 1.0))
    nodes = mesh.surface_nodes("x1")
    many = tuple(NodeSpring(tuple(mesh.nodes[n]), (1 / len(nodes), 0, 0)) for n in nodes)
    flat = Supports(prescribed={"x1": lambda at, load: [load, np.nan, np.nan] + 0 * at})
    held = replace(flat, symmetry=THIRDS.symmetry)
    forces = []
    for springs in ((), many, (FoundationSpring("x1", (1, 0, 0)),)):
        solution = solve(Problem(mesh, RUBBER, held, springs=springs), options=EXACT)
        forces.append(reaction(solution, "x1").force[0])
    bare = 1.5 - 1.5**-2
    assert forces == pytest.approx([bare, bare + 1, bare + 1], rel=1e-9)


def test_a_stiff_body_on_three_springs_sinks_as_statics_says(box: Meshes) -> None:
    """Three springs that bear different shares, and three that hold it within the plane.

    Under so little that lever arms change by a ten-thousandth.
    """
    mesh, force, stiffness = box((2, 2, 1)), np.array([0.0, 0.0, -1e-5]), 0.1
    feet = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    springs = [NodeSpring(tuple(foot), (0, 0, stiffness)) for foot in feet]
    guides = [((0, 0, 0), (1, 0, 0)), ((0, 0, 0), (0, 1, 0)), ((0, 1, 0), (1, 0, 0))]
    springs += [NodeSpring(foot, axis) for foot, axis in guides]
    load = PointForce((0.5, 0.5, 1.0), tuple(force))
    problem = Problem(mesh, Ogden.neo_hooke(1e4), Supports(), loads=(load,), springs=tuple(springs))
    solution = solve(problem, options=EXACT)
    assert solution.converged and solution.stable is not False
    shares = np.linalg.solve(np.vstack([feet[:, :2].T, np.ones(3)]), [0.5, 0.5, 1.0])
    sunk = [solution.displacement[(mesh.nodes == foot).all(axis=1), 2][0] for foot in feet]
    assert sunk == pytest.approx(-1e-5 * shares / stiffness, abs=2e-8)
    borne = -stiffness * sum(sunk)
    assert borne == pytest.approx(1e-5, rel=1e-4)


def test_springs_are_derivatives_of_their_energy(box: Meshes) -> None:
    """Also where they couple free displacements with given ones."""
    mesh, turn = box((2, 1, 1)), Rotation.from_rotvec((0.5, 0.2, -0.9)).as_matrix()
    stiffness = turn @ np.diag([3.0, 0.5, 0.0]) @ turn.T
    springs = (FoundationSpring("z1", stiffness), NodeSpring((1, 1, 0), (1.0, 2.0, 3.0)))
    led = Supports(prescribed={"x0": lambda at, load: load * (0.1 + 0 * at)})
    material = Ogden.neo_hooke(1.0, 10.0)
    having, bare = (Assembly(Problem(mesh, material, led, springs=s)) for s in (springs, ()))
    random, size = np.random.default_rng(4), bare.numbering.size
    given = np.where(bare.numbering.displacement < 0, 0.1, 0.0)
    place = random.uniform(-0.05, 0.05, size)

    def state(vector: Array) -> State:
        free = State(*bare.numbering.expand(vector))
        return replace(free, displacement=free.displacement + given)

    def difference(vector: Array) -> Array:
        pair = (each.evaluate(state(vector), 0.0, False).residual for each in (having, bare))
        return next(pair) - next(pair)

    def energy(vector: Array) -> float:
        return having.energy(state(vector)) - bare.energy(state(vector))

    one, other = (each.evaluate(state(place), 0.0) for each in (having, bare))
    pattern = one.pattern
    values = (one.tangent - other.tangent, pattern.indices, pattern.indptr)
    upper = csr_array(values, shape=(size, size))
    assert energy(place) > 1e-3
    for _ in range(3):
        along = random.normal(size=size)
        slope = (energy(place + 1e-4 * along) - energy(place - 1e-4 * along)) / 2e-4
        assert difference(place) @ along == pytest.approx(slope, rel=1e-6)
        numerical = (difference(place + along) - difference(place - along)) / 2  # linear
        action = upper @ along + upper.T @ along - upper.diagonal() * along
        assert action == pytest.approx(numerical, abs=1e-9)


def test_a_turned_spring_has_the_turned_matrix(box: Meshes) -> None:
    mesh, turn = box((2, 1, 1), (2, 1, 1)), Rotation.from_rotvec((0.7, -1.1, 0.4)).as_matrix()

    def solved(turned: Array) -> Solution:
        stiffness = turned @ np.diag([0.0, 0.1, 0.3]) @ turned.T
        there = Mesh(mesh.nodes @ turned.T, mesh.tets, mesh.surfaces)
        load = Traction("x1", tuple(turned @ np.array([0.0, 0.02, -0.05])))
        springs = (FoundationSpring("x1", stiffness),)
        problem = Problem(there, RUBBER, Supports(("x0",)), loads=(load,), springs=springs)
        return solve(problem, options=EXACT)

    plain, askew = solved(np.eye(3)), solved(turn)
    assert abs(plain.displacement).max() > 0.1
    assert askew.displacement @ turn == pytest.approx(plain.displacement, abs=1e-8)


@needs_inertia
@pytest.mark.parametrize("stiffness", [0.0, 1e-3, 4e-3, 1.0])
def test_a_column_with_a_spring_at_its_head_buckles_as_euler_says(
    box: Meshes, stiffness: float
) -> None:
    """tan(u) = u - u^3 E I / (k L^3), u^2 = P L^2 / E I; E = 3 mu, and 20 : 1 is slender."""
    mesh = box((20, 1, 1), (20.0, 1.0, 1.0))
    rigidity, support = 3.0 / 12, stiffness * 20**3
    bending = brentq(
        lambda u: support * (np.sin(u) - u * np.cos(u)) + rigidity * u**3 * np.cos(u),
        0.5,
        4.4934094579,
    )
    critical = bending**2 * rigidity / 20**2
    at_foot = NodeSpring((0, 0, 0), (0, 0, 1.0))
    at_head = FoundationSpring("x1", (0, 0, stiffness))
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    assembly = Assembly(Problem(mesh, RUBBER, supports, springs=(at_foot, at_head)))
    system = LinearSystem(assembly, "auto")

    def unstable_modes(load: float) -> int | None:
        stretch = brentq(lambda s: s**-2 - s - load, 0.5, 1.0)
        sides = stretch**-0.5
        displacement = mesh.nodes * (np.array([stretch, sides, sides]) - 1)
        pressure = (1 / stretch - stretch**2) / 3
        state = State(displacement, np.full(len(mesh.vertices), pressure))
        system.factorize(assembly.evaluate(state, 0.0))
        return system.unstable_modes

    assert unstable_modes(0.98 * critical) == 0
    assert unstable_modes(1.02 * critical) == 1


@pytest.mark.parametrize(
    ("springs", "count"),
    [
        ((), 6),
        ((NodeSpring((0, 0, 0), (1, 1, 1)),), 3),
        ((NodeSpring((0, 0, 0), (1, 1, 1)), NodeSpring((1, 0, 0), (0, 1, 1))), 1),
        ((FoundationSpring("z0", (0, 0, 1)),), 3),
        ((FoundationSpring("z0", (0, 0, 1)), NodeSpring((0, 0, 0), (1, 1, 0))), 1),
        ((FoundationSpring("z0", np.ones((3, 3))),), 3),
        ((FoundationSpring("z0", (0, 0, 0)),), 6),
        ((FoundationSpring("z0", (1, 0, 0)), FoundationSpring("x0", (0, 1, 1))), 1),
        ((FoundationSpring("z0", (1, 1e-3, 1e-3)),), 0),
    ],
)
def test_springs_hold_rigid_motions(box: Meshes, springs: tuple[Spring, ...], count: int) -> None:
    if not count:
        assert solve(Problem(box((1, 1, 1)), RUBBER, Supports(), springs=springs)).converged
        return
    with pytest.raises(ValueError, match=f"free to move in {count} way"):
        Problem(box((1, 1, 1)), RUBBER, Supports(), springs=springs)


@pytest.mark.parametrize(
    ("spring", "words"),
    [
        (lambda: FoundationSpring("end", (1, 1, 1)), "no surface is called 'end'"),
        (lambda: FoundationSpring("x1", (1, -1, 1)), "N/mm.3. must not be negative, got -1"),
        (lambda: FoundationSpring("x1", (1, np.nan, 1)), "3 finite numbers or 3 x 3 finite"),
        (lambda: FoundationSpring("x1", 1.0), "3 finite numbers or 3 x 3 finite"),
        (lambda: FoundationSpring("x1", "stiff"), "3 finite numbers or 3 x 3 finite"),
        (lambda: NodeSpring((0, 0, 0), np.diag([1, 1, -2])), "must not be negative, got -2"),
        (lambda: NodeSpring((0, 0, 0), [[1, 1, 0], [0, 1, 0], [0, 0, 1]]), "symmetric matrix"),
        (lambda: NodeSpring((0, 0), (1, 1, 1)), "position of a node .mm. must be 3 finite"),
        (lambda: NodeSpring((0, 0, 0.3), (1, 1, 1)), "springs: no node lies at"),
        (lambda: Traction("x1", (1, 1, 1)), "needs FoundationSpring or NodeSpring"),
    ],
)
def test_a_spring_that_means_nothing_is_refused(
    box: Meshes, spring: Callable[[], Spring], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        Problem(box((1, 1, 1)), RUBBER, THIRDS, springs=(spring(),))


@pytest.mark.parametrize("given", [FoundationSpring("x1", (1, 1, 1)), "x1", 3.0, None])
def test_springs_that_are_no_tuple_are_refused(box: Meshes, given: object) -> None:
    with pytest.raises(ValueError, match="springs: needs a tuple"):
        Problem(box((1, 1, 1)), RUBBER, THIRDS, springs=given)  # type: ignore[arg-type]


def test_a_cell_takes_no_spring(cell: Mesh) -> None:
    springs = (FoundationSpring("outside", (0, 0, 1)),)
    middles = Supports(symmetry={"x0": 0, "y0": 1})
    with pytest.raises(ValueError, match="a cell with a moving plane takes none"):
        Problem(cell, RUBBER, middles, ("cavity",), moving_plane="x1", springs=springs)
