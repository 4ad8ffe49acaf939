"""What a neighbouring design takes over from an ordinary evaluation: its ends, its errors.

Measured on 200 designs whose numbers differ by up to 5 % from Prototype 1, Prototype 2 and
``finger`` (docs/neighbours.md).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.analysis.whole_actuator import added_by_ends, ends_factor

if TYPE_CHECKING:
    from bellows_design.analysis.material_range import ReachedStrain
    from solver import Peak

REACH = 0.2
"""Distance in design space up to which ends and errors are carried along."""

ANGLE_GROWTH, STRESS_GROWTH = 0.08, 0.6
"""By how much the estimated errors of angle and stress grow, as fractions of the values, over a
distance. Chosen wide: the angles of 200 neighbours are within 0.28 of their estimates."""


@dataclass(frozen=True)
class Carried:
    """What the ends add to the cells between them, and the errors of the evaluation, in MPa and °.

    ``angle`` (°) and ``volume`` (mm³) stay what they are; ``stress`` is a factor. Where that is not
    1, the highest stress is in the ends, at ``place`` (mm), and they are strained by ``strain``;
    else there are none. ``angle_error`` (°) and ``stress_error``, a fraction, are None where the
    evaluation has no estimate.
    """

    angle: float
    volume: float
    stress: float
    angle_error: float | None
    stress_error: float | None
    place: tuple[float, float, float] | None = None
    strain: ReachedStrain | None = None

    @staticmethod
    def of(anchor: Evaluation) -> Carried:
        """From an ordinary evaluation that converged."""
        computation, errors = anchor.computation, anchor.error_estimate
        angle, volume = added_by_ends(computation, computation.finest.path[-1])
        factor, strain = ends_factor(computation), _strain_of_ends(anchor)
        return Carried(
            angle=angle,
            volume=volume,
            stress=factor,
            angle_error=_times(errors.bending_angle_percent, abs(anchor.bending_angle_deg) / 100),
            stress_error=_times(errors.max_von_mises_percent, 1 / 100),
            place=None if strain is None else anchor.max_von_mises_position_mm,
            strain=strain,
        )

    def applied(self, cells: LoadedState, peak: Peak, distance: float) -> LoadedState:
        """The whole actuator at a distance in design space, from the state of its cells alone."""
        angle = cells.bending_angle_deg + self.angle
        return replace(
            cells,
            bending_angle_deg=angle,
            max_von_mises_mpa=self.stress * cells.max_von_mises_mpa,
            max_von_mises_position_mm=self.place or cells.max_von_mises_position_mm,
            cavity_volume_mm3=cells.cavity_volume_mm3 + self.volume,
            strain=cells.strain if self.strain is None else cells.strain.joined(self.strain),
            error_estimate=ErrorEstimate(
                self._angle_percent(abs(angle), distance), self._stress_percent(peak, distance)
            ),
        )

    def _angle_percent(self, angle: float, distance: float) -> float | None:
        if self.angle_error is None or not angle:
            return None
        return 100 * (self.angle_error / angle + ANGLE_GROWTH * distance)

    def _stress_percent(self, peak: Peak, distance: float) -> float | None:
        if self.stress_error is None:
            return None
        scatter = peak.scatter / peak.value if peak.value else 0.0
        return 100 * (max(self.stress_error, scatter) + STRESS_GROWTH * distance)


def _times(percent: float | None, factor: float) -> float | None:
    return None if percent is None else percent * factor


def _strain_of_ends(anchor: Evaluation) -> ReachedStrain | None:
    """How far the ends are strained where they are stressed more than the cells."""
    from bellows_design.analysis.material_range import reached_strain

    ends = anchor.computation.ends
    if ends is None or ends_factor(anchor.computation) == 1.0:
        return None
    return reached_strain(anchor.design.material, ends)
