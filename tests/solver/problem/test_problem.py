"""Meshes, supports and problems: what is refused, and how it is said."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, SlenderAxis, SolverOptions, Supports, solve
from solver.linear.solvers import linear_solver

BoxMesh = Callable[..., Mesh]


def test_a_mesh_cannot_be_changed(box: BoxMesh) -> None:
    mesh = box((1, 1, 1))
    with pytest.raises(ValueError, match="read-only"):
        mesh.nodes[0] = 0.0
    with pytest.raises(TypeError):
        mesh.surfaces["x0"] = mesh.surfaces["x1"]


def test_the_caller_keeps_arrays_that_can_be_changed(box: BoxMesh) -> None:
    nodes = np.array(box((1, 1, 1)).nodes)
    Mesh(nodes, box((1, 1, 1)).tets)
    nodes[0] = 1.0


def test_surface_nodes_are_those_on_the_surface(box: BoxMesh) -> None:
    mesh = box((2, 2, 2))
    on_plane = np.flatnonzero((mesh.nodes[:, 0] == 0) | (mesh.nodes[:, 1] == 1))
    assert np.array_equal(mesh.surface_nodes("x0", "y1"), on_plane)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(nodes=np.zeros((5, 2))), r"nodes must have the shape \(n, 3\), got \(5, 2\)"),
        (dict(nodes=np.full((10, 3), np.nan)), "nodes must be finite"),
        (dict(tets=np.arange(4)[None]), r"tets must have the shape \(n, 10\)"),
        (dict(tets=np.arange(1, 11)[None]), "tets names node 10, .* numbered 0 to 9"),
        (dict(surfaces={"tip": np.full((1, 6), -1)}), "surface 'tip'.* names node -1|tip names"),
    ],
)
def test_impossible_meshes_are_refused_in_one_sentence(change: dict, words: str) -> None:
    good = dict(nodes=np.zeros((10, 3)), tets=np.arange(10)[None], surfaces={})
    with pytest.raises(ValueError, match=words):
        Mesh(**{**good, **change})


def test_an_unknown_surface_is_named_with_the_known_ones(box: BoxMesh, ninjaflex: Ogden) -> None:
    mesh = box((1, 1, 1))
    with pytest.raises(ValueError, match="'cavity'; known surfaces: x0, x1, y0, y1, z0, z1"):
        Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ("cavity",))
    with pytest.raises(ValueError, match="no surface is called 'root'"):
        Problem(mesh, ninjaflex, Supports(clamped=("root",)), ())


@pytest.mark.parametrize(
    ("supports", "motion"),
    [
        (Supports(), "free to move"),
        (Supports(symmetry={"x0": 0, "y0": 1}), "translation along z"),
        (Supports(symmetry={"y0": 1}), "free to move"),
    ],
)
def test_supports_that_leave_the_body_free_are_refused(
    box: BoxMesh, ninjaflex: Ogden, supports: Supports, motion: str
) -> None:
    with pytest.raises(ValueError, match=motion):
        Problem(box((1, 1, 1)), ninjaflex, supports, ())


def test_a_symmetry_axis_is_0_1_or_2() -> None:
    with pytest.raises(ValueError, match="must be 0, 1 or 2, got 3"):
        Supports(symmetry={"y0": 3})


@pytest.mark.parametrize("stations", [(), (1.0,), (0.0, 2.0, 1.0), (0.0, float("nan"))])
def test_stations_ascend(stations: tuple[float, ...]) -> None:
    with pytest.raises(ValueError, match="at least two positions in mm in ascending order"):
        SlenderAxis(stations)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (dict(first_step=0.0), "first_step must be above 0 and at most 1, got 0.0"),
        (dict(growth=1.0), "growth must be above 1"),
        (dict(tolerance=float("nan")), "tolerance must be"),
        (dict(maximum_iterations=0), "maximum_iterations"),
    ],
)
def test_impossible_options_are_refused(options: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        SolverOptions(**options)


def test_pressure_must_be_a_number(box: BoxMesh, ninjaflex: Ogden) -> None:
    problem = Problem(box((1, 1, 1)), ninjaflex, Supports(clamped=("x0",)), ("x1",))
    with pytest.raises(ValueError, match="pressure must be a finite number of MPa, got nan"):
        solve(problem, float("nan"))
    with pytest.raises(ValueError, match=r"initial: displacement must have the shape \(27, 3\)"):
        solve(problem, 0.1, initial=(np.zeros((3, 3)), np.zeros(8)))


def test_linear_solvers_have_names() -> None:
    with pytest.raises(ValueError, match=r"must be one of auto, .*superlu, got 'umfpack'"):
        linear_solver("umfpack")


@pytest.mark.parametrize(
    ("supports", "count", "named"),
    [
        (Supports(), 6, "translation along x, translation along y, translation along z, rotation"),
        (Supports(symmetry={"x0": 0}), 3, "translation along y, translation along z, rotation ab"),
        (Supports(symmetry={"x0": 0, "y0": 1}), 1, "translation along z"),
        (Supports(symmetry={"x0": 0, "x1": 0, "z0": 2}), 1, "translation along y"),
    ],
)
def test_rigid_motions_that_supports_leave_free_are_counted_and_named(
    box: Callable[..., Mesh], ninjaflex: Ogden, supports: Supports, count: int, named: str
) -> None:
    with pytest.raises(ValueError, match=rf"in {count} ways? \({named}"):
        Problem(box((1, 1, 1)), ninjaflex, supports, ())
