"""Derivatives by constants of a material, against problems solved with others."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from meshes import bellows_cell_mesh, box_mesh
from resolved import TIGHT, by_material

from solver import (
    Contact,
    Couple,
    Ogden,
    Problem,
    RigidPlane,
    Solution,
    Supports,
    constant_changes,
    gradients,
    material_derivatives,
    solve,
)
from solver.errors import SolverError
from solver.material.law import Hyperelastic
from solver.material.mooney_rivlin import MooneyRivlin

LAWS: dict[str, Hyperelastic] = {
    "ogden": Ogden((0.2, 3.3), (3.05, -0.0054)),
    "yeoh": Ogden.yeoh(0.9, 0.05, 0.01, bulk_modulus=200.0),
    "mooney": MooneyRivlin(0.8, 0.1, 0.05, 0.0, 0.01, 30.0, "logarithmic"),
}


def cell(material: Hyperelastic) -> Solution:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    mesh = bellows_cell_mesh()
    problem = Problem(mesh, material, supports, ("cavity",), moving_plane="x1")
    return solve(problem, 0.1, TIGHT)


def touching_cell() -> Solution:
    problem = cell(Ogden.yeoh(0.5, 0.03, bulk_modulus=20.0)).problem
    pressed = replace(problem, contacts=(Contact("outside", 0.05),), loads=(Couple(-1.5),))
    return solve(pressed, 0.08, TIGHT)


def pressed_block() -> Solution:
    plane = RigidPlane("z1", 0.05, (0, 0, -1), (0, 0, 1.0), lambda load: (0, 0, -0.2 * load))
    supports = Supports(("z0",))
    problem = Problem(box_mesh(), Ogden.neo_hooke(1.0, 20.0), supports, contacts=(plane,))
    return solve(problem, 0.0, TIGHT)


def with_step(material: Hyperelastic, name: str, step: float) -> Hyperelastic:
    """The material with a constant larger by ``step``, by its name among the changes."""
    field, _, place = name.rpartition("_")
    if not place.isdigit():
        return replace(material, **{name: getattr(material, name) + step})  # type: ignore[type-var]
    values = np.array(getattr(material, field), float)
    values[int(place) - 1] += step
    return replace(material, **{field: tuple(values)})  # type: ignore[type-var]


def check(solution: Solution, name: str) -> None:
    material = solution.problem.material
    found = gradients(solution)
    ahead, behind, step = change = constant_changes(material)[name]
    table = material_derivatives(found, {name: change})
    assert ahead == with_step(material, name, step if behind is material else step / 2)
    expected = by_material(solution, found, lambda s: with_step(material, name, s), 10 * step)
    for response, row in table.items():
        scale = max(abs(expected[response]), 1e-3 * abs(found.responses[response].value))
        assert abs(row[name] - expected[response]) <= 1e-6 * scale, response


QUICK = (("ogden", "alpha_1"), ("yeoh", "bulk_modulus"), ("mooney", "c20"))
CASES = [(law, name) for law, material in LAWS.items() for name in constant_changes(material)]


@pytest.mark.parametrize(
    ("law", "name"),
    [case if case in QUICK else pytest.param(*case, marks=pytest.mark.slow) for case in CASES],
)
def test_derivatives_by_constants_are_those_of_other_materials(law: str, name: str) -> None:
    check(cell(LAWS[law]), name)


@pytest.mark.parametrize(
    "body", [pressed_block, pytest.param(touching_cell, marks=pytest.mark.slow)]
)
def test_contacts_stiffen_with_the_material(body: Callable[[], Solution]) -> None:
    check(body(), "mu_1")


def test_each_constant_of_a_law_has_a_change() -> None:
    names = {law: list(constant_changes(material)) for law, material in LAWS.items()}
    assert names == {
        "ogden": ["mu_1", "mu_2", "alpha_1", "alpha_2"],
        "yeoh": ["mu_1", "alpha_1", "bulk_modulus", "higher_1", "higher_2"],
        "mooney": ["c10", "c01", "c20", "c11", "c02", "bulk_modulus"],
    }


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ((LAWS["ogden"], LAWS["ogden"], 0.0), "the step of 'c' between materials must not be 0"),
        ((LAWS["ogden"], LAWS["ogden"], np.nan), "must be two materials and the step"),
        ((LAWS["ogden"], 3.0, 1.0), "must be two materials and the step"),
        (LAWS["ogden"], "must be two materials and the step"),
    ],
)
def test_changes_that_are_none_are_refused(change: object, text: str) -> None:
    with pytest.raises(SolverError, match=text):
        material_derivatives(gradients(pressed_block()), {"c": change})  # type: ignore[dict-item]
