"""Derivatives by the constants of a material, as small changes of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any, TypeAlias

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import solid, with_materials
from solver.assembly.pairs.pair import ContactPair
from solver.errors import SolverError
from solver.input_types import shown
from solver.material.law import Hyperelastic
from solver.problem.contacts import surfaces_of
from solver.sensitivity.adjoint import inner
from solver.sensitivity.contact_work import contact_work
from solver.sensitivity.gradients import Gradients
from solver.sensitivity.responses import PEAK
from solver.sensitivity.work import SolidResidual

MaterialChange: TypeAlias = tuple[Hyperelastic, Hyperelastic, float]
"""Two materials beside the problem's, ahead and behind, and the parameter's step between them."""

STEP = 1e-4
"""Of a constant, relative; of those that may be zero at least this times the shear modulus, or of
an exponent times one."""

NOT_LINEAR = ("alpha", "bulk_modulus")
"""Constants in which the stress is not linear: they need a material on both sides. The others share
the problem's material."""


def constant_changes(material: Hyperelastic) -> dict[str, MaterialChange]:
    """Changes of each constant of a material, by name: ``mu_1``, ``alpha_1``, ``c10``, ...

    Args:
        material: of a law in the table of laws.

    Returns:
        name -> materials ahead and behind, and the difference of the constant between them. The
        bulk modulus is among them if it is finite.

    Examples:
        >>> from solver import Ogden, constant_changes
        >>> changes = constant_changes(Ogden((0.4,), (1.8,)))
        >>> ahead, behind, step = changes["mu_1"]
        >>> print(sorted(changes), ahead.mu[0] > behind.mu[0], step > 0)
        ['alpha_1', 'mu_1'] True True
    """
    changes: dict[str, MaterialChange] = {}
    for each in fields(material):  # type: ignore[arg-type]
        value = getattr(material, each.name)
        if isinstance(value, tuple):
            for k in range(len(value)):
                changes[f"{each.name}_{k + 1}"] = _change(material, each.name, k)
        elif isinstance(value, float | int) and np.isfinite(value):
            changes[each.name] = _change(material, each.name, None)
    return changes


def material_derivatives(
    found: Gradients, changes: Mapping[str, MaterialChange], region: str | None = None
) -> dict[str, dict[str, float]]:
    """Derivatives of all responses by changes of a material.

    Args:
        found: gradients at an equilibrium.
        changes: parameter -> (material ahead, material behind, step between them), the changed
            material in the middle, or one of the two if the stress is linear in the parameter.
        region: whose material changes, a key of the problem's ``materials``; None for its
            ``material``, that of all other elements.

    Returns:
        response -> parameter -> derivative.

    Raises:
        SolverError: anything but two materials and a step other than zero, or a region that has no
            material of its own.

    Examples:
        >>> from solver import Ogden, Problem, Supports, solve
        >>> from solver import constant_changes, gradients, material_derivatives
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> blown = solve(Problem(shell, rubber, held, ("cavity",)), 0.05)
        >>> found = gradients(blown, responses=("volume",))
        >>> by = material_derivatives(found, constant_changes(rubber))
        >>> print(by["volume"]["mu_1"] < 0)  # a stiffer shell holds less
        True
    """
    number = _number_of(found, region)
    if not changes:
        return {response: {} for response in found.responses}
    checked = {name: _checked(name, each) for name, each in changes.items()}
    residuals = _residuals(found, checked, number)
    columns = {
        name: _by_material(found, residuals, number, *each) for name, each in checked.items()
    }
    return {
        response: {name: column[response] for name, column in columns.items()}
        for response in found.responses
    }


def _number_of(found: Gradients, region: str | None) -> int:
    """Number of the material of a region; ``SolverError`` where it has none of its own."""
    others = found.solution.problem.materials
    if region is None:
        return 0
    if region not in others:
        known = ", ".join(map(repr, others)) or "none"
        raise SolverError(
            f"sensitivities: region must be one with a material of its own ({known}) or None, got "
            f"{shown(region)}."
        )
    return 1 + list(others).index(region)


def _residuals(
    found: Gradients, changes: Mapping[str, MaterialChange], number: int
) -> dict[int, tuple[Reals, Reals]]:
    """Forces and constraint violations with each material of the changes, once, by its id."""
    residual, body = SolidResidual.of(found.at), solid(found.solution.problem)
    materials = {id(each): each for *pair, _ in changes.values() for each in pair}
    distribution = found.solution.problem.distribution
    return {
        key: residual(with_materials(body, distribution.changed(number, each)))
        for key, each in materials.items()
    }


def _by_material(
    found: Gradients,
    residuals: Mapping[int, tuple[Reals, Reals]],
    number: int,
    ahead: Hyperelastic,
    behind: Hyperelastic,
    step: float,
) -> dict[str, float]:
    """Response -> derivative: the work of a difference of forces, and the stress's own change."""
    (there, stretched), (back, compressed) = residuals[id(ahead)], residuals[id(behind)]
    forces, violations = there - back, stretched - compressed
    stiffened = _stiffened_contacts(found, number, ahead, behind)
    own = _own_change(found, number, ahead, behind) if PEAK in found.responses else 0.0
    derivatives = {}
    for name, each in found.responses.items():
        adjoint = each.adjoint
        work = inner(forces, adjoint.displacement)
        work += inner(violations, adjoint.hydrostatic_pressure)
        for pair, share in stiffened:
            work += share * contact_work(pair, found.at.state, found.at.load, adjoint)
        derivatives[name] = ((own if name == PEAK else 0.0) - work) / step
    return derivatives


def _stiffened_contacts(
    found: Gradients, number: int, ahead: Hyperelastic, behind: Hyperelastic
) -> list[tuple[ContactPair, float]]:
    """Touching contacts and by which share their stiffness, that of the softest material, grows."""
    distribution = found.solution.problem.distribution
    modulus = distribution.materials[number].shear_modulus
    share = (ahead.shear_modulus - behind.shear_modulus) / modulus
    return [
        (pair, share)
        for pair in found.at.touching
        if distribution.softest_at(*surfaces_of(pair.contact)) == number
    ]


def _own_change(found: Gradients, number: int, ahead: Hyperelastic, behind: Hyperelastic) -> float:
    """Difference of the smooth peak at the same displacements, MPa."""
    region, distribution = found.region, found.solution.problem.distribution
    there, back = (
        with_materials(region.body, distribution.changed(number, each)) for each in (ahead, behind)
    )
    return region.change(there, back, found.solution.displacement)


def _change(material: Hyperelastic, name: str, place: int | None) -> MaterialChange:
    """Change of a constant, or of one of several; forward where the stress is linear in it."""
    whole: Any = getattr(material, name)
    value = whole if place is None else whole[place]
    unit = {"mu": 0.0, "bulk_modulus": 0.0, "alpha": 1.0}.get(name, material.shear_modulus)
    step = STEP * max(abs(value), unit)

    def changed(by: float) -> Hyperelastic:
        new = value + by
        if place is not None:
            new = (*whole[:place], new, *whole[place + 1 :])
        return replace(material, **{name: new})  # type: ignore[type-var]

    if name in NOT_LINEAR:
        return changed(step), changed(-step), 2 * step
    return changed(step), material, step


def _checked(name: str, given: MaterialChange) -> MaterialChange:
    """A change. Raises ``SolverError`` unless it is two materials and a step."""
    usable = isinstance(given, tuple) and len(given) == 3
    usable = usable and all(isinstance(each, Hyperelastic) for each in given[:2])
    if not usable or not isinstance(given[2], float | int) or not np.isfinite(given[2]):
        raise SolverError(
            f"sensitivities: the change of {name!r} must be two materials and the step between "
            f"them, got {shown(given)}."
        )
    if given[2] == 0:
        raise SolverError(f"sensitivities: the step of {name!r} between materials must not be 0.")
    return given
