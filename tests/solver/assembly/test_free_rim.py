"""Pressurised surfaces with a free rim: the skew part of the tangent."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Event, Mesh, Ogden, Problem, SolverOptions, Supports, reaction, solve
from solver.assembly.assembly import Assembly
from solver.assembly.free_rim import free_edges, rim
from solver.assembly.state import State
from solver.errors import SolverError
from solver.linear.sparsity import WholeMatrix

BoxMesh = Callable[..., Mesh]
Points = NDArray[np.float64]
NEO_HOOKE = Ogden((1.0,), (2.0,))


def rims(mesh: Mesh, supports: Supports, *surfaces: str) -> int:
    problem = Problem(mesh, NEO_HOOKE, supports, surfaces)
    return len(free_edges(problem, np.zeros(mesh.nodes.shape)))


def tangent(assembly: Assembly, state: State, pressure: float) -> Points:
    """Dense, both parts."""
    found = assembly.evaluate(state, pressure)
    whole = WholeMatrix.of(assembly.pattern)
    size = assembly.numbering.size
    rows = np.repeat(np.arange(size), np.diff(whole.indptr))
    dense = np.zeros((size, size))
    dense[rows, whole.indices] = whole.by_rows(found.tangent, found.skew)
    return dense


def deformed(assembly: Assembly) -> State:
    mesh = assembly.problem.mesh
    random = np.random.default_rng(5).uniform(-0.05, 0.05, mesh.nodes.shape)
    turn = 0.4 * np.cross([0.0, 1.0, 0.0], mesh.nodes)
    free = assembly.numbering.displacement >= 0
    pressures = np.linspace(-0.1, 0.2, len(mesh.vertices))
    return State(np.where(free, random + turn, 0.0), pressures)


@pytest.mark.parametrize("surfaces", [("x1",), ("z0",), ("x1", "y0", "z1")])
def test_the_whole_tangent_is_the_derivative_of_the_residual(
    box: BoxMesh, surfaces: tuple[str, ...]
) -> None:
    assembly = Assembly(Problem(box((2, 1, 2)), NEO_HOOKE, Supports(("x0",)), surfaces))
    state = deformed(assembly)

    def force(vector: Points) -> Points:
        du, _, _ = assembly.numbering.expand(vector)
        moved = State(state.displacement + du, state.hydrostatic_pressure)
        return assembly.evaluate(moved, 1.0, tangent=False).force

    step = 1e-3  # the force is quadratic in the displacement: central differences are exact
    columns = [force(e) - force(-e) for e in step * np.eye(assembly.numbering.size)]
    numerical = np.array(columns).T / (2 * step)
    ours = tangent(assembly, state, 1.0) - tangent(assembly, state, 0.0)
    assert abs(numerical - numerical.T).max() > 0.1 * abs(numerical).max()
    assert abs(ours - numerical).max() <= 1e-11 * abs(numerical).max()


def test_a_rim_is_what_belongs_to_one_triangle_only(box: BoxMesh) -> None:
    mesh = box((2, 2, 2))
    assert len(rim(mesh.triangles("x1"))) == 8
    assert len(rim(mesh.triangles("x1", "y1"))) == 12
    assert len(rim(mesh.triangles("x0", "x1", "y0", "y1", "z0", "z1"))) == 0


def led_flat(positions: Points, load: float) -> Points:
    displacement = np.full(positions.shape, np.nan)
    displacement[:, 1] = 0.3 * load
    return displacement


def led_askew(positions: Points, load: float) -> Points:
    displacement = np.full(positions.shape, np.nan)
    displacement[:, 1] = 0.3 * load * positions[:, 0]
    return displacement


def test_a_rim_is_free_unless_held_or_sliding_in_a_plane_or_along_a_line(box: BoxMesh) -> None:
    """Face z1 of a cube of one cell: four edges."""
    mesh = box((1, 1, 1))
    clamped, root = Supports(("x0",)), {"x0": 0}
    assert rims(mesh, clamped, "z1") == 3
    assert rims(mesh, Supports(("x0",), {"y0": 1}), "z1") == 2
    assert rims(mesh, Supports(("x0",), {"y0": 1, "y1": 1}), "z1") == 1
    assert rims(mesh, Supports(("x0", "x1", "y0", "y1")), "z1") == 0
    assert rims(mesh, Supports((), root | {"z0": 2, "y0": 1}), "z1") == 2
    # held components of the face itself: each edge can only move along a line
    assert rims(mesh, Supports(("z0",), {"z1": 2}), "z1") == 0
    assert rims(mesh, Supports(("x0",), {}, {"y1": led_flat}), "z1") == 2
    assert rims(mesh, Supports(("x0",), {}, {"y1": led_askew}), "z1") == 3


def test_a_symmetric_tangent_stays_one(box: BoxMesh) -> None:
    supports = Supports(clamped=("x0",), symmetry={"y0": 1})
    assembly = Assembly(Problem(box(), NEO_HOOKE, supports, ("x1", "y1", "z0", "z1")))
    assert assembly.symmetric
    assert len(assembly.evaluate(deformed(assembly), 1.0).skew) == 0


def pulled(mesh: Mesh) -> Problem:
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    return Problem(mesh, NEO_HOOKE, supports, ("x1",))


@pytest.mark.parametrize("name", ["pardiso", "feral", "superlu"])
def test_newtons_corrections_fall_quadratically_with_every_linear_solver(
    box: BoxMesh, name: str
) -> None:
    """A patch in the middle of a block's upper face pressed in at once."""
    pytest.importorskip("feral") if name == "feral" else None
    sizes: list[float] = []

    def listen(event: Event) -> None:
        if event.kind == "iteration":
            sizes.append(event.correction)

    mesh = box((3, 3, 2), (3.0, 3.0, 2.0))
    centres = mesh.nodes[mesh.triangles("z1")[:, :3]].mean(axis=1)
    patch = mesh.triangles("z1")[(abs(centres[:, :2] - 1.5) < 0.5).all(axis=1)]
    mesh = Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, "patch": patch})
    problem = Problem(mesh, NEO_HOOKE, Supports(clamped=("z0",)), ("patch",))
    options = SolverOptions(tolerance=1e-10, first_step=1.0, reuse=0.0, linear_solver=name)
    try:
        solution = solve(problem, 0.5, options, listen)
    except ImportError as error:
        pytest.skip(str(error))
    assert solution.converged and solution.load_steps == 1
    assert solution.linear_solver == ("superlu" if name == "feral" else name)
    small = [size for size in sizes if size < 0.1]
    # quadratic: each relative to the square of the one before, down to rounding
    for before, after in pairwise(small):
        assert after < max(20.0 * before**2, 1e-13)
    assert small[-1] < 1e-9 and len(sizes) <= 9


def test_a_state_once_found_is_an_equilibrium_to_the_last_digits(box: BoxMesh) -> None:
    """Started at the exact state, nothing is left to do; the reaction balances p times the area."""
    mesh = box((4, 1, 1), (4.0, 1.0, 1.0))
    solution = solve(pulled(mesh), -0.5, SolverOptions(tolerance=1e-9))
    start = solution.displacement, solution.hydrostatic_pressure
    again = solve(pulled(mesh), -0.5, initial=start)
    assert again.newton_iterations == 1
    assert np.abs(again.displacement - solution.displacement).max() < 1e-12
    stretch = 1 + solution.displacement[:, 0].max() / 4
    assert reaction(solution, "x0").force[0] == pytest.approx(-0.5 / stretch, rel=1e-9)


def test_whether_a_state_without_potential_is_stable_is_not_known_by_inertia(box: BoxMesh) -> None:
    solution = solve(pulled(box((2, 1, 1))), -0.5)
    assert solution.converged and solution.stable is None and solution.negative_pivots is None


def test_an_adjoint_takes_the_transpose(box: BoxMesh) -> None:
    """Forward and transposed solutions agree in the bilinear form, by each solver there is."""
    from solver.linear.solvers import linear_solver

    assembly = Assembly(Problem(box((2, 1, 2)), NEO_HOOKE, Supports(("x0",)), ("x1",)))
    found = assembly.evaluate(deformed(assembly), 0.5)
    dense = tangent(assembly, deformed(assembly), 0.5)
    a, b = np.random.default_rng(3).normal(size=(2, assembly.numbering.size))
    for name in ("auto", "superlu"):
        solver = linear_solver(name, symmetric=False)
        solver.analyze(assembly.pattern)
        for _ in range(2):
            solver.factorize(found.tangent, found.skew)
        assert dense @ solver.solve(a) == pytest.approx(a, abs=1e-10)
        assert dense.T @ solver.solve(a, transposed=True) == pytest.approx(a, abs=1e-10)
        assert b @ solver.solve(a) == pytest.approx(solver.solve(b, transposed=True) @ a)


def test_a_solver_of_symmetric_matrices_says_so(box: BoxMesh) -> None:
    from solver.linear.solvers import linear_solver

    assembly = Assembly(Problem(box((2, 1, 1)), NEO_HOOKE, Supports(("x0",)), ("x1",)))
    found = assembly.evaluate(deformed(assembly), 0.5)
    solver = linear_solver("auto")
    solver.analyze(assembly.pattern)
    if solver.name != "superlu":
        with pytest.raises(ValueError, match="symmetric matrices only"):
            solver.factorize(found.tangent, found.skew)


def test_far_units_are_scaled_without_symmetry_too(box: BoxMesh) -> None:
    near = solve(pulled(box((2, 1, 1))), -0.5, SolverOptions(tolerance=1e-9))
    mesh = near.problem.mesh
    far_mesh = Mesh(1e4 * mesh.nodes, mesh.tets, mesh.surfaces)
    far = solve(pulled(far_mesh), -0.5, SolverOptions(tolerance=1e-9))
    assert far.displacement == pytest.approx(1e4 * near.displacement, abs=1e-5)


def test_a_free_rim_beside_a_moving_plane_is_refused(cell: Mesh, ninjaflex: Ogden) -> None:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    problem = Problem(cell, ninjaflex, supports, ("z1",), moving_plane="x1")
    with pytest.raises(SolverError, match="have a free rim at"):
        solve(problem, 0.01)
