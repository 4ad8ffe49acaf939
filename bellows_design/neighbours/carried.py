"""What a neighbouring design takes over from an ordinary evaluation: its ends, its errors.

Measured on 200 designs whose numbers differ by up to 5 % from Prototype 1, Prototype 2 and
``finger`` (docs/neighbours.md).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.analysis.whole_actuator import added_by_ends, ends_factor
from solver import Peak

REACH = 0.2
"""Distance in design space up to which ends and errors are carried along."""

ANGLE_GROWTH, STRESS_GROWTH = 0.08, 0.6
"""By how much the errors of angle and stress grow, as fractions of the values, over a distance."""


@dataclass(frozen=True)
class Carried:
    """What the ends add to the cells between them, and the errors of the evaluation, in MPa and °.

    ``angle`` (°) and ``volume`` (mm³) stay what they are; ``stress`` is a factor.
    """

    angle: float
    volume: float
    stress: float
    angle_error: float
    stress_error: float

    @staticmethod
    def of(anchor: Evaluation) -> Carried:
        """From an ordinary evaluation that converged."""
        computation, errors = anchor.computation, anchor.error_estimate
        angle, volume = added_by_ends(computation, computation.finest.path[-1])
        return Carried(
            angle=angle,
            volume=volume,
            stress=ends_factor(computation),
            angle_error=(errors.bending_angle_percent or 0.0) * abs(anchor.bending_angle_deg) / 100,
            stress_error=(errors.max_von_mises_percent or 0.0) / 100,
        )

    def applied(self, cells: LoadedState, peak: Peak, distance: float) -> LoadedState:
        """The whole actuator at a distance in design space, from the state of its cells alone."""
        angle = cells.bending_angle_deg + self.angle
        stress = self.stress * cells.max_von_mises_mpa
        scatter = peak.scatter / peak.value if peak.value else 0.0
        angle_error = self.angle_error + ANGLE_GROWTH * distance * abs(angle)
        stress_error = max(self.stress_error, scatter) + STRESS_GROWTH * distance
        return replace(
            cells,
            bending_angle_deg=angle,
            max_von_mises_mpa=stress,
            cavity_volume_mm3=cells.cavity_volume_mm3 + self.volume,
            error_estimate=ErrorEstimate(
                100 * angle_error / abs(angle) if angle else None, 100 * stress_error
            ),
        )
