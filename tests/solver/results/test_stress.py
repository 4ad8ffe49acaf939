"""Stress recovery and result files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import meshio
import numpy as np
import pytest

from solver import (
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    nodal_cauchy,
    nodal_von_mises,
    peak_von_mises,
    solve,
    write_vtu,
)
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.results.stress import von_mises


def pulled(box: Callable[..., Mesh], material: Ogden) -> Solution:
    mesh = box((2, 2, 2), distortion=0.25)
    problem = Problem(mesh, material, Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), ("x1",))
    return solve(problem, -1.0, SolverOptions(tolerance=1e-9, maximum_iterations=40))


def test_stress_of_a_homogeneous_state_is_recovered_exactly(
    box: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    solution = pulled(box, ninjaflex)
    expected = np.tile([1.0, 0, 0, 0, 0, 0], (len(solution.displacement), 1))
    assert nodal_cauchy(solution) == pytest.approx(expected, abs=1e-6)
    assert nodal_von_mises(solution) == pytest.approx(1.0, abs=1e-6)
    assert solution.path[-1].max_von_mises == peak_von_mises(solution).value


def test_von_mises_of_pure_shear_is_root_three_times_the_shear() -> None:
    assert von_mises(np.array([0, 0, 0, 2.0, 0, 0])) == pytest.approx(2 * np.sqrt(3))
    assert von_mises(np.array([5.0, 5.0, 5.0, 0, 0, 0])) == 0.0


def test_stress_linear_in_space_is_recovered_exactly(
    box: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    mesh = box((2, 2, 2), distortion=0.25)
    problem = Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ())
    size = 1e-7  # small enough for sigma = 2 mu dev(strain)
    x, y, z = mesh.nodes.T
    displacement = size * np.stack([x**2, 0 * y, 0 * z], axis=1)
    from solver.results.stress import deviatoric_at_sides

    stress = deviatoric_at_sides(problem, displacement) / (2 * 3.47605 * size)
    assert stress[:, 0] == pytest.approx(2 * x * 2 / 3, abs=1e-5)
    assert stress[:, 1] == pytest.approx(-2 * x / 3, abs=1e-5)
    assert stress[:, 3:] == pytest.approx(0.0, abs=1e-5)


def test_the_peak_is_where_it_is_said_to_be(box: Callable[..., Mesh], ninjaflex: Ogden) -> None:
    mesh = box((8, 1, 2), (8.0, 1.0, 1.0))
    supports = Supports(clamped=("x0",), symmetry={"y0": 1})
    solution = solve(Problem(mesh, ninjaflex, supports, ("z1",)), 0.0005)
    peak = peak_von_mises(solution)
    assert peak.position == tuple(mesh.nodes[peak.node])
    assert peak.value == nodal_von_mises(solution).max()
    assert peak.position[0] <= 1.0 and peak.position[2] in (0.0, 1.0)  # root, outer fibre


def test_vtu_comes_back_as_it_was_written(
    box: Callable[..., Mesh], ninjaflex: Ogden, tmp_path: Path
) -> None:
    solution = pulled(box, ninjaflex)
    write_vtu(tmp_path / "pulled.vtu", solution)
    read = meshio.read(tmp_path / "pulled.vtu")
    mesh = solution.problem.mesh
    assert np.array_equal(read.points, mesh.nodes)
    assert np.array_equal(read.point_data["displacement_mm"], solution.displacement)
    assert np.array_equal(read.point_data["von_mises_mpa"], nodal_von_mises(solution))
    pressure = read.point_data["hydrostatic_pressure_mpa"]
    assert np.array_equal(pressure[mesh.vertices], solution.hydrostatic_pressure)
    (cells,) = read.cells
    assert cells.type == "tetra10"
    # VTK's mid-edge nodes: (0,1) (1,2) (2,0) (0,3) (1,3) (2,3)
    for place, (a, b) in enumerate([(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)], start=4):
        middle = (read.points[cells.data[:, a]] + read.points[cells.data[:, b]]) / 2
        assert read.points[cells.data[:, place]] == pytest.approx(middle)
    assert TETRAHEDRON_EDGES[4:] == ((2, 3), (1, 3))
