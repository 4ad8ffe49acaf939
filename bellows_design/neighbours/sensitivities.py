"""Derivatives of angle, volume and highest stress by all numbers of a design.

Of the body that was solved for they are exact, by the adjoint method (``solver.sensitivity``): the
mesh follows the design as for a neighbour. What the ends add to a unit cell does not follow, as for
a neighbour. The number of bubbles is kept; where it changes, the angle jumps.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.design.design import Design
from bellows_design.design.variation import (
    geometric_parameters,
    kinked,
    led_along,
    parameters,
)
from bellows_design.errors import DesignError
from bellows_design.neighbours.carried import Carried
from bellows_design.neighbours.equilibrium import Equilibrium, unusable
from bellows_design.neighbours.jumps import CountChange, count_changes
from bellows_design.neighbours.record import NeighbourEvaluation

if TYPE_CHECKING:
    from solver.material.law import Hyperelastic
    from solver.sensitivity.gradients import Gradients

ANGLE, VOLUME, STRESS = "bending_angle_deg", "cavity_volume_mm3", "max_von_mises_mpa"
RESPONSES = {ANGLE: "rotation", VOLUME: "volume", STRESS: "peak_stress"}
"""Names of the responses here and in the solver."""

MATERIAL_STEP = 1e-4
"""Half of the difference in a constant of the material, relative to it, or to one where it is less.
"""

SETTLED = 1e-9
"""Last correction, in body diagonals, before derivatives are taken where walls touch. At the usual
tolerance a few points still touch or part: on Prototype 1's cell in vacuum the volume was right to
0.04 % and its derivatives wrong by 6 %, those of the stress by 5 to 30 %."""

ENDS_BOUND = 0.09
"""What the ends of a unit cell, which are kept as they are, may add to an elasticity of the angle:
5 % of one parameter changed their part by at most 0.45 % of the angle (docs/neighbours.md)."""


@dataclass(frozen=True)
class Sensitivity:
    """How a parameter changes the responses.

    ``value`` in mm, MPa or, of an exponent, no unit; ``derivatives`` of each response per ``unit``;
    ``elasticities`` in percent per percent, None where response or parameter are zero.
    """

    parameter: str
    value: float
    unit: str
    derivatives: Mapping[str, float]
    elasticities: Mapping[str, float | None]


@dataclass(frozen=True)
class Sensitivities:
    """Derivatives by all parameters of a design.

    Attributes:
        design: The design.
        responses: Their values: angle (°), volume (mm³), and the smooth maximum of the highest
            stress (MPa).
        parameters: The derivatives, geometry first.
        led_along: Fillets that are full rounds and so no parameters, and what leads them along.
        kinked: Parameters with two one-sided derivatives, whose mean is given.
        count_changes: Where the number of bubbles changes.
        smooth_peak_ratio: The smooth maximum over the highest stress itself.
        ends_bound: How much the ends of a unit cell may add to an elasticity of the angle; 0 for
            other models, which have them.
        adjoint_residual: Largest relative residual of the adjoint solutions.
        warnings: Sentences on what makes the derivatives less reliable than they look.
        seconds: Time spent, s.
    """

    design: Design
    responses: Mapping[str, float]
    parameters: tuple[Sensitivity, ...]
    led_along: Mapping[str, tuple[str, ...]]
    kinked: tuple[str, ...]
    count_changes: tuple[CountChange, ...]
    smooth_peak_ratio: float
    ends_bound: float
    adjoint_residual: float
    warnings: tuple[str, ...]
    seconds: float

    def of(self, parameter: str) -> Sensitivity:
        """That of one parameter. Raises ``DesignError`` for an unknown name."""
        for each in self.parameters:
            if each.parameter == parameter:
                return each
        raise DesignError(f"{parameter!r} is no free parameter of {self.design.name}.")

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {
            "responses": dict(self.responses),
            "parameters": [asdict(each) for each in self.parameters],
            "led_along": {name: list(leaders) for name, leaders in self.led_along.items()},
            "kinked": list(self.kinked),
            "count_changes": [asdict(change) for change in self.count_changes],
            "smooth_peak_ratio": self.smooth_peak_ratio,
            "ends_bound": self.ends_bound,
            "adjoint_residual": self.adjoint_residual,
            "warnings": list(self.warnings),
            "seconds": self.seconds,
        }


def sensitivities(found: Evaluation | NeighbourEvaluation) -> Sensitivities:
    """Derivatives at the state of an evaluation, on its finest mesh.

    By the adjoint method: one back-substitution for each response, with the factorization at hand
    where ``evaluate(design, keep=True)`` has left it, however many parameters there are.

    Args:
        found: What ``evaluate`` found for a design; it has reached its pressure.

    Returns:
        Of angle (degrees), volume (mm³) and highest stress (MPa) by every length (mm), constant of
        the material and the pressure (MPa): per unit, and in percent per percent.

    Raises:
        DesignError: The evaluation did not reach its pressure, or its walls run through each other.
        SolverError: The state is at a limit point.
        BellowsError: The mesh is none of the body's.

    Examples:
        >>> from bellows_design import evaluate, load_design, sensitivities
        >>> table = sensitivities(evaluate(load_design("prototype_1"), keep=True))
        >>> width = table.of("bubble_width")
        >>> print("degrees per", width.unit, width.derivatives["bending_angle_deg"] > 0)
        degrees per mm True
    """
    began = time.perf_counter()
    at = _equilibrium(found)
    if found.contact.detected:
        at = _settled(at)
    return _table(found, at, _gradients(at), began)


def _equilibrium(found: Evaluation | NeighbourEvaluation) -> Equilibrium:
    from bellows_design.morphing.morpher import Morpher

    if reason := unusable(found):
        raise DesignError(f"sensitivities: the state of {found.design.name} has none: {reason}.")
    if isinstance(found, NeighbourEvaluation) and found.neighbourhood is not None:
        return found.neighbourhood.equilibrium(found)
    anchor = found.anchor if isinstance(found, NeighbourEvaluation) else found
    solution, kept = anchor.computation.finest, anchor.computation.workspace
    morpher = Morpher.of(anchor.design, anchor.model.name, solution.problem.mesh)
    return Equilibrium(anchor.design, anchor.model, solution, morpher, Carried.of(anchor), kept)


def _settled(at: Equilibrium) -> Equilibrium:
    """The same, converged until the points at which walls touch stay the same; see ``SETTLED``.

    Raises ``SolverError`` if Newton's method does not get there.
    """
    from solver import neighbouring
    from solver.errors import SolverError
    from solver.paths.neighbouring import OPTIONS

    solution = at.solution
    found = neighbouring(
        solution.problem,
        solution.pressure,
        solution,
        options=replace(OPTIONS, tolerance=SETTLED),
        at_hand=at.workspace,
    )
    if found.solution is None:
        raise SolverError(f"sensitivities: the state in contact is not settled: {found.failure}.")
    return replace(at, solution=found.solution, workspace=found.newton)


def _gradients(at: Equilibrium) -> Gradients:
    from solver.sensitivity.gradients import gradients

    return gradients(at.solution, at.workspace)


def _table(
    found: Evaluation | NeighbourEvaluation, at: Equilibrium, gradients: Gradients, began: float
) -> Sensitivities:
    from solver.sensitivity.reach import warning_of

    values = {ANGLE: found.bending_angle_deg, VOLUME: found.cavity_volume_mm3}
    values[STRESS] = at.carried.stress * gradients.smooth_peak.value
    warning = warning_of(gradients.reach)
    return Sensitivities(
        design=at.design,
        responses=values,
        parameters=tuple(_rows(at, gradients, values)),
        led_along=led_along(at.design),
        kinked=kinked(at.design),
        count_changes=count_changes(at.design),
        smooth_peak_ratio=gradients.smooth_peak.ratio,
        ends_bound=ENDS_BOUND if at.model is UNIT_CELL else 0.0,
        adjoint_residual=max(each.residual for each in gradients.responses.values()),
        warnings=(warning,) if warning else (),
        seconds=time.perf_counter() - began,
    )


def _rows(
    at: Equilibrium, gradients: Gradients, values: Mapping[str, float]
) -> Iterator[Sensitivity]:
    """One row for each free parameter."""
    columns = _by_geometry(at, gradients) | _by_material(at.design, gradients)
    columns["load.pressure"] = {
        name: gradient.pressure for name, gradient in gradients.responses.items()
    }
    factors = _factors(at)
    for name, value in parameters(at.design).items():
        own = {key: factors[key] * columns[name][RESPONSES[key]] for key in RESPONSES}
        relative = {
            key: own[key] * value / values[key] if values[key] and value else None for key in own
        }
        yield Sensitivity(name, value, _unit(name), own, relative)


def _factors(at: Equilibrium) -> dict[str, float]:
    """From responses of the body to those of the whole actuator."""
    count = at.design.bellows.bubble_count if at.model is UNIT_CELL else 1
    turns = 2 * count if at.model is UNIT_CELL else 1
    return {ANGLE: turns, VOLUME: at.model.share * count, STRESS: at.carried.stress}


def _by_geometry(at: Equilibrium, gradients: Gradients) -> dict[str, dict[str, float]]:
    """Derivatives of the body's responses by lengths: products of gradient and surface motion."""
    pulled = {
        name: at.morpher.pulled_back(each.nodes) for name, each in gradients.responses.items()
    }
    velocities = {
        name: at.morpher.boundary_velocity(name, at.design)
        for name in geometric_parameters(at.design)
    }
    return {
        name: {key: float((each * velocity).sum()) for key, each in pulled.items()}
        for name, velocity in velocities.items()
    }


def _by_material(design: Design, gradients: Gradients) -> dict[str, dict[str, float]]:
    """Derivatives of the body's responses by the constants of the material."""
    from solver.sensitivity.materials import material_derivatives

    values = {k: v for k, v in parameters(design).items() if k.startswith("material.")}
    changes = {name: _material_change(design, name, value) for name, value in values.items()}
    found = material_derivatives(gradients, changes)
    return {name: {key: found[key][name] for key in found} for name in values}


def _material_change(
    design: Design, name: str, value: float
) -> tuple[Hyperelastic, Hyperelastic, float]:
    """Materials ahead and behind in one constant, and the step between them.

    Bounds of a design's material do not hold for these: it may lie on one.
    """
    step = MATERIAL_STEP * (abs(value) if ".mu[" in name else max(1.0, abs(value)))
    field, place = name.removeprefix("material.").removesuffix("]").split("[")
    before = getattr(design.material, field)

    def law(constant: float) -> Hyperelastic:
        changed = (*before[: int(place)], constant, *before[int(place) + 1 :])
        return design.material.model_copy(update={field: changed}).hyperelastic()

    return law(value + step), law(value - step), 2 * step


def _unit(parameter: str) -> str:
    if ".alpha[" in parameter:
        return ""
    return "MPa" if parameter.startswith(("material.", "load.")) else "mm"
