"""The curve of a bellows: its evaluation for an angle, else its chain of half bubbles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.budget import Budget
from bellows_design.design.conditions import ATMOSPHERE, LEAST_PRESSURE
from bellows_design.design.design import Design
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.scene import BUILT_IN, Scene
from bellows_design.errors import UnreachedError
from bellows_design.measured.calibrated import with_stiffness
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
from bellows_design.measured.quantities import ANGLE, CHORD, FORCE
from bellows_design.progress import Progress
from solver.arrays import Reals

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.force.result import ForceCurve
    from bellows_design.store.store import Store

HIGHEST = 0.6
"""MPa. The highest pressure that a design may have; of a vacuum the atmosphere."""


@dataclass(frozen=True)
class BellowsModel:
    """A bellows and what its evaluation may take.

    Attributes:
        design: Its own pressure does not matter.
        progress: Listens to stages and load.
        budget: Of memory and time.
        store: Where results are looked for and kept; None for none.
    """

    design: Design
    progress: Progress
    budget: Budget
    store: Store | None = None

    def highest(self, question: Question) -> float:
        """Size of the highest pressure that may be asked, MPa."""
        return HIGHEST if question.sign > 0 else ATMOSPHERE

    def curve(self, question: Question, highest: float) -> ModelCurve:
        """The curve up to a size of pressure, MPa.

        Raises:
            BellowsError, MeshingError: As ``evaluate`` and ``force_curve``.
        """
        asked = min(max(highest, LEAST_PRESSURE), self.highest(question))
        by_force = question.quantity.by_force
        if not _weighs(question):
            return ScaledByPressure(self._stored(self.design, question, asked), by_force)
        curves = {
            factor: self._stored(
                _with_stiffness(self.design, factor),
                question,
                min(factor * asked, self.highest(question)),
            )
            for factor in FACTORS
        }
        return BetweenFactors(curves, by_force)

    def _stored(self, design: Design, question: Question, highest: float) -> StoredCurve:
        tangent = question.quantity == ANGLE and question.angle != CHORD
        if tangent and question.scene is None:
            return self._bending(design, question, highest)
        if question.quantity == FORCE:
            return self._force(design, question, highest)
        return self._displacement(design, question, highest)

    def _evaluated(self, design: Design, question: Question, highest: float) -> Evaluation:
        from bellows_design.store import evaluated

        pressures = tuple(float(each) for each in question.pressures(highest))
        return evaluated(
            _at(design, pressures[-1]), pressures=pressures, progress=self.progress,
            budget=self.budget, store=self.store,
        )  # fmt: skip

    def _bending(self, design: Design, question: Question, highest: float) -> StoredCurve:
        found = self._evaluated(design, question, highest)
        ending = ""
        if not found.converged:
            ending = _ended(found.pressure_mpa, found.message)
            if abs(found.pressure_mpa) * WITHIN < LEAST_PRESSURE:
                raise UnreachedError(f"the model of {design.name} reaches no pressure: {ending}.")
            found = self._evaluated(design, question, WITHIN * abs(found.pressure_mpa))
        points = [(each.pressure_mpa, each.bending_angle_deg) for each in found.curve]
        percent = found.error_estimate.bending_angle_percent
        known = () if percent is not None else (UNKNOWN_ERROR,)
        notes = (
            f"the model is the {found.model.name} on {mesh_count(len(found.meshes))}",
            *known,
            *found.warnings,
        )
        return _from_rest(points, (percent or 0.0) / 100, ending, notes)

    def _force(self, design: Design, question: Question, highest: float) -> StoredCurve:
        scene = question.scene or BUILT_IN["blocked"]
        found = self._in_scene(design, question, highest, scene, question.scene_name)
        forces = [(each.pressure_mpa, each.force_n) for each in found.curve]
        shares = [
            0.0 if each.error is None else min(1.0, each.error.total / 100) for each in found.curve
        ]
        notes = (f"the model is the chain in the scene {question.scene_name}", *found.warnings)
        return _from_rest(forces, np.array([0.0, *shares]), _ending_of(found), notes)

    def _displacement(self, design: Design, question: Question, highest: float) -> StoredCurve:
        """Of the tip's lower edge, its error by that of the rotation."""
        scene, name = (
            (Free(), "free") if question.scene is None else (question.scene, question.scene_name)
        )
        found = self._in_scene(design, question, highest, scene, name)
        free = self._bending(design, question, abs(found.last.pressure_mpa))
        share = float(np.max(free.error[1:] / np.maximum(np.abs(free.value[1:]), 1e-12)))
        pressure, angle, moved = _moved(found, design, question)
        pull = np.gradient(angle, pressure)
        error = np.abs(np.gradient(moved, pressure) * share * angle / np.where(pull, pull, np.inf))
        notes = (f"the model is the chain in the scene {name}", *found.warnings)
        return StoredCurve(pressure, moved, error, _ending_of(found), notes)

    def _in_scene(
        self, design: Design, question: Question, highest: float, scene: Scene, name: str
    ) -> ForceCurve:
        from bellows_design.force.curve import force_curve

        pressures = [float(each) for each in question.pressures(highest)]
        if _weighs(question):
            pressures = [LEAST_PART * pressures[-1], *pressures]
        found = force_curve(
            _at(design, pressures[-1]), scene, pressures, name=name, by_distance=False,
            progress=self.progress, budget=self.budget, store=self.store,
        )  # fmt: skip
        if abs(found.last.pressure_mpa) < LEAST_PRESSURE:
            raise UnreachedError(f"the model of {design.name} reaches no pressure: {found.message}")
        return found


def _weighs(question: Question) -> bool:
    """Whether weights have a part in the question."""
    return getattr(question.scene, "gravity", (0.0, 0.0)) != (0.0, 0.0)


def _at(design: Design, pressure: float) -> Design:
    """The design under another pressure, MPa."""
    load = design.load.model_copy(update={"pressure": pressure})
    return design.model_copy(update={"load": load})


def _with_stiffness(design: Design, factor: float) -> Design:
    return design.model_copy(update={"material": with_stiffness(design.material, factor)})


def _ended(pressure: float, message: str) -> str:
    return f"the model's load path ends at {abs(pressure):.4g} MPa ({message.rstrip('.')})"


def _ending_of(found: ForceCurve) -> str:
    return "" if found.converged else _ended(found.last.pressure_mpa, found.message)


def _from_rest(
    points: list[tuple[float, float]], share: float | Reals, ending: str, notes: tuple[str, ...]
) -> StoredCurve:
    """A curve that begins at nothing; ``share`` is the error by the value."""
    pressure, value = np.array([(0.0, 0.0), *((abs(p), v) for p, v in points)]).T
    kept = np.concatenate(([True], np.diff(pressure) > 1e-9))
    errors = share * np.abs(value)
    return StoredCurve(pressure[kept], value[kept], errors[kept], ending, notes)


def _moved(found: ForceCurve, design: Design, question: Question) -> tuple[Reals, Reals, Reals]:
    """Pressures, rotations of the tip, and what is asked of its lower edge, each (k,).

    At rest that edge is at the finger's length and 0 mm; a finger with weight has no such point.
    """
    rows = [(e.pressure_mpa, e.tip_angle_deg, *e.tip_position_mm) for e in found.curve]
    rest = [] if _weighs(question) else [(0.0, 0.0, design.finger_length, 0.0)]
    signed, angle, along, z = np.array([*rest, *rows]).T
    x = along - design.finger_length
    if question.quantity == ANGLE:
        chord = np.degrees(np.unwrap(np.arctan2(-z, along)))
        return np.abs(signed), angle, chord if question.angle == CHORD else angle
    chosen = {"displacement_x": x, "displacement_z": z}
    return np.abs(signed), angle, chosen.get(question.quantity.name, np.hypot(x, z))
