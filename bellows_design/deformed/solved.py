"""Which solved bodies an evaluation's actuator is put together from, and their states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import UNIT_CELL, shortened
from bellows_design.deformed.joined.state import ActuatorState, BodyState
from bellows_design.deformed.pressure_path import equilibria_at, same_pressure
from bellows_design.design.design import Design
from bellows_design.neighbours.record import NeighbourEvaluation
from solver import Solution

Found: TypeAlias = Evaluation | NeighbourEvaluation


@dataclass(frozen=True)
class SolvedBodies:
    """A cell and its ends, or half of an actuator or all of it and None."""

    design: Design
    body: Solution
    ends: Solution | None

    @staticmethod
    def of(anchor: Evaluation, coarsest: bool = False) -> SolvedBodies:
        """On the finest mesh, or on the coarsest.

        A cell without ends did not reach its pressure: it stands for them, as in the evaluation.
        """
        solutions = anchor.computation.solutions
        body = solutions[0] if coarsest else solutions[-1]
        if anchor.model is not UNIT_CELL:
            return SolvedBodies(anchor.design, body, None)
        ends = anchor.computation.ends
        return SolvedBodies(anchor.design, body, body if ends is None else ends)

    @property
    def free_ends(self) -> bool:
        """Whether the ends are a bubble without neighbours, no short actuator."""
        return self.ends is not None and self.ends.problem.moving_plane is not None

    @property
    def design_of_ends(self) -> Design:
        """The design whose body the ends are."""
        return self.design if self.free_ends else shortened(self.design)

    @property
    def at_rest(self) -> ActuatorState:
        """Without load."""
        ends = None if self.ends is None else BodyState.at_rest(self.ends.problem.mesh)
        return ActuatorState(BodyState.at_rest(self.body.problem.mesh), ends, 0.0)

    def bodies_at(self, pressures: Sequence[float]) -> tuple[Solution, ...]:
        """The body at pressures (MPa), as far as it can be followed to them."""
        return equilibria_at(self.body, pressures)

    def ends_at(self, pressures: Sequence[float]) -> tuple[Solution, ...]:
        """The same of the ends."""
        assert self.ends is not None
        return equilibria_at(self.ends, pressures)

    def state(self, body: Solution, ends: Solution | None) -> ActuatorState:
        """Both under one pressure, with the angle that they make together."""
        own = BodyState.of(body)
        if ends is None:
            return ActuatorState(own, None, own.turn)
        other = BodyState.of(ends)
        cells = 2 * (self.design.bellows.bubble_count - 1) * own.tilt
        return ActuatorState(own, other, cells + (2 * other.tilt if self.free_ends else other.turn))


def reached(found: Evaluation) -> ActuatorState:
    """The actuator at the pressure that was reached, with the angle that was found there.

    Where body and ends ended at different pressures, the one that came further is followed to that
    of the other; and where that is not the evaluation's, the angle is theirs.
    """
    solved, pressure = SolvedBodies.of(found), found.pressure_mpa
    body, ends = solved.body, solved.ends
    if ends is not None and not same_pressure(body.pressure, ends.pressure):
        body = next(iter(solved.bodies_at((pressure,))), body)
        ends = next(iter(solved.ends_at((pressure,))), ends)
    state = solved.state(body, ends)
    if not same_pressure(solved.body.pressure, pressure):
        return state
    angle = float(np.radians(found.bending_angle_deg))
    return ActuatorState(state.body, state.ends, angle)


def anchor_of(found: Found) -> Evaluation:
    """The ordinary evaluation that meshes and ends are of."""
    return found if isinstance(found, Evaluation) else found.anchor
