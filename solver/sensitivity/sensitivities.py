"""All derivatives of all responses in one table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.errors import SolverError
from solver.results.solution import Solution
from solver.sensitivity.adjoint import Workspace
from solver.sensitivity.gradients import Gradients, gradients
from solver.sensitivity.materials import MaterialChange, material_derivatives
from solver.sensitivity.reach import warning_of
from solver.sensitivity.smooth_peak import SHARPNESS, SmoothPeak

PRESSURE = "pressure"
"""Name of the pressure among the parameters."""


@dataclass(frozen=True)
class Sensitivities:
    """Derivatives of responses by parameters at an equilibrium.

    Attributes:
        responses: name -> value: ``rotation`` (degrees), ``volume`` (mm^3), ``peak_stress`` (MPa).
        derivatives: response -> parameter -> derivative, per unit of the parameter (``pressure``:
            per MPa, if the problem has pressurised surfaces).
        smooth_peak: what ``peak_stress`` is, beside the peak itself.
        adjoint_residual: largest relative residual of the adjoint solutions.
        remaining: response -> first-order change by the residual that the solve has left.
        reach: change of the loads, as a fraction of them, over which a first order holds; None
            without pressure and dead loads.
        factorizations: how many were made, 0 if that at hand was enough.
        warnings: sentences on what makes the derivatives less reliable than they look.

    Examples:
        >>> from solver import Ogden, Problem, Supports, sensitivities, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> blown = solve(Problem(shell, Ogden.neo_hooke(0.5), held, ("cavity",)), 0.05)
        >>> found = sensitivities(blown, {"scale": shell.nodes})  # the whole body grows
        >>> print(f"{found.derivatives['volume']['scale'] / found.responses['volume']:.3f}")
        3.000
    """

    responses: Mapping[str, float]
    derivatives: Mapping[str, Mapping[str, float]]
    smooth_peak: SmoothPeak
    adjoint_residual: float
    remaining: Mapping[str, float]
    reach: float | None
    factorizations: int
    warnings: tuple[str, ...] = ()


def sensitivities(
    solution: Solution,
    velocities: Mapping[str, Reals] | None = None,
    materials: Mapping[str, MaterialChange] | None = None,
    workspace: Workspace | None = None,
    responses: Sequence[str] = (),
    sharpness: float = SHARPNESS,
    counted: NDArray[np.bool_] | None = None,
    region: str | None = None,
) -> Sensitivities:
    """Derivatives of responses by geometry, material and pressure, by the adjoint method.

    Args:
        solution: a converged equilibrium; with contact to a tolerance at which the points in
            contact stay the same, such as 1e-9 (``solver.neighbouring`` goes on from a solution).
        velocities: parameter -> velocity of the undeformed nodes, mm per unit of the parameter.

            *Shape:* (n, 3) each.
        materials: parameter -> (material ahead, material behind, step between them), such as
            ``constant_changes(material)``.
        workspace: as for ``gradients``, like the next three.
        responses: names; by default all that the problem has.
        sharpness: p of the smooth maximum.
        counted: nodes whose stress counts.
        region: whose material ``materials`` changes, as for ``material_derivatives``.

    Returns:
        The derivatives.

    Raises:
        SolverError: as ``gradients``, or parameters that share a name.

    Examples:
        >>> from solver import Ogden, Problem, Supports, constant_changes, sensitivities, solve
        >>> from solver.mesh import block
        >>> shell = block((5, 5, 5), (2, 2, 2), hollow=((0, 0, 0), (1, 1, 1)))  # an eighth
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> blown = solve(Problem(shell, rubber, held, ("cavity",)), 0.05)
        >>> by = sensitivities(blown, materials=constant_changes(rubber)).derivatives["volume"]
        >>> print(f"{by['pressure'] * 0.05 + by['mu_1'] * 0.5:.1e}")  # both at once change nothing
        -1.8e-13
    """
    velocities, materials = dict(velocities or {}), dict(materials or {})
    _check_names(velocities, materials)
    found = gradients(solution, workspace, responses, sharpness, counted)
    columns = {name: found.along(velocity) for name, velocity in velocities.items()}
    of_materials = material_derivatives(found, materials, region)
    table = {
        response: {name: column[response] for name, column in columns.items()}
        | of_materials[response]
        | _by_pressure(found, response)
        for response in found.responses
    }
    return _summary(found, table)


def _by_pressure(found: Gradients, response: str) -> dict[str, float]:
    loaded = bool(found.solution.problem.pressurised)
    return {PRESSURE: found.responses[response].pressure} if loaded else {}


def _summary(found: Gradients, table: Mapping[str, Mapping[str, float]]) -> Sensitivities:
    each = found.responses
    warning = warning_of(found.reach)
    return Sensitivities(
        responses={name: gradient.value for name, gradient in each.items()},
        derivatives=table,
        smooth_peak=found.smooth_peak,
        adjoint_residual=max(gradient.residual for gradient in each.values()),
        remaining={name: gradient.remaining for name, gradient in each.items()},
        reach=found.reach,
        factorizations=found.factorizations,
        warnings=(warning,) if warning else (),
    )


def _check_names(velocities: Mapping[str, Reals], materials: Mapping[str, MaterialChange]) -> None:
    names = [*velocities, *materials, PRESSURE]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise SolverError(
            f"sensitivities: the parameter {twice[0]!r} stands there twice; {PRESSURE!r} is one of "
            "them anyway."
        )
