"""Prototype 1 with a linear law: fast, and with closed forms."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from bellows_design.design import Design, load_design
from bellows_design.force.finger_law import FingerLaw, Uncertainty
from bellows_design.force.section_law import LinearLaw
from solver.arrays import Reals

DESIGN: Design = load_design("prototype_1")
BELLOWS = DESIGN.bellows

TURN = np.radians(15.3) / 0.1
"""rad per MPa: about that of half a bubble of the coarsest cell."""

BEND = np.radians(3.3) / 10
"""rad per N mm, full width, likewise."""


@dataclass(frozen=True)
class Known:
    """Facts of a law: unknown rotations, stress (MPa, ± 5 %), and reaches (N mm)."""

    rotations: Uncertainty = field(default_factory=Uncertainty)
    von_mises: float = 2.0
    reach: float = 60.0
    ends_reach: float = 1e3

    def touching(self, pressure: float, loads: Reals) -> bool:
        """Where a section bears more than 20 N mm."""
        return bool((loads[:, 0] < -20).any())

    def stress(self, pressure: float, loads: Reals) -> tuple[float, float]:
        """MPa and percent."""
        return self.von_mises, 5.0

    def unknown(self, pressure: float, loads: Reals) -> Uncertainty:
        """As given."""
        return self.rotations

    def within(self, pressure: float, loads: Reals) -> bool:
        """Up to ``reach``, N mm."""
        return bool((abs(loads[:, 0]) < self.reach).all())

    def ends_within(self, pressure: float, loads: Reals) -> bool:
        """Up to ``ends_reach``, N mm."""
        return bool((abs(loads[[0, -1], 0]) < self.ends_reach).all())


def linear_law(**facts: object) -> FingerLaw:
    """About the law of Prototype 1, linear; ``facts`` are those of ``Known``."""
    compliance = np.diag([BEND, 0.01, 0.0])
    law = LinearLaw(BELLOWS.pitch / 2, compliance, np.array([TURN, 0.0, 0.0]), 400.0, 3000.0)
    return FingerLaw(law, facts=Known(**facts))  # type: ignore[arg-type]


def arms() -> Reals:
    """Distances of the tip from where the pieces turn, the gaps' middles: (n,), mm."""
    first = BELLOWS.bubble_middles[0] - BELLOWS.pitch / 2
    gaps = first + BELLOWS.pitch * np.arange(BELLOWS.bubble_count + 1)
    return BELLOWS.length - np.repeat(gaps, 2)[1:-1]
