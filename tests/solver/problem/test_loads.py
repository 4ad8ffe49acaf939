"""Dead loads, prescribed motions and the reactions of supports."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from meshes import tube_mesh

from solver import (
    BodyForce,
    EdgeForce,
    Mesh,
    Ogden,
    PointForce,
    Problem,
    SlenderAxis,
    SolverOptions,
    Supports,
    Traction,
    nodal_von_mises,
    reaction,
    solve,
)
from solver.errors import SolverError
from solver.problem.loads import nodal_forces

Meshes = Callable[..., Mesh]
Array = np.ndarray
THREE_PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=40)
M1 = json.loads((Path(__file__).parents[1] / "data/ogden_points.json").read_text())["cases"][0]


def sheared(positions: Array, load: float) -> Array:
    return load * np.outer(positions[:, 2], [0.4, 0.0, 0.0])


def stretched(to: float) -> Callable[[Array, float], Array]:
    """Moves a face along x to a stretch; it may slide in its plane."""

    def motion(positions: Array, load: float) -> Array:
        free = np.full(len(positions), np.nan)
        return np.stack([load * (to - 1) * positions[:, 0], free, free], axis=1)

    return motion


def turned(turns: float) -> Callable[[Array, float], Array]:
    """Turns everything about the y axis."""

    def motion(positions: Array, load: float) -> Array:
        angle = 2 * np.pi * turns * load
        c, s = np.cos(angle), np.sin(angle)
        return positions @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]) - positions

    return motion


def test_a_traction_on_a_curved_surface_adds_up_to_stress_times_area(sphere: Meshes) -> None:
    mesh = sphere(10.0, 12.0, 1, 6)
    forces = nodal_forces(mesh, [Traction("inside", (1.0, -2.0, 0.5))])
    area = 4 * np.pi * 10**2 / 8
    assert forces.sum(axis=0) == pytest.approx(np.array([1.0, -2.0, 0.5]) * area, rel=1e-3)


def test_a_linear_traction_has_the_moment_of_its_resultant(box: Meshes) -> None:
    mesh = box((2, 2, 3), (1.0, 1.0, 3.0), distortion=0.2)
    load = Traction("x1", lambda at: np.outer(at[:, 2], [1.0, 0.0, 0.0]))
    moments = np.cross(mesh.nodes, nodal_forces(mesh, [load])).sum(axis=0)
    assert moments == pytest.approx([0.0, 3.0**3 / 3, -(3.0**2) / 4])


def test_a_body_force_on_what_is_no_region_is_refused_in_one_sentence(box: Meshes) -> None:
    for region in ("lid", "", ["lid"]):
        with pytest.raises(SolverError, match=r"no region .*; known regions: none\."):
            nodal_forces(box(), [BodyForce((0.0, 0.0, 1.0), region)])  # type: ignore[arg-type]


@pytest.mark.parametrize("force", [1.0, (0.0, np.nan, 0.0), (1.0, 2.0), lambda at: 0 * at, "up"])
def test_a_force_on_an_edge_is_three_finite_numbers(force: object) -> None:
    with pytest.raises(SolverError, match=r"edge force: force \(N\) must be 3 finite numbers"):
        EdgeForce(("z1", "x1"), force)  # type: ignore[arg-type]


def test_a_body_force_weighs_the_body(box: Meshes) -> None:
    mesh = box((2, 3, 2), (2.0, 1.0, 3.0), distortion=0.2)
    forces = nodal_forces(mesh, [BodyForce((0.0, 0.0, -0.5))])
    assert forces.sum(axis=0) == pytest.approx([0, 0, -3.0])
    centre = np.cross(mesh.nodes, forces).sum(axis=0)
    assert centre == pytest.approx(np.cross([1.0, 0.5, 1.5], [0, 0, -3.0]))


def test_an_edge_force_has_its_resultant_at_the_middle_of_the_edge(box: Meshes) -> None:
    mesh, force = box((2, 3, 2), (3.0, 2.0, 1.0), distortion=0.2), (0.1, 0.2, -0.3)
    forces = nodal_forces(mesh, [EdgeForce(("x1", "z1"), force)])
    loaded = mesh.nodes[forces.any(axis=1)]
    assert np.allclose(loaded[:, [0, 2]], [3.0, 1.0]) and len(loaded) == 7
    assert forces.sum(axis=0) == pytest.approx(force)
    moment = np.cross(mesh.nodes, forces).sum(axis=0)
    assert moment == pytest.approx(np.cross([3.0, 1.0, 1.0], force))


def test_an_edge_force_does_work_on_the_mean_of_a_quadratic_displacement(box: Meshes) -> None:
    """Along 0 <= y <= 2 the mean of y^2 is 4 / 3."""
    mesh = box((1, 3, 1), (3.0, 2.0, 1.0))
    forces = nodal_forces(mesh, [EdgeForce(("x1", "z1"), (0, 0, 1))])
    assert forces[:, 2] @ mesh.nodes[:, 1] ** 2 == pytest.approx(4 / 3, rel=1e-12)


def test_an_edge_force_follows_a_curved_edge() -> None:
    """On a quarter of a circle the resultant acts at 2 R / pi in x and y."""
    mesh = tube_mesh(3.0, 4.0, 1.0, (1, 6, 1), np.pi / 2)
    forces = nodal_forces(mesh, [EdgeForce(("z1", "outside"), (0, 0, 1.0))])
    at = 4.0 * 2 / np.pi
    assert forces[:, 2] @ mesh.nodes == pytest.approx([at, at, 1.0], rel=1e-4)


@pytest.mark.parametrize("surfaces", [("x1",), ("x1", "y0", "z1"), "x1", (1, 2)])
def test_an_edge_is_given_by_two_names(surfaces: object) -> None:
    with pytest.raises(ValueError, match=r"^edge force: surfaces must be"):
        EdgeForce(surfaces, (0, 0, 1))  # type: ignore[arg-type]


@pytest.mark.parametrize("stretch", ["0.9", "1.5", "3"])
def test_a_dead_traction_stretches_a_block_as_the_closed_form_says(
    box: Meshes, ninjaflex: Ogden, stretch: str
) -> None:
    mesh = box((2, 2, 2), distortion=0.2)
    nominal = M1["reference"][stretch]["uniaxial"]
    problem = Problem(mesh, ninjaflex, THREE_PLANES, loads=(Traction("x1", (nominal, 0, 0)),))
    solution = solve(problem, options=TIGHT)
    assert solution.converged, solution.message
    stretches = np.array([float(stretch), float(stretch) ** -0.5, float(stretch) ** -0.5])
    assert solution.displacement == pytest.approx(mesh.nodes * (stretches - 1), abs=1e-7)


@pytest.mark.parametrize("stretch", ["0.7", "1.1", "6.6", "7.6"])
def test_a_prescribed_stretch_takes_the_force_of_the_closed_form(
    box: Meshes, ninjaflex: Ogden, stretch: str
) -> None:
    mesh = box((2, 1, 1), (2.0, 1.5, 1.0), distortion=0.2)
    supports = Supports(
        symmetry=THREE_PLANES.symmetry, prescribed={"x1": stretched(float(stretch))}
    )
    solution = solve(Problem(mesh, ninjaflex, supports), options=TIGHT)
    assert solution.converged, solution.message
    force = M1["reference"][stretch]["uniaxial"] * 1.5
    assert reaction(solution, "x1").force == pytest.approx([force, 0, 0], rel=1e-6, abs=1e-6)
    assert reaction(solution, "x0").force == pytest.approx([-force, 0, 0], rel=1e-6, abs=1e-6)


def test_point_forces_and_the_same_traction_meet_the_same_reaction(
    box: Meshes, ninjaflex: Ogden
) -> None:
    mesh = box((3, 1, 1), (3.0, 1.0, 1.0))
    corners = [(3.0, y, z) for y in (0.0, 1.0) for z in (0.0, 1.0)]
    forces = tuple(PointForce(corner, (0.0, 0.0, 0.005)) for corner in corners)
    traction = (Traction("x1", (0.0, 0.0, 0.02)),)
    for loads in (forces, traction):
        problem = Problem(mesh, ninjaflex, Supports(clamped=("x0",)), loads=loads)
        solution = solve(problem, options=TIGHT)
        held = reaction(solution, "x0")
        assert held.force == pytest.approx([0, 0, -0.02], abs=1e-9)
        tip = mesh.surface_nodes("x1")
        arm = (mesh.nodes + solution.displacement)[tip, 0].mean()
        assert held.moment[1] == pytest.approx(0.02 * arm, rel=0.01)


def test_supports_carry_the_pressure_on_a_wall(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = box((2, 2, 2), (1.0, 2.0, 3.0))
    solution = solve(Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ("x1",)), 0.1, TIGHT)
    assert solution.converged
    (x, y, z) = reaction(solution, "x0").force
    assert x == pytest.approx(0.1 * 2.0 * 3.0, rel=0.1)
    assert (y, z) == pytest.approx((0, 0), abs=0.05 * x)


def test_loads_pressure_and_motions_grow_together(box: Meshes, ninjaflex: Ogden) -> None:
    """Whatever share of the load is made up of which load, halfway is halfway."""
    mesh, halves = box((2, 1, 1)), []
    for share in (0.25, 0.5):
        pulling = Traction("x1", (share * 0.4, 0, 0))
        problem = Problem(mesh, ninjaflex, THREE_PLANES, ("y1",), (pulling,))
        halves.append(solve(problem, share * 0.1, TIGHT))
    whole = solve(
        Problem(mesh, ninjaflex, THREE_PLANES, ("y1",), (Traction("x1", (0.4, 0, 0)),)), 0.1,
        TIGHT, stops=(0.025, 0.05),
    )  # fmt: skip
    for half in halves:
        (point,) = (p for p in whole.path if p.load == pytest.approx(half.pressure / 0.1))
        assert point.max_von_mises == pytest.approx(half.path[-1].max_von_mises, rel=1e-3)


def test_a_body_turned_twice_as_a_whole_stays_free_of_stress(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = box((4, 2, 2), (4.0, 1.0, 1.0), distortion=0.2)
    skin = {name: turned(2.0) for name in mesh.surfaces if name != "y1"}
    solution = solve(Problem(mesh, ninjaflex, Supports(prescribed=skin)), options=TIGHT)
    assert solution.converged, solution.message
    assert abs(solution.displacement).max() < 1e-8
    assert solution.refused_steps + solution.load_steps > 4  # it did turn on the way
    assert nodal_von_mises(solution).max() < 1e-7


def test_a_surface_that_is_prescribed_all_around_is_refused_unless_it_can_be_compressed(
    box: Meshes,
) -> None:
    mesh = box((2, 2, 2))
    skin = Supports(clamped=tuple(mesh.surfaces))
    with pytest.raises(ValueError, match="leaves its pressure undetermined"):
        Problem(mesh, Ogden((1.0,), (2.0,)), skin)
    assert solve(Problem(mesh, Ogden((1.0,), (2.0,), bulk_modulus=50.0), skin)).converged


def test_a_quarter_turn_of_an_end_stresses_what_it_twists(box: Meshes, ninjaflex: Ogden) -> None:
    mesh = box((4, 1, 1), (4.0, 1.0, 1.0))
    problem = Problem(mesh, ninjaflex, Supports(clamped=("x0",), prescribed={"x1": turned(0.25)}))
    solution = solve(problem)
    assert solution.converged, solution.message
    ends = [reaction(solution, name) for name in ("x0", "x1")]
    assert ends[0].force == pytest.approx(-ends[1].force, abs=1e-4)
    assert ends[0].moment == pytest.approx(-ends[1].moment, abs=1e-3)


@pytest.mark.parametrize(
    ("motion", "said"),
    [
        (lambda at, load: at * 0 + 1.0, "zero at no load"),
        (lambda at, load: at[:, 0], "shape"),
        (lambda at, load: at * np.inf, "infinite"),
        (lambda at, load: at * (np.nan if load else 0.0), "same components free"),
    ],
)
def test_motions_that_make_no_sense_are_refused(
    box: Meshes, ninjaflex: Ogden, motion: Callable[[Array, float], Array], said: str
) -> None:
    with np.errstate(invalid="ignore"), pytest.raises(ValueError, match=said):
        Problem(box((1, 1, 1)), ninjaflex, Supports(clamped=("x0",), prescribed={"x1": motion}))


@pytest.mark.parametrize(
    ("load", "said"),
    [
        (Traction("nowhere", (1, 0, 0)), "no surface is called 'nowhere'"),
        (Traction("x1", (1, 0, float("nan"))), "finite"),
        (BodyForce(lambda at: at[:, :2]), "shape"),
        (PointForce((0.5, 0.3, 0.2), (1, 0, 0)), "no node lies at"),
        (EdgeForce(("x1", "nowhere"), (0, 0, 1)), "no surface is called 'nowhere'"),
        (EdgeForce(("x0", "x1"), (0, 0, 1)), "'x0' and 'x1' have no edge in common"),
        (EdgeForce(("x1", "x1"), (0, 0, 1)), "'x1' and 'x1' have no edge in common"),
    ],
)
def test_loads_that_make_no_sense_are_refused(
    box: Meshes, ninjaflex: Ogden, load: object, said: str
) -> None:
    with pytest.raises(ValueError, match=said):
        solve(Problem(box((1, 1, 1)), ninjaflex, Supports(clamped=("x0",)), loads=(load,)))


def test_a_cell_with_a_moving_plane_takes_no_dead_loads(cell: Mesh, ninjaflex: Ogden) -> None:
    middles = Supports(symmetry={"x0": 0, "y1": 1})
    with pytest.raises(ValueError, match="moving plane takes pressure only"):
        Problem(
            cell, ninjaflex, middles, ("cavity",), (BodyForce((0, 0, 1e-5)),), moving_plane="x1"
        )


@pytest.mark.parametrize(("load", "degrees"), [(1.0, 26.433519588), (4.0, 64.242282435)])
def test_a_slender_strip_is_solved_in_double_precision_and_bends_as_the_elastica(
    box: Meshes, load: float, degrees: float
) -> None:
    """Plane strain, E I = mu h^3 / 3 per depth; tip angles under P L^2 / E I from the elastica.

    Single precision has no right digit left at a hundred times as long as thick.
    """
    length = 100.0
    mesh = box((100, 1, 1), (length, 1.0, 1.0))
    named = Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, "tip": mesh.surfaces["x1"]})
    supports = Supports(clamped=("x0",), symmetry={"y0": 1, "y1": 1})
    down = Traction("tip", (0.0, 0.0, -load / 3 / length**2))
    axis = SlenderAxis(tuple(np.linspace(0, length, 21)))
    problem = Problem(named, Ogden((1.0,), (2.0,)), supports, loads=(down,), axis=axis)
    solution = solve(problem, stops=(0.5,))
    assert solution.converged, solution.message
    assert solution.linear_solver != "pardiso-single"
    assert solution.rotation == pytest.approx(degrees, rel=0.01)
    rotations = [point.rotation for point in solution.path]
    assert rotations == sorted(rotations)
    assert any(point.load == pytest.approx(0.5) for point in solution.path)
