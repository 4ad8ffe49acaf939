"""Energy of equilibria and work on the way there: closed forms, stationarity, balance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from meshes import renamed
from numpy.typing import NDArray

from solver import (
    AxialForce,
    BodyForce,
    Couple,
    FoundationSpring,
    Mesh,
    NodeSpring,
    Ogden,
    Problem,
    RigidPlane,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    Work,
    potential,
    solve,
    strain_energy,
    work,
)
from solver.problem.supports import fixed_displacements

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
RUBBER = Ogden.neo_hooke(1.0)
THIRDS = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
EXACT = SolverOptions(tolerance=1e-10, loose_tolerance=1e-10, maximum_iterations=20)


def at_fractions(problem: Problem, pressure: float, steps: int) -> tuple[Solution, ...]:
    """Equilibria at equal steps of the load up to the whole one."""
    stops = np.arange(1, steps) / steps * (pressure or 1.0)
    last = solve(problem, pressure, EXACT, stops=stops)
    assert last.converged
    return (*last.at_stops, last)


@pytest.mark.parametrize("bulk_modulus", [np.inf, 5.0])
@pytest.mark.parametrize("volumetric", ["quadratic", "logarithmic"])
def test_the_energy_of_a_stretched_block_is_the_material_s(
    box: Meshes, bulk_modulus: float, volumetric: str
) -> None:
    material = Ogden((0.3, 0.5), (2.5, -1.5), bulk_modulus, volumetric=volumetric)
    block = box((2, 1, 1), (2.0, 1.5, 1.0), distortion=0.1)
    load = Traction("x1", (0.8, 0.0, 0.0))
    solution = solve(Problem(block, material, THIRDS, loads=(load,)), options=EXACT)
    logs = np.log(1 + solution.displacement.max(axis=0) / [2.0, 1.5, 1.0])
    sides = np.log(1 + solution.displacement.min(axis=0) / [2.0, 1.5, 1.0])
    logs = np.where(abs(sides) > abs(logs), sides, logs)
    change, density = np.exp(logs.sum()) - 1, material.energy(logs - logs.mean())
    if np.isfinite(bulk_modulus) and volumetric == "quadratic":
        density += bulk_modulus * change**2 / 2
    elif np.isfinite(bulk_modulus):
        density += bulk_modulus / 4 * ((1 + change) ** 2 - 1 - 2 * np.log1p(change))
    assert abs(change) < 1e-9 if np.isinf(bulk_modulus) else change > 0.01
    assert strain_energy(solution) == pytest.approx(3.0 * density, rel=1e-9)
    assert potential(solution).loads == pytest.approx(-0.8 * 1.5 * 2 * np.expm1(logs[0]), rel=1e-9)


def loaded(box: Meshes, **plane: object) -> Problem:
    """Dead loads, springs, and a plane that runs into the body."""
    lid = RigidPlane("x1", 0.05, (-1, 0, 0.2), (1.1, 0, 0.1), lambda load: (-0.35 * load, 0, 0))
    return Problem(
        box((2, 2, 2), (1.0, 1.0, 1.0), distortion=0.2),
        Ogden.neo_hooke(1.0, 8.0),
        Supports(symmetry={"x0": 0, "y0": 1, "y1": 1, "z0": 2}),
        loads=(BodyForce((0, 0, 0.1)), Traction("z1", (0.1, 0, 0.05))),
        contacts=(replace(lid, **plane),),
        springs=(FoundationSpring("z1", (0.1, 0, 0.2)), NodeSpring((1, 1, 1), (0.05, 0, 0))),
    )


def test_the_total_is_stationary_in_equilibrium(box: Meshes) -> None:
    """Its change under a small motion falls with the square of the motion."""
    solution = solve(loaded(box), options=EXACT)
    parts = potential(solution)
    assert min(parts.strain, parts.springs, parts.contacts, -parts.loads) > 1e-4
    assert parts.total == parts.strain + parts.springs + parts.contacts + parts.loads
    assert_stationary(solution)


def test_a_follower_pressure_in_a_held_rim_has_a_potential(box: Meshes) -> None:
    mesh = renamed(box((3, 3, 1), (3.0, 3.0, 0.5)), {"x1": "rim", "y1": "rim"})
    supports = Supports(("rim",), {"x0": 0, "y0": 1})
    problem = Problem(mesh, RUBBER, supports, ("z0",))
    solution = solve(problem, 0.2, EXACT)
    assert solution.displacement[:, 2].max() > 0.3
    assert potential(solution).loads < -0.1
    assert_stationary(solution)
    turned = Mesh(mesh.nodes[:, [1, 2, 0]] + 5.0, mesh.tets, mesh.surfaces)
    supports = Supports(("rim",), {"x0": 2, "y0": 0})
    same = solve(replace(problem, mesh=turned, supports=supports), 0.2, EXACT)
    assert potential(same).loads == pytest.approx(potential(solution).loads, rel=1e-8)


def assert_stationary(solution: Solution) -> None:
    """Against random motions that supports allow, beside the change to second order."""
    problem, random = solution.problem, np.random.default_rng(1)
    fixed = fixed_displacements(problem.mesh, problem.supports)
    for _ in range(3):
        motion = np.where(fixed, 0.0, random.normal(size=fixed.shape))
        total = [
            potential(replace(solution, displacement=solution.displacement + s * motion)).total
            for s in (-1e-5, 0.0, 1e-5)
        ]
        slope, curvature = total[2] - total[0], total[2] - 2 * total[1] + total[0]
        assert abs(slope) < 1e-3 * abs(curvature)


def assert_second_order(problem: Problem, pressure: float, coarse: int = 4) -> Work:
    """The work tends to the stored energy with the square of the steps."""
    errors = []
    for steps in (coarse, 2 * coarse):
        path = at_fractions(problem, pressure, steps)
        done, stored = work(path), potential(replace(path[-1], pressure=0.0)).stored
        errors.append(done.total / stored - 1)
    assert abs(errors[1]) < 0.02
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)
    return done


def test_the_work_of_planes_and_dead_loads_is_what_is_stored(box: Meshes) -> None:
    """On a path on which the plane touches from the start, so that nothing on it has a kink."""
    done = assert_second_order(loaded(box, point=(1.0, 0, 0), penetration=1.0), 0.0)
    assert done.planes > 0.01 and done.loads > 0.003
    assert done.pressure == 0 and abs(done.supports) < 1e-9


def test_the_work_of_led_supports_is_what_is_stored(box: Meshes) -> None:
    led = Supports(
        ("x0",), prescribed={"x1": lambda at, load: load * np.array([0.8, 0, 0]) + 0 * at}
    )
    done = assert_second_order(Problem(box((2, 1, 1)), RUBBER, led), 0.0)
    assert done.total == done.supports > 0.1


def test_the_work_of_a_pressure_is_what_is_stored(box: Meshes) -> None:
    mesh = renamed(box((3, 3, 1), (3.0, 3.0, 0.5)), {"x1": "rim", "y1": "rim"})
    problem = Problem(mesh, RUBBER, Supports(("rim",), {"x0": 0, "y0": 1}), ("z0",))
    done = assert_second_order(problem, 0.2)
    assert done.total == pytest.approx(done.pressure) and done.pressure > 0.05


def test_the_work_of_a_pressure_without_potential_is_what_is_stored_too(box: Meshes) -> None:
    """A bar pulled by a follower pressure on its end, whose rim is free."""
    problem = Problem(box((3, 1, 1), (3.0, 1.0, 1.0)), RUBBER, THIRDS, ("x1",))
    done = assert_second_order(problem, -0.3)
    assert done.total == pytest.approx(done.pressure) and done.pressure > 0.04
    with pytest.raises(ValueError, match=r"a free rim, at .*, so that the work"):
        potential(solve(problem, -0.1))


def test_the_work_on_a_cell_is_what_is_stored(cell: Mesh, ninjaflex: Ogden) -> None:
    """Pressure, with that on the opening, and a couple on the plane that turns."""
    middles = Supports(symmetry={"x0": 0, "y0": 1})
    problem = Problem(
        cell, ninjaflex, middles, ("cavity",), loads=(Couple(-2.0),), moving_plane="x1"
    )
    done = assert_second_order(problem, 0.04)
    assert done.supports == 0
    assert done.pressure > 0.01 and abs(done.loads) > 1e-3


def test_the_work_at_constant_pressure_needs_no_small_steps(box: Meshes) -> None:
    """Stretched under a pressure that stays: the volume swept is integrated exactly."""
    mesh = renamed(box((2, 2, 1), (3.0, 3.0, 0.5)), {"x1": "rim", "y1": "rim"})
    problem = Problem(mesh, RUBBER, Supports(("rim",), {"x0": 0, "y0": 1}), ("z0",))
    first = solve(problem, 0.1, EXACT)
    second = replace(first, displacement=2 * first.displacement)
    step = work((first, second)).pressure - work((first,)).pressure
    change = potential(second).loads - potential(first).loads
    assert step == pytest.approx(-change, rel=1e-12)


def test_the_work_of_stages_is_what_is_stored(box: Meshes) -> None:
    """Led and pressed, then under a pressure while the support lets go and the plane moves on."""
    mesh, errors = box((2, 1, 1), (2.0, 1.0, 1.0)), []
    ends = Supports(
        ("x0",), prescribed={"x1": lambda at, load: load * np.array([0.6, 0, 0]) + 0 * at}
    )
    plane = RigidPlane("z1", 0.3, (0, 0, -1), (0, 0, 1), lambda load: (0, 0, -0.1 * load))
    onward = replace(plane, point=(0, 0, 0.9))
    for steps in (4, 8):
        stops = np.arange(1, steps) / steps
        first = solve(Problem(mesh, RUBBER, ends, contacts=(plane,)), options=EXACT, stops=stops)
        second = solve(
            Problem(mesh, RUBBER, Supports(("x0",)), ("z0",), contacts=(onward,)),
            0.1, EXACT, stops=0.1 * stops, after=first,
        )  # fmt: skip
        assert first.converged and second.converged
        done = work((*first.at_stops, first, *second.at_stops, second))
        stored = potential(replace(second, pressure=0.0)).stored
        errors.append(done.total / stored - 1)
    assert min(abs(part) for part in (done.pressure, done.loads, done.supports, done.planes)) > 1e-3
    assert abs(errors[1]) < 0.03
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.2)


@pytest.mark.parametrize("loads", [(Couple(0.15),), (AxialForce(0.3), Couple(0.15))])
def test_taking_loads_off_a_moving_plane_gives_back_what_they_stored(
    box: Meshes, loads: tuple[Couple | AxialForce, ...]
) -> None:
    mesh, errors = box((2, 1, 1), (2.0, 1.0, 1.0)), []
    bent = Problem(mesh, RUBBER, THIRDS, loads=loads, moving_plane="x1")
    for steps in (4, 8):
        stops = np.arange(1, steps) / steps
        first = solve(bent, options=EXACT, stops=stops)
        second = solve(replace(bent, loads=()), options=EXACT, stops=stops, after=first)
        path = (*first.at_stops, first, *second.at_stops, second)
        stored = potential(first).stored
        assert stored > 0.01 and potential(second).stored < 1e-9
        errors.append(abs(work(path).total) / stored)
        halfway = len(first.at_stops) + 1 + steps // 2
        errors.append(abs(work(path[:halfway]).total / potential(path[halfway - 1]).stored - 1))
    assert max(errors[:2]) < 0.02
    for coarse, fine in zip(errors[:2], errors[2:], strict=True):
        assert fine < max(coarse / 3, 1e-12)  # of second order


def test_between_stages_the_total_is_stationary_at_a_moving_plane(box: Meshes) -> None:
    """To a neighbouring state under the same loads it changes to second order."""
    mesh = box((2, 1, 1), (2.0, 1.0, 1.0))
    bent = Problem(mesh, RUBBER, THIRDS, loads=(AxialForce(0.3), Couple(0.15)), moving_plane="x1")
    first = solve(bent, options=EXACT)
    last = solve(replace(bent, loads=()), options=EXACT, stops=(0.5, 0.51), after=first)
    here, beside = last.at_stops
    there = replace(
        here,
        displacement=beside.displacement,
        hydrostatic_pressure=beside.hydrostatic_pressure,
        plane=beside.plane,
    )
    stored = potential(there).stored - potential(here).stored
    assert abs(stored) > 1e-4
    assert abs(potential(there).total - potential(here).total) < 0.03 * abs(stored)


def test_work_needs_a_path_on_one_mesh(box: Meshes) -> None:
    one, other = (
        solve(Problem(box(divisions), RUBBER, THIRDS, ("x1",)), 0.01)
        for divisions in ((1, 1, 1), (2, 1, 1))
    )
    with pytest.raises(ValueError, match="at least one solution"):
        work(())
    with pytest.raises(ValueError, match="one mesh"):
        work((one, other))
    lid = RigidPlane("z1", 0.1, (0, 0, -1), (0, 0, 2))
    having = replace(one, problem=replace(one.problem, contacts=(lid,)))
    with pytest.raises(ValueError, match="number of contacts"):
        work((one, having))
