"""Equilibria of one body at several pressures: those that were kept, else its path walked again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bellows_design.design.bellows_parameters import BellowsParameters
from solver import Solution

SAME = 1e-9
"""Of the whole pressure: pressures that differ by less are one."""


@dataclass(frozen=True)
class WalkedBody:
    """A solved body, and the actuator whose walls may touch in it."""

    bellows: BellowsParameters
    solution: Solution

    def at(self, pressures: Sequence[float]) -> tuple[Solution, ...]:
        """Equilibria at ascending pressures (MPa, by size), the last of them that of the solution.

        Fewer, from the lowest on, where the path cannot be followed once more.
        """
        kept = [self._kept(pressure) for pressure in pressures]
        found = [solution for solution in kept if solution is not None]
        return tuple(found) if len(found) == len(kept) else self._walked(pressures)

    def _kept(self, pressure: float) -> Solution | None:
        """What the evaluation has at a pressure; None if it has nothing there."""
        known = (*self.solution.at_stops, self.solution)
        tolerance = SAME * abs(self.solution.pressure)
        near = (each for each in known if abs(each.pressure - pressure) <= tolerance)
        return next(near, None)

    def _walked(self, pressures: Sequence[float]) -> tuple[Solution, ...]:
        """From the state that is known down through the pressures, or up to it from zero."""
        from bellows_design.analysis.wall_contact import touch_guard
        from solver import solve

        known, end = self.solution, pressures[-1]
        near = np.isclose(known.pressure, end, rtol=SAME, atol=0.0)
        again = solve(
            known.problem,
            end,
            initial=(known.displacement, known.hydrostatic_pressure) if near else None,
            stops=tuple(pressures[:-1]),
            guard=touch_guard(self.bellows, known.problem),
        )
        return (*again.at_stops, again) if again.converged else again.at_stops
