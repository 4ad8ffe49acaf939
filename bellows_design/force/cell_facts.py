"""What the law of a unit cell knows of a finger besides its motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.force.finger_law import Uncertainty
from bellows_design.force.law.half_bubble import CellLaw
from bellows_design.force.law.interpolation.readings import gaps
from solver.arrays import Reals

ASYMMETRY = 0.5
"""Of what a half bubble turns more or less than its other half by a compliance of its own: where
neighbours touch on one side only, each side is held back, or let go, by the other."""

SHEAR = 1.0
"""Fraction of what shear changes that counts as uncertain: it enters to first order, from the
undeformed or the freely inflated cell."""

STRESS = 0.5
"""Fraction of the ratio of the stresses on the finest and the coarsest mesh that is uncertain under
a moment: it is known without one."""


@dataclass(frozen=True)
class CellFacts:
    """Of the law of a design's cell; section loads (n, 3) are those of all half bubbles."""

    law: CellLaw

    def touching(self, pressure: float, loads: Reals) -> bool:
        """Whether neighbouring bubbles touch; the outer halves have no neighbour."""
        return bool(self._touching(pressure, loads)[1:-1].any())

    def stress(self, pressure: float, loads: Reals) -> tuple[float, float] | None:
        """Highest von Mises stress, MPa, and its estimated error, percent."""
        stress, percent = self.law.stress(pressure, loads)
        if percent is None:
            return None
        return stress, percent + 100 * STRESS * abs(self.law.stress_factor - 1)

    def unknown(self, pressure: float, loads: Reals) -> Uncertainty:
        """Rotations that the law does not know of: errors in proportion to the free rotation."""
        error, free = self.law.error, self.law.free_rotation
        turn = float(self.law.response(pressure, np.zeros((1, 3))).motion[0, 0])
        share = abs(turn / free) if free else 1.0
        return Uncertainty(
            interpolation=error.interpolation,
            mesh=share * error.mesh,
            neighbours=self._neighbours(pressure, loads),
            root=share * error.ends,
            tip=share * error.ends,
            shear=SHEAR,
        )

    def within(self, pressure: float, loads: Reals) -> bool:
        """Whether the table reaches that far."""
        return self.law.within(pressure, loads)

    def ends_within(self, pressure: float, loads: Reals) -> bool:
        """Whether the short actuator was solved that far: its equilibria may end before."""
        root, tip = self.law.root, self.law.tip
        return root.within(pressure, loads[:1]) and tip.within(pressure, loads[-1:])

    def _touching(self, pressure: float, loads: Reals) -> NDArray[np.bool_]:
        """Which half bubbles touch their neighbour (n,)."""
        moments = self.law.moments(loads)
        found: NDArray[np.bool_] = gaps(self.law.table, pressure, moments) <= 0
        return found

    def _neighbours(self, pressure: float, loads: Reals) -> float:
        """Mean rotation by which contact with a mirror image may be off, rad.

        A cell has the same moment on both sides; of a bubble with two moments each half is taken
        to turn as its own side says.
        """
        halves = self.law.response(pressure, loads).compliance[:, 0, 0].reshape(-1, 2)
        moments = loads[:, 0].reshape(-1, 2)
        touching = self._touching(pressure, loads).reshape(-1, 2).any(axis=1)
        off = np.abs(np.diff(halves) * np.diff(moments))[:, 0]
        return ASYMMETRY * float((off * touching).mean())
