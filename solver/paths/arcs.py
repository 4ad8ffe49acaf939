"""Steps along an equilibrium path: predicted along its tangent, corrected at a right angle to it.

Lengths are root mean squares of the displacements over the unknowns. Nodes that are led have no
unknowns, and where a motion moves them there may be nothing else that moves, nor before a moving
plane touches: then the load counts too, its whole as much as the longest step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.assembly.assembly import Equilibrium
from solver.assembly.state import State
from solver.nonlinear.newton import Newton
from solver.paths.bordering import EquilibriumPoint, Row, corrected, equilibrium_point

FEW_ITERATIONS = 4
GROWTH = 1.5
SHARPEST_TURN = 0.7
"""Least cosine between the tangents at both ends of a step."""

IMMOBILE = "nothing moves with the load"

ROUNDING = 1e-6
"""Differences of loads below this share of them are no sign of anything."""


@dataclass(frozen=True)
class Arc:
    """An equilibrium, the path's unit ``tangent`` (m,) and the load's ``slope`` (1/mm) along it.

    ``length`` of the next step, ``arrived_by``: length of the step to here, mm.
    """

    equilibrium: EquilibriumPoint
    tangent: Reals
    slope: float
    length: float
    arrived_by: float = 0.0

    @property
    def load(self) -> float:
        """Fraction of the whole load."""
        return self.equilibrium.load

    @property
    def failure(self) -> str:
        """Why there is no equilibrium; empty if there is one."""
        return self.equilibrium.failure

    @property
    def unstable_modes(self) -> int | None:
        """Their number at constant load; None if unknown."""
        return self.equilibrium.unstable_modes

    def failed(self, reason: str) -> Arc:
        """The same without an equilibrium."""
        return replace(self, equilibrium=replace(self.equilibrium, failure=reason))


@dataclass(frozen=True)
class Arcs:
    """Steps of ``newton`` along its path.

    ``measured`` (m,): unknowns that count in a length. ``whole_load``: length of a change of the
    load from 0 to 1 on its own; ``longest`` step, both mm.
    """

    newton: Newton
    measured: NDArray[np.bool_]
    whole_load: float
    longest: float

    @staticmethod
    def of(newton: Newton, longest_step: float) -> Arcs:
        """For a problem, with its longest step in body diagonals."""
        numbering = newton.assembly.numbering
        measured = np.ones(numbering.size, bool)
        measured[numbering.pressure] = False
        longest = longest_step * newton.problem.mesh.size
        led = bool(newton.problem.supports.prescribed) or newton.assembly.contacts.move
        return Arcs(newton, measured, longest if led else 0.0, longest)

    def start(self, state: State, load: float, first_step: float) -> Arc:
        """A state as the start, with a first increment of the load by ``first_step``."""
        return self._arc(equilibrium_point(self.newton, state, load), None, first_step)

    def step(self, arc: Arc, length: float) -> Arc:
        """A step of a given length (mm), back along the path if it is negative.

        It fails too where the path cannot have led there: see ``_contradiction``.
        """

        def normal_plane(_s: State, _e: Equilibrium, r: Reals, d: Reals) -> float:
            return -self.product(arc, r, 0.0) / self.product(arc, d, 1.0)

        found = self._corrected(arc, length, normal_plane)
        growth = GROWTH if found.iterations <= FEW_ITERATIONS else 1.0
        follows = replace(self._arc(found, arc, growth * abs(length)), arrived_by=length)
        return follows if follows.failure else follows.failed(self._contradiction(arc, follows))

    def at_load(self, arc: Arc, load: float) -> Arc:
        """The equilibrium near an arc at another load; fails where ``step`` would."""
        follows = self._at_load(arc, load)
        return follows if follows.failure else follows.failed(self._contradiction(arc, follows))

    def onward(self, arc: Arc, load: float) -> Arc:
        """The same, wherever the path leads from there: the load goes on as at ``arc``."""
        follows = self._at_load(arc, load)
        sign = -1.0 if follows.slope * arc.slope < 0 else 1.0
        return replace(follows, tangent=sign * follows.tangent, slope=sign * follows.slope)

    def product(self, arc: Arc, vector: Reals, load: float) -> float:
        """Of an arc's unit tangent with a change of the unknowns (m,) and of the load, mm."""
        return self._inner(arc.tangent, vector) + self.whole_load**2 * arc.slope * load

    def _corrected(self, arc: Arc, length: float, row: Row) -> EquilibriumPoint:
        """The equilibrium that satisfies ``row``, predicted by a length along the tangent."""
        newton, here = self.newton, arc.equilibrium
        load = here.load + arc.slope * length
        step = newton.system.expanded(arc.tangent).scaled(length)
        moved = newton.kinematics.advanced(here.state, step)
        guess = newton.extrapolation.led_on(here.state, here.load, step, moved, load)
        return corrected(newton, guess, load, row)

    def _at_load(self, arc: Arc, load: float) -> Arc:
        length = (load - arc.load) / arc.slope
        found = self._corrected(arc, length, lambda _s, _e, _r, _d: 0.0)
        return replace(self._arc(found, arc, abs(length)), arrived_by=length)

    def _contradiction(self, a: Arc, b: Arc) -> str:
        """Why ``b`` is no equilibrium that the path leads to from ``a`` in one step; else empty.

        Along a path the load grows where its slope is positive; and where the slope changes its
        sign, a mode of the body becomes unstable or stable.
        """
        if self.product(a, b.tangent, b.slope) < SHARPEST_TURN:
            return "a sharp turn"
        here, there = a.equilibrium, b.equilibrium
        if passed := self.newton.passed(here.state, a.load, there.state, b.load):
            return passed
        if a.slope * b.slope < 0:
            known = a.unstable_modes is not None
            same = known and a.unstable_modes == b.unstable_modes
            return "the slope of the load changes its sign without a loss of stability" * same
        climbed = (b.load - a.load) * np.sign(a.slope * b.arrived_by)
        against = climbed < -ROUNDING * max(abs(a.load), abs(b.load))
        return "the load changes against its slope" if against else ""

    def _arc(self, found: EquilibriumPoint, before: Arc | None, length: float) -> Arc:
        """An equilibrium with its tangent, at an acute angle to that of the arc ``before``.

        Without that one the load increases, and ``length`` is its step.
        """
        if found.failure or found.direction is None:
            return Arc(found, np.zeros(0), 0.0, 0.0)
        direction = found.direction
        speed = float(np.sqrt(self._inner(direction, direction) + self.whole_load**2))
        if speed == 0:
            return Arc(replace(found, failure=IMMOBILE), np.zeros(0), 0.0, 0.0)
        if before is None:
            length *= speed
        elif self.product(before, direction, 1.0) < 0:
            speed = -speed
        return Arc(found, direction / speed, 1 / speed, min(length, self.longest))

    def _inner(self, a: Reals, b: Reals) -> float:
        return float(a[self.measured] @ b[self.measured]) / np.count_nonzero(self.measured)
