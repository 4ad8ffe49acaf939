"""From one indent to the best near it: neighbours, and their exact sensitivities."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.design.variation import geometric_parameters, varied
from bellows_design.errors import BellowsError, DesignError
from bellows_design.neighbours.sensitivities import ANGLE, STRESS, sensitivities
from bellows_design.study.changes import Changes, change
from bellows_design.study.indent.kinds import SHARPEST, Kind
from bellows_design.study.indent.trial import Trial
from solver.errors import SolverError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation, LoadedState
    from bellows_design.design.design import Design
    from bellows_design.neighbours.record import NeighbourEvaluation
    from bellows_design.neighbours.sensitivities import Sensitivities
    from bellows_design.study.indent.aims import Aim
    from solver.arrays import Reals

SHARE = 0.11
"""Part of each length that a walk may change: of three at once 19 %, within a neighbour's reach."""

MOST_STEPS = 10
"""Evaluations of a walk; each takes about a fifth of an ordinary one with its sensitivities."""

WORTHWHILE = 1e-3
"""Relative gain of a step below which a walk ends."""

NOWHERE = 1e3
"""Value of an aim where there is no design, or none within reach: steps become shorter then."""

Bounds = dict[str, tuple[float, float]]


class Walk:
    """Steps from an ordinary evaluation towards an aim, as far as its neighbours reach.

    The highest stress jumps from node to node; steps go by its smooth maximum, over the ratio that
    both have at the start.
    """

    def __init__(
        self, anchor: Evaluation, plain: LoadedState, aim: Aim, tell: Callable[[Trial], None]
    ) -> None:
        """Every step is told to ``tell``. Raises ``BellowsError`` where no neighbour can start."""
        from bellows_design.neighbours.neighbourhood import Neighbourhood

        self._neighbourhood = Neighbourhood(anchor)
        self._plain, self._aim, self._tell = plain, aim, tell
        self._design = anchor.design
        lengths = geometric_parameters(anchor.design)
        self._start = {name: v for name, v in lengths.items() if name.startswith("indent.")}
        self._ratio = sensitivities(anchor).smooth_peak_ratio

    def best(self, bounds: Bounds) -> Design:
        """The best design that was found within ``bounds`` (mm) and reach."""
        from scipy.optimize import minimize

        found: list[tuple[float, Design]] = []

        def value_and_slope(scaled: Reals) -> tuple[float, Reals]:
            try:
                design = self._at(scaled)
                value, slope = self._judged(design)
            except (BellowsError, SolverError):
                return NOWHERE, np.zeros(len(scaled))
            found.append((value, design))
            return value, slope

        box = [self._scaled(name, *bounds[name]) for name in self._start]
        start, most = np.ones(len(box)), {"maxfun": MOST_STEPS, "ftol": WORTHWHILE}
        minimize(value_and_slope, start, jac=True, method="L-BFGS-B", bounds=box, options=most)
        return min(found, key=lambda each: each[0])[1] if found else self._design

    def _scaled(self, name: str, least: float, most: float) -> tuple[float, float]:
        """Bounds of a length over its start: what is allowed, within reach."""
        value = self._start[name]
        low, high = max(1 - SHARE, least / value), min(1 + SHARE, most / value)
        return min(1.0, low), max(1.0, high)

    def _at(self, scaled: Reals) -> Design:
        pairs = zip(self._start.items(), scaled, strict=True)
        return varied(self._design, {name: value * float(by) for (name, value), by in pairs})

    def _judged(self, design: Design) -> tuple[float, Reals]:
        """Aim at a design and its slope by the scaled lengths. Raises ``DesignError`` off reach."""
        state = self._neighbourhood.evaluate(design)
        if state.fallback:
            raise DesignError(f"the walk ends: {state.fallback}")
        self._tell(Trial.of(design, state, self._plain, "step"))
        return self._value(state, sensitivities(state))

    def _value(self, state: NeighbourEvaluation, by: Sensitivities) -> tuple[float, Reals]:
        smooth = by.responses[STRESS] / self._ratio
        changes = Changes(
            change(state.bending_angle_deg, self._plain.bending_angle_deg),
            change(smooth, self._plain.max_von_mises_mpa),
        )
        angle, stress = self._aim.slope(changes)
        scales = np.array(list(self._start.values()))
        rows = [by.of(name).derivatives for name in self._start]
        turned = np.array([row[ANGLE] for row in rows]) * 100 / self._plain.bending_angle_deg
        stressed = np.array([row[STRESS] for row in rows]) * 100 / self._plain.max_von_mises_mpa
        slope = angle * turned + stress * stressed / self._ratio
        return self._aim.value(changes), scales * slope


def walk_bounds(design: Design, kind: Kind, deepest: float) -> Bounds:
    """Bounds of an indent's depth (at most ``deepest``), width and fillet around it, mm."""
    bounds = kind.bounds(design.bellows)
    shallowest, most = bounds["depth"]
    return {
        "indent.depth": (shallowest, min(most, deepest)),
        "indent.width": bounds["width"],
        "indent.fillet": (SHARPEST, bounds["width"][1]),
    }
