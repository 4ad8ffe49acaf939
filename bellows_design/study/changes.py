"""How much a design bends and is stressed against another, in percent."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import LoadedState


@dataclass(frozen=True)
class Changes:
    """Changes of bending angle and highest von Mises stress, %."""

    bending_angle_percent: float
    max_von_mises_percent: float

    @staticmethod
    def between(own: LoadedState, first: LoadedState) -> Changes:
        """Of one state against another."""
        return Changes(
            change(own.bending_angle_deg, first.bending_angle_deg),
            change(own.max_von_mises_mpa, first.max_von_mises_mpa),
        )

    def apart(self, other: Changes) -> float:
        """Root of the sum of squares of both differences, in points of percent."""
        return math.hypot(
            self.bending_angle_percent - other.bending_angle_percent,
            self.max_von_mises_percent - other.max_von_mises_percent,
        )


def change(value: float, of: float) -> float:
    """Of a value against another, %."""
    return 100 * (value / of - 1)
