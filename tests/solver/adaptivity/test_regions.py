"""The next mesh of a body of two materials, and what is carried over to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from two_materials import HARD, SOFT, layered

from solver import Mesh, Problem, Solution, SolverOptions, Supports, Traction, solve, transfer
from solver.adaptivity.refinement import Refinement, refined_sizes
from solver.errors import SolverError


@pytest.fixture(scope="module")
def sheared() -> Solution:
    load = Traction("z1", (0.3, 0.0, 0.3))
    problem = Problem(layered((2, 2, 2)), SOFT, Supports(("z0",)), loads=(load,))
    return solve(replace(problem, materials={"hard": HARD}), 0.0, SolverOptions())


def test_each_pressure_comes_from_its_own_region(sheared: Solution) -> None:
    """Fields that are linear in each region arrive as they are, with the jump between them."""
    mesh, finer = sheared.problem.mesh, layered((3, 4, 4))

    def pressure(of: Mesh) -> np.ndarray:
        at = of.nodes[of.vertices]
        return np.where(of.region_of_vertex == 1, 5.0 + at[:, 0], -1.0 - at[:, 2])

    given = replace(sheared, displacement=mesh.nodes**2, hydrostatic_pressure=pressure(mesh))
    displacement, found = transfer(given, finer)
    assert found == pytest.approx(pressure(finer), abs=1e-12)
    assert displacement == pytest.approx(finer.nodes**2, abs=1e-12)


def test_a_solution_starts_the_solve_on_a_finer_mesh(sheared: Solution) -> None:
    finer = layered((3, 3, 4))
    posed = replace(sheared.problem, mesh=finer)
    found = solve(posed, initial=transfer(sheared, finer))
    assert found.converged
    assert found.newton_iterations <= 5


def test_meshes_of_other_regions_are_refused(sheared: Solution) -> None:
    other = replace(layered(), regions={"stiff": layered().regions["hard"]})
    with pytest.raises(SolverError, match="must have the same regions; one has '', 'hard', the "):
        transfer(sheared, other)


def test_a_jump_between_regions_is_no_error_of_the_mesh() -> None:
    """Bars side by side, drawn uniformly: both are exact, and no element wants to be smaller."""

    def lead(at: np.ndarray, load: float) -> np.ndarray:
        return np.stack([np.full(len(at), 0.2 * load), *np.full((2, len(at)), np.nan)], axis=1)

    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}, prescribed={"x1": lead})
    mesh = layered((2, 1, 2))
    problem = Problem(mesh, SOFT, supports, materials={"hard": HARD})
    found = solve(problem, 0.0, SolverOptions(tolerance=1e-9))
    one_material = solve(replace(problem, materials={}), 0.0, SolverOptions(tolerance=1e-9))
    coarse = Refinement(growth=1e-3)
    sizes = refined_sizes(found, coarse)
    assert sizes == pytest.approx(refined_sizes(one_material, coarse), rel=0.03)


def test_each_region_has_its_own_peak_to_resolve(sheared: Solution) -> None:
    """The softer half, of a tenth of the stress, is refined near its own highest one."""
    wanted = Refinement(growth=1e-3, peak_tolerance=1e-3)
    sizes = refined_sizes(sheared, wanted)
    mesh = sheared.problem.mesh
    soft = np.setdiff1d(mesh.tets[mesh.region_of_tet == 0][:, :4], mesh.tets[mesh.regions["hard"]])
    assert sizes[soft].min() < 0.5 * sizes[mesh.vertices].max()
