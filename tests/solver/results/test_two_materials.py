"""Bodies of two materials: closed forms, and what is read of each region."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest
from meshes import box_mesh
from numpy.typing import NDArray
from two_materials import HARD, SOFT, layered

from solver import (
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    nodal_cauchy,
    nodal_von_mises,
    peak_von_mises,
    peaks_by_region,
    reaction,
    solve,
    strain_energy,
    write_vtu,
)
from solver.results.strains import reached_logs, reached_logs_by_region
from solver.results.stress import nodal_pressure

TIGHT = SolverOptions(tolerance=1e-9)
STRETCH = 1.3
Points = NDArray[np.float64]


def lead(by: float) -> Callable[[Points, float], Points]:
    """A motion along x, free across."""
    return lambda at, load: np.stack(
        [np.full(len(at), by * load), *np.full((2, len(at)), np.nan)], 1
    )


def pulled(mesh: Mesh, soft: Ogden, hard: Ogden) -> Solution:
    """A bar drawn to ``STRETCH`` along x, free to contract."""
    length = float(mesh.nodes[:, 0].max())
    supports = Supports(
        symmetry={"x0": 0, "y0": 1, "z0": 2}, prescribed={"x1": lead((STRETCH - 1) * length)}
    )
    found = solve(Problem(mesh, soft, supports, materials={"hard": hard}), 0.0, TIGHT)
    assert found.converged, found.message
    return found


@pytest.fixture(scope="module")
def parallel() -> Solution:
    """Two bars side by side, one ten times as stiff."""
    return pulled(layered((2, 1, 2), (2.0, 1.0, 1.0), distortion=0.1), SOFT, HARD)


def neo_hooke_force(modulus: float, area: float) -> float:
    """Of an incompressible neo-Hookean bar at ``STRETCH``, N."""
    return modulus * area * (STRETCH - STRETCH**-2)


def test_bars_side_by_side_share_the_force_by_their_stiffness(parallel: Solution) -> None:
    forces = [neo_hooke_force(modulus, 0.5) for modulus in (1.0, 10.0)]
    assert reaction(parallel, "x1").force[0] == pytest.approx(sum(forces), rel=1e-8)
    energy = (1.0 + 10.0) / 2 * (STRETCH**2 + 2 / STRETCH - 3)
    assert strain_energy(parallel) == pytest.approx(energy, rel=1e-8)


def test_the_pressure_jumps_at_the_interface(parallel: Solution) -> None:
    """Free sides: q is minus a third of the axial stress, mu (L^2 - 1/L), in each bar."""
    mesh = parallel.problem.mesh
    pressure = -(STRETCH**2 - 1 / STRETCH) / 3
    expected = np.where(mesh.region_of_vertex == 1, 10.0 * pressure, pressure)
    assert parallel.hydrostatic_pressure == pytest.approx(expected, abs=1e-7)


def test_each_region_has_its_own_peak(parallel: Solution) -> None:
    """Averaged over both, the interface would show 5.5 times the softer one's stress."""
    stress = STRETCH**2 - 1 / STRETCH
    peaks = peaks_by_region(parallel)
    assert {name: peak.value for name, peak in peaks.items()} == pytest.approx(
        {"": stress, "hard": 10.0 * stress}, rel=1e-7
    )
    assert {name: peak.region for name, peak in peaks.items()} == {"": "", "hard": "hard"}
    assert max(peak.scatter for peak in peaks.values()) < 1e-6
    highest = peak_von_mises(parallel)
    assert highest.region == "hard"
    assert highest.value == peaks["hard"].value
    assert parallel.path[-1].max_von_mises == highest.value


def test_a_region_that_lies_all_near_sharp_edges_has_a_peak_all_the_same(
    parallel: Solution,
) -> None:
    """A film within the radius around a clamp's rim: none of its nodes is farther away."""
    held = replace(parallel.problem, supports=Supports(("x1",)), sharp_edge_radius=10.0)
    peaks = peaks_by_region(replace(parallel, problem=held))
    assert peaks == peaks_by_region(parallel)


def test_a_node_of_the_interface_shows_the_higher_stress(parallel: Solution) -> None:
    mesh = parallel.problem.mesh
    stress = STRETCH**2 - 1 / STRETCH
    modulus = np.where(mesh.nodes[:, 2] > 0.5 - 1e-9, 10.0, 1.0)
    assert nodal_von_mises(parallel) == pytest.approx(modulus * stress, rel=1e-6)
    cauchy = nodal_cauchy(parallel)
    assert cauchy[:, 0] == pytest.approx(modulus * stress, rel=1e-6)
    assert cauchy[:, 1:] == pytest.approx(np.zeros((len(modulus), 5)), abs=1e-6)
    pressure = nodal_pressure(parallel.problem, parallel.state)
    assert pressure == pytest.approx(-modulus * stress / 3, rel=1e-6)


def test_bars_in_a_row_bear_one_stress() -> None:
    """Held across, so that each has one stretch: the nominal stresses of both are one."""
    soft, hard = replace(SOFT, bulk_modulus=2.0), replace(HARD, bulk_modulus=20.0)
    mesh = layered((4, 1, 1), (2.0, 1.0, 1.0), axis=0, position=1.0)
    supports = Supports(
        symmetry={"x0": 0, "y0": 1, "y1": 1, "z0": 2, "z1": 2}, prescribed={"x1": lead(0.4)}
    )
    found = solve(Problem(mesh, soft, supports, materials={"hard": hard}), 0.0, TIGHT)
    middle = np.flatnonzero(np.isclose(mesh.nodes[:, 0], 1.0))
    stretch = 1.0 + found.displacement[middle, 0]
    assert np.ptp(stretch) < 1e-9
    one, other = stretch[0], 2.4 - stretch[0]
    assert 1.0 < other < one
    assert nominal(one, soft) == pytest.approx(nominal(other, hard), rel=1e-7)
    assert reaction(found, "x1").force[0] == pytest.approx(nominal(one, soft), rel=1e-7)


def nominal(stretch: float, material: Ogden) -> float:
    """Of uniaxial strain, MPa: J = L; the deviator of mu L^(4/3) and twice L^(-2/3), over L."""
    deviator = 2 / 3 * (stretch ** (4 / 3) - stretch ** (-2 / 3))
    return material.mu[0] * deviator / stretch + material.bulk_modulus * (stretch - 1)


def test_naming_the_whole_body_as_a_region_changes_no_bit() -> None:
    mesh = replace(layered((2, 1, 1), (2.0, 1.0, 1.0), axis=0, position=1.0), regions={})
    named = mesh.with_regions({"hard": np.arange(len(mesh.tets))})
    plain = Problem(mesh, HARD, Supports(("x0",)), ("x1",))
    one, other = (
        solve(problem, -0.5)
        for problem in (plain, replace(plain, mesh=named, material=SOFT, materials={"hard": HARD}))
    )
    assert one.displacement.tobytes() == other.displacement.tobytes()
    assert one.hydrostatic_pressure.tobytes() == other.hydrostatic_pressure.tobytes()
    assert peak_von_mises(one).value == peak_von_mises(other).value


def test_regions_of_one_material_change_a_bent_bar_by_the_error_of_its_mesh_only() -> None:
    """Pressures that may jump are a richer space, not another material."""
    mesh = layered((4, 1, 2), (4.0, 1.0, 1.0))
    supports, load = Supports(("x0",)), (Traction("x1", (0.0, 0.0, 0.01)),)
    split, whole, finer = (
        solve(Problem(each, SOFT, supports, loads=load)).displacement[:, 2].max()
        for each in (mesh, replace(mesh, regions={}), box_mesh((8, 2, 4), (4.0, 1.0, 1.0)))
    )
    assert split != whole
    assert abs(split - whole) < abs(finer - whole)


def test_strains_are_those_of_each_regions_points(parallel: Solution) -> None:
    by_region = reached_logs_by_region(parallel)
    mesh = parallel.problem.mesh
    assert {name: len(rows) for name, rows in by_region.items()} == {
        "": 4 * int((mesh.region_of_tet == 0).sum()),
        "hard": 4 * len(mesh.regions["hard"]),
    }
    assert len(reached_logs(parallel)) == 4 * len(mesh.tets)


def test_a_file_says_which_cell_is_in_which_region(parallel: Solution, tmp_path: Path) -> None:
    write_vtu(tmp_path / "bar.vtu", parallel)
    read = meshio.read(tmp_path / "bar.vtu")
    assert np.array_equal(read.cell_data["region"][0], parallel.problem.mesh.region_of_tet)
