"""What the law of a unit cell knows of a finger besides its motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.force.finger_law import Uncertainty
from bellows_design.force.free_finger import FreeFinger
from bellows_design.force.law.cell_law import CellLaw
from solver.arrays import Reals

ASYMMETRY = 0.5
"""Of the difference in compliance between both sides of a bubble, times the difference of their
moments: a bubble whose sides differ turns on either as the other one allows, too."""


@dataclass(frozen=True)
class CellFacts:
    """Of the law of a design's cell on its coarsest mesh, held against the free finger's evaluation.

    Section loads (n, 3) are those of the half bubbles from root to tip.
    """

    law: CellLaw
    free: FreeFinger
    interpolation: float

    def touching(self, pressure: float, loads: Reals) -> bool:
        """Whether neighbouring bubbles touch."""
        return bool((self.law.gaps(pressure, loads[:, 0]) <= 0).any())

    def stress(self, pressure: float, loads: Reals) -> tuple[float, float]:
        """Highest von Mises stress, MPa, and its estimated error, percent.

        The coarse cell's, times what the evaluation of the free finger finds more than it does
        without moments: half of that counts as uncertain where there are some.
        """
        finer = self._finer
        stress = float(self.law.stresses(pressure, loads[:, 0]).max())
        return finer * stress, self.free.stress_error_percent + 50 * abs(finer - 1)

    def unknown(self, pressure: float, loads: Reals) -> Uncertainty:
        """Rotations that the law does not know of."""
        turn = abs(float(self.law.response(pressure, np.zeros((1, 3))).motion[0, 0]))
        share = turn / abs(self.law.free_rotation) if self.law.free_rotation else 1.0
        end = share * (abs(self.free.ends_rotation) + self.free.ends_error) / 2
        return Uncertainty(
            interpolation=self.interpolation,
            mesh=self.free.mesh_error * turn,
            neighbours=self._neighbours(pressure, loads),
            root=end,
            tip=end,
            shear=1.0,
        )

    @property
    def _finer(self) -> float:
        """How many times higher the stress of the free finger is than that of the coarse cell."""
        pressure = self.law.design.load.pressure
        return self.free.stress / float(self.law.stresses(pressure, np.zeros(1))[0])

    def _neighbours(self, pressure: float, loads: Reals) -> float:
        """Mean rotation by which contact with a mirror image may be off, rad."""
        compliance = self.law.response(pressure, loads).compliance[:, 0, 0].reshape(-1, 2)
        moments = loads[:, 0].reshape(-1, 2)
        touching = (self.law.gaps(pressure, loads[:, 0]) <= 0).reshape(-1, 2).any(axis=1)
        off = ASYMMETRY * np.abs(np.diff(compliance) * np.diff(moments))[:, 0]
        return float((off * touching).mean())
