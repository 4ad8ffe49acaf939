"""Stress is not read where an ideal body's has no end: at sharp re-entrant edges and clamps."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from meshes import FACES as SIDES
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, Supports, nodal_von_mises, peak_von_mises, solve
from solver.results.sharp_edges import trusted_nodes

Meshes = Callable[..., Mesh]
PLANES = Supports(symmetry={"x0": 0, "y0": 1, "y1": 1, "z0": 2})
RADIUS = 0.3


def notched(cells: Meshes, divisions: int = 4) -> Mesh:
    """A square of 2 mm without its upper right quarter, 0.5 mm thick; the notch is ``outside``.

    Its re-entrant edge is at x = z = 1, its convex ones at x = 2, z = 1 and x = 1, z = 2.
    """
    square = np.ones((2 * divisions, 1, 2 * divisions), int)
    square[divisions:, :, divisions:] = 0
    line = np.linspace(0, 2, 2 * divisions + 1)
    return cells(square, [line, np.array([0.0, 0.5]), line])


def problem(mesh: Mesh, radius: float, *loaded: str, supports: Supports = PLANES) -> Problem:
    return Problem(mesh, Ogden((1.0,), (2.0,)), supports, loaded, sharp_edge_radius=radius)


def from_line(mesh: Mesh, x: float, z: float) -> NDArray[np.float64]:
    """Distance of the nodes to a line along y."""
    return np.hypot(mesh.nodes[:, 0] - x, mesh.nodes[:, 2] - z)


def test_nodes_near_a_reentrant_edge_are_left_out_and_no_others(cells: Meshes) -> None:
    mesh = notched(cells)
    near = from_line(mesh, 1.0, 1.0) < RADIUS
    assert 0 < near.sum() < len(near) / 4
    assert np.array_equal(trusted_nodes(problem(mesh, RADIUS, "x1")), ~near)


@pytest.mark.parametrize("height", [0.5, 1.0, 1.5])
@pytest.mark.parametrize("above", [True, False])
def test_a_surface_within_the_body_makes_no_edge_and_hides_none(
    cells: Meshes, height: float, above: bool
) -> None:
    """Between two regions, with normals to either side, named before or after the outer ones."""
    mesh = notched(cells)
    middles = mesh.nodes[mesh.tets[:, :4], 2].mean(axis=1)
    faces = np.concatenate([mesh.tets[(middles > height) == above][:, face] for face in SIDES])
    inner = {"between": faces[(mesh.nodes[faces[:, :3], 2] == height).all(axis=1)]}
    inner["between"] = inner["between"][mesh.nodes[inner["between"][:, :3], 0].max(axis=1) <= 1.0]
    wanted = trusted_nodes(problem(mesh, RADIUS))
    for surfaces in ({**inner, **mesh.surfaces}, {**mesh.surfaces, **inner}):
        found = trusted_nodes(problem(Mesh(mesh.nodes, mesh.tets, surfaces), RADIUS))
        assert np.array_equal(found, wanted)


@pytest.mark.parametrize("place", [(2.0, 1.0), (1.0, 2.0), (0.0, 2.0), (2.0, 0.0)])
def test_convex_edges_are_trusted(cells: Meshes, place: tuple[float, float]) -> None:
    mesh = notched(cells)
    trusted = trusted_nodes(problem(mesh, RADIUS))
    assert trusted[from_line(mesh, *place) < RADIUS].all()


@pytest.mark.parametrize(("degrees", "sharp"), [(0.0, False), (30.0, False), (50.0, True)])
def test_a_gentle_bend_is_no_edge(cells: Meshes, degrees: float, sharp: bool) -> None:
    """A bar whose top rises from its middle on."""
    lines = [np.linspace(0, 2, 5), np.array([0.0, 0.5]), np.arange(3.0)]
    bar = cells(np.ones((4, 1, 2), int), lines)
    x, y, z = bar.nodes.T
    rise = np.tan(np.radians(degrees)) * np.maximum(x - 1, 0)
    bent = Mesh(np.stack([x, y, z + rise], axis=1), bar.tets, bar.surfaces)
    trusted = trusted_nodes(problem(bent, RADIUS))
    assert np.array_equal(trusted, from_line(bent, 1.0, 2.0) > (RADIUS if sharp else -1))


def test_a_pressurised_edge_is_never_left_out(cells: Meshes) -> None:
    assert trusted_nodes(problem(notched(cells), RADIUS, "outside")).all()


def test_a_radius_of_zero_trusts_everything(cells: Meshes) -> None:
    clamped = Supports(clamped=("x0",))
    assert trusted_nodes(problem(notched(cells), 0.0, "x1")).all()
    assert trusted_nodes(problem(notched(cells), 0.0, supports=clamped)).all()


def test_the_rim_of_a_clamp_is_left_out_and_its_inside_is_not(cells: Meshes) -> None:
    mesh = cells(np.ones((4, 4, 4), int), [np.linspace(0, 2, 5)] * 3)
    trusted = trusted_nodes(problem(mesh, RADIUS, supports=Supports(clamped=("x0",))))
    x, y, z = mesh.nodes.T
    inward = np.minimum(np.minimum(y, 2 - y), np.minimum(z, 2 - z))
    assert np.array_equal(trusted, np.hypot(x, inward) > RADIUS)


def test_an_edge_where_the_body_is_cut_is_not_one_of_the_body(cells: Meshes) -> None:
    """The notch's faces as planes of symmetry: the whole body has no edge there."""
    mesh = notched(cells)
    faces = mesh.surfaces["outside"]
    upright = mesh.nodes[faces[:, :3], 0].max(axis=1) == 1.0
    surfaces = {**mesh.surfaces, "outside": faces[~upright], "cut": faces[upright]}
    split = Mesh(mesh.nodes, mesh.tets, surfaces)
    assert not trusted_nodes(problem(split, RADIUS)).all()
    cut = Supports(symmetry={**PLANES.symmetry, "cut": 0})
    assert trusted_nodes(problem(split, RADIUS, supports=cut)).all()


@pytest.mark.thorough
def test_the_peak_at_a_notch_rises_without_end_but_settles_at_a_distance(cells: Meshes) -> None:
    sharp, rounded = [], []
    for divisions in (2, 4, 8):
        mesh = notched(cells, divisions)
        solution = solve(problem(mesh, 0.0, "x1"), -1e-3)
        apart = solve(problem(mesh, RADIUS, "x1"), -1e-3)
        assert solution.converged and apart.converged
        peak = peak_von_mises(apart)
        sharp.append(peak_von_mises(solution).value)
        rounded.append(peak.value)
        assert np.hypot(peak.position[0] - 1, peak.position[2] - 1) > RADIUS
        assert apart.path[-1].max_von_mises == peak.value < nodal_von_mises(apart).max()
    assert sharp[1] > 1.15 * sharp[0] and sharp[2] > 1.15 * sharp[1]
    assert rounded[2] == pytest.approx(rounded[1], rel=0.05)
