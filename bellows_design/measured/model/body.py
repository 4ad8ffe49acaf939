"""The curve of a body of one's own, for factors on the stiffness of its parts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bellows_design.budget import Budget
from bellows_design.design.conditions import ATMOSPHERE
from bellows_design.errors import DesignError, UnreachedError
from bellows_design.materials.material import Material
from bellows_design.measured.calibrated import with_stiffness
from bellows_design.measured.model.course import of_slow_rise
from bellows_design.measured.model.curve import (
    BetweenFactors,
    ModelCurve,
    ScaledByPressure,
    StoredCurve,
)
from bellows_design.measured.model.question import (
    FACTORS,
    LEAST_PART,
    UNKNOWN_ERROR,
    WITHIN,
    Question,
    mesh_count,
)
from bellows_design.measured.quantities import ANGLE, CHORD, FORCE, Quantity
from bellows_design.own_body import BodyEvaluation, BodyLoad, OwnBody
from bellows_design.own_body.analysis.readings import BodyReading
from bellows_design.own_body.conditions import HIGHEST_PRESSURE
from bellows_design.progress import Progress
from bellows_design.validation.quoting import did_you_mean, quoted
from solver.arrays import Reals

LEAST_PRESSURE = 1e-5
"""MPa."""

LEAST_POINTS = 24
"""Volumes at which a body is read whose volume is given."""


@dataclass(frozen=True)
class BodyModel:
    """A body and what its evaluation may take.

    Attributes:
        body: Under a pressure, which does not matter, or under a volume, which is kept.
        progress: Listens to stages and load.
        budget: Of memory and time.
        part: Name of the part whose stiffness is in question; None for all parts.

    Raises:
        DesignError: There is no such part.
    """

    body: OwnBody
    progress: Progress
    budget: Budget
    part: str | None = None

    def __post_init__(self) -> None:
        names = [each.name for each in self.body.parts]
        if self.part is not None and self.part not in names:
            raise DesignError(f"--part {quoted(self.part)}{did_you_mean(self.part, names)}")

    @property
    def material(self) -> Material:
        """Of the part in question; of all parts that of the first."""
        parts = self.body.parts
        return next(each.material for each in parts if self.part in (None, each.name))

    @property
    def materials(self) -> int:
        """How many different materials are in question."""
        return len({each.material for each in self.body.parts if self._scaled(each.name)})

    def curve(self, question: Question, highest: float) -> ModelCurve:
        """The curve up to a size of pressure, MPa; of a body under a volume as far as that.

        Raises:
            BellowsError, MeshingError, SolverError: As ``evaluate``.
        """
        most = HIGHEST_PRESSURE if question.sign > 0 else ATMOSPHERE
        asked, by_force = min(highest, most), question.quantity.by_force
        if not self._rests_on_more:
            return ScaledByPressure(self._stored(1.0, question, asked), by_force)
        curves = {
            factor: self._stored(factor, question, min(factor * asked, most)) for factor in FACTORS
        }
        return BetweenFactors(curves, by_force)

    @property
    def _rests_on_more(self) -> bool:
        """Whether stiffness or loads stay that the factor does not scale."""
        others = any(not self._scaled(each.name) for each in self.body.parts)
        return bool(self.body.films) or self.body.gravity is not None or others

    def _scaled(self, name: str) -> bool:
        return self.part in (None, name)

    def _of_stiffness(self, factor: float) -> OwnBody:
        parts = tuple(
            part.model_copy(update={"material": with_stiffness(part.material, factor)})
            if self._scaled(part.name) and factor != 1.0
            else part
            for part in self.body.parts
        )
        return self.body.model_copy(update={"parts": parts})

    def _stored(self, factor: float, question: Question, highest: float) -> StoredCurve:
        body = self._of_stiffness(factor)
        found = self._evaluated(body, question, highest)
        ending = ""
        if not found.converged and not body.load.by_volume:
            reached = abs(found.pressure_mpa)
            ending = (
                f"the model's load path ends at {reached:.4g} MPa ({found.message.rstrip('.')})"
            )
            if WITHIN * reached < LEAST_PRESSURE:
                raise UnreachedError(f"the model of {body.name} reaches no pressure: {ending}.")
            found = self._evaluated(body, question, WITHIN * reached)
        return _curve(found, question, ending)

    def _evaluated(self, body: OwnBody, question: Question, highest: float) -> BodyEvaluation:
        from bellows_design.own_body.analysis.evaluate import evaluate

        if body.load.by_volume:
            load = body.load
            points = max(load.points, LEAST_POINTS)
            volume = BodyLoad(largest_volume=load.largest_volume, points=points)
            whole = body.model_copy(update={"load": volume})
            return evaluate(whole, progress=self.progress, budget=self.budget)
        pressures = [float(each) for each in question.pressures(highest)]
        if body.gravity is not None:
            pressures = [LEAST_PART * pressures[-1], *pressures]
        asked = body.at_pressure(pressures[-1])
        return evaluate(asked, pressures=pressures, progress=self.progress, budget=self.budget)


def _curve(found: BodyEvaluation, question: Question, ending: str) -> StoredCurve:
    rest = [] if found.body.gravity is not None else [(0.0, 0.0)]
    read = [(question.sign * each.pressure_mpa, each) for each in found.curve]
    values = _unwrapped(question, [_value(each, question, found.body) for _, each in read])
    points = np.array([*rest, *zip((size for size, _ in read), values, strict=True)])
    pressure, value = points.T
    by_volume = found.body.load.by_volume
    if by_volume:
        _require_sign(found.body, question, pressure)
        pressure, value = of_slow_rise(pressure, value)
        what = "volume given" if found.converged else "path of the volume"
        ending = f"the {what} ends at {pressure[-1]:.4g} MPa"
        ending += "" if found.converged else f" ({found.message.rstrip('.')})"
    kept = np.concatenate(([True], np.diff(pressure) > 1e-9))
    pressure, value = pressure[kept], value[kept]
    percent = _percent(found, question)
    error = (percent or 0.0) / 100 * np.abs(value)
    if by_volume and pressure.size > 1:
        share = (found.error_estimate.pressure_percent or 0.0) / 100
        error = error + share * pressure * np.abs(np.gradient(value, pressure))
    return StoredCurve(pressure, value, error, ending, tuple(_notes(found, percent)))


def _require_sign(body: OwnBody, question: Question, pressure: Reals) -> None:
    """Refuse a growing volume for a measured vacuum, or the reverse, by the model's pressures."""
    if pressure.max() <= 0:
        side = "above" if question.sign > 0 else "below"
        raise DesignError(
            f"{body.name} has load.largest_volume = {body.load.largest_volume:g}, at which no "
            f"pressure is {side} 0 MPa, but the measured ones are."
        )


def _notes(found: BodyEvaluation, percent: float | None) -> Iterator[str]:
    yield f"the model is {found.reason}, on {mesh_count(len(found.meshes))}"
    if percent is None:
        yield UNKNOWN_ERROR
    yield from found.warnings


def _unwrapped(question: Question, values: list[float]) -> list[float]:
    """A chord's angle goes on where it passes half a turn."""
    if question.quantity == ANGLE and question.angle == CHORD:
        return [float(each) for each in np.unwrap([0.0, *values], period=360.0)[1:]]
    return values


def _value(at: BodyReading, question: Question, body: OwnBody) -> float:
    """What is asked of an equilibrium. Raises ``DesignError`` where the body has no such thing."""
    quantity = question.quantity
    found: float | None
    if quantity == ANGLE:
        found = at.chord_angle_deg if question.angle == CHORD else at.bending_angle_deg
        missing = "no surface “tip”, or nothing clamped where its chord begins"
    elif quantity == FORCE:
        found, missing = at.contact_force_n, "no obstacle to press on"
    else:
        moved, missing = at.tip_displacement_mm, "no surface or point “tip”"
        found = None if moved is None else _along(quantity, moved)
    if found is None:
        raise DesignError(f"{body.name} has no {quantity.words}: it has {missing}.")
    return found


def _along(quantity: Quantity, moved: tuple[float, float, float]) -> float:
    """The part of a displacement that is asked for, or its size."""
    x, _, z = moved
    chosen = {"displacement_x": x, "displacement_z": z}
    return chosen.get(quantity.name, float(np.linalg.norm(moved)))


def _percent(found: BodyEvaluation, question: Question) -> float | None:
    error = found.error_estimate
    if question.quantity == ANGLE:
        return error.chord_angle_percent if question.angle == CHORD else error.bending_angle_percent
    if question.quantity == FORCE:
        return error.contact_force_percent
    return error.tip_displacement_percent
