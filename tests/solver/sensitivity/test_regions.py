"""Derivatives of bodies of two materials, against problems solved anew."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest
from meshes import cell_mesh
from resolved import TIGHT, by_material, by_pressure, by_velocity
from two_materials import OTHER, beyond

from solver import (
    BodyForce,
    Gradients,
    Ogden,
    Problem,
    RigidPlane,
    Solution,
    Supports,
    constant_changes,
    gradients,
    material_derivatives,
    sensitivities,
    solve,
)
from solver.errors import SolverError
from solver.material.law import Hyperelastic

RUBBER = Ogden((0.8,), (2.5,), 40.0)


@cache
def blown() -> tuple[Solution, Gradients]:
    """Half a hollow block with a stiff, heavy lid of another law, blown up against a plane."""
    cells = np.ones((3, 2, 3), int)
    cells[1, 0, 1] = 2
    mesh = cell_mesh(cells, [np.arange(4.0), np.array([0, 1.0, 1.6]), np.array([0, 0.6, 1.6, 2.0])])
    mesh = mesh.with_regions({"lid": beyond(mesh, 2, 1.6)})
    mesh = mesh.with_surfaces({"tip": mesh.surfaces["x1"]})
    weight = BodyForce((0.0, 0.0, -0.05), region="lid")
    problem = Problem(
        mesh,
        RUBBER,
        Supports(("x0",), {"y0": 1}),
        ("cavity",),
        loads=(weight,),
        materials={"lid": OTHER},
    )
    found = solve(problem, 0.12, TIGHT)
    assert found.converged, found.message
    return found, gradients(found)


def agree(found: dict[str, float], expected: dict[str, float], values: dict[str, float]) -> None:
    for name, value in expected.items():
        scale = max(abs(value), 1e-2 * abs(values[name]))
        assert abs(found[name] - value) <= 1e-6 * scale, name


def values_of(found: Gradients) -> dict[str, float]:
    return {name: each.value for name, each in found.responses.items()}


def test_by_a_thicker_lid() -> None:
    """The interface moves with its nodes, and what is on either side of it with them."""
    solution, found = blown()
    at = solution.problem.mesh.nodes
    velocity = np.zeros_like(at)
    velocity[:, 2] = np.exp(-((at[:, 2] - 1.6) ** 2))
    velocity[:, 0] = 0.2 * at[:, 0] * at[:, 2]
    agree(found.along(velocity), by_velocity(solution, found, velocity, 1e-4), values_of(found))


def test_by_the_pressure() -> None:
    solution, found = blown()
    by = {name: each.pressure for name, each in found.responses.items()}
    agree(by, by_pressure(solution, found, 1e-4), values_of(found))


CHANGES = {**constant_changes(RUBBER), **constant_changes(OTHER)}
"""The bulk modulus is the lid's."""


def changed(name: str, by: float) -> Hyperelastic:
    """The material that has a constant, with a larger one."""
    if name == "mu_1":
        return replace(RUBBER, mu=(RUBBER.mu[0] + by,))
    return replace(OTHER, **{name: getattr(OTHER, name) + by})  # type: ignore[type-var]


@pytest.mark.parametrize(
    ("region", "name"), [(None, "mu_1"), ("lid", "c20"), ("lid", "bulk_modulus")]
)
def test_by_the_material_of_a_region(region: str | None, name: str) -> None:
    solution, found = blown()
    table = material_derivatives(found, {name: CHANGES[name]}, region)
    by = {response: row[name] for response, row in table.items()}
    step = 0.3 if name == "bulk_modulus" else 1e-3
    expected = by_material(solution, found, partial(changed, name), step, region)
    agree(by, expected, values_of(found))


def test_the_table_has_the_derivatives_of_the_region_that_is_asked_for() -> None:
    solution, found = blown()
    change = {"c20": constant_changes(OTHER)["c20"]}
    table = sensitivities(solution, materials=change, region="lid").derivatives
    asked = material_derivatives(found, change, "lid")
    assert table["volume"]["c20"] == pytest.approx(asked["volume"]["c20"], rel=1e-9)


@pytest.mark.parametrize("region", ["floor", "", 3])
def test_a_region_without_a_material_of_its_own_is_refused(region: str) -> None:
    _, found = blown()
    with pytest.raises(SolverError, match="region must be one with a material of its own"):
        material_derivatives(found, constant_changes(RUBBER), region)


@pytest.mark.parametrize(("region", "name"), [(None, "mu_1"), ("lid", "c10")])
def test_the_stiffness_of_a_contact_goes_with_its_softest_material(
    region: str | None, name: str
) -> None:
    """A plane presses rubber and lid: it is as stiff as the rubber, whatever the lid is."""
    plane = RigidPlane("x1", 0.05, (-1, 0, 0), (3.0, 0, 0), lambda load: (-0.1 * load, 0, 0))
    posed = replace(blown()[0].problem, contacts=(plane,))
    pressed = solve(posed, 0.05, TIGHT)
    found = gradients(pressed)
    assert found.at.touching
    table = material_derivatives(found, {name: CHANGES[name]}, region)
    by = {response: row[name] for response, row in table.items()}
    expected = by_material(pressed, found, partial(changed, name), 1e-4, region)
    agree(by, expected, values_of(found))
