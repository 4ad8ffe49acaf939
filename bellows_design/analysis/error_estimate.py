"""How far off the numbers of a computation may be, from the difference of its last two meshes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.whole_actuator import ENDS_NOISE, added_by_ends, ends_factor, reading

if TYPE_CHECKING:
    from solver import Peak

LEAST_ANGLE_ERROR, LEAST_STRESS_ERROR = 0.005, 0.02
"""Fractions of angle and stress that no estimate falls below: two meshes can agree by chance, and
the bubbles next to the ends are stressed a little more (4 % on Prototype 1)."""

FEW_MESHES = {2: 0.07, 3: 0.035}
"""The same for the stress as long as there are only so many meshes."""

ENDS_ERROR = 0.15
"""Fraction of what the ends add that is uncertain: a short actuator of two bubbles instead of one
moves it by that much."""

REACH_ERROR, FREE_REACH_ERROR = 0.06, 0.10
"""Fractions of a bubble's rotation by which the ends may act on more than the bubble beside them,
and the same where half bubbles without stubs stand for them: about the medians of nine designs of
three bubbles against their half models. The largest were 0.18 and 0.34."""

ENDS_STRESS_ERROR = ENDS_NOISE - 1
"""Fraction of the highest stress that is uncertain where that is in the ends, on a coarse mesh."""

TWO_MESHES = 2.0
"""Factor on both differences as long as there are only two meshes: the first is very coarse."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated errors in percent of the values; None where there was but one mesh."""

    bending_angle_percent: float | None = None
    max_von_mises_percent: float | None = None


def error_estimate(computation: Computation) -> ErrorEstimate:
    """From the difference between the last two meshes, in percent of the finest.

    Nothing is estimated from a single mesh or without convergence. Calibrated on the designs of the
    paper.
    """
    if len(computation.solved) < 2 or not computation.converged:
        return ErrorEstimate()
    return ErrorEstimate(_angle_error(computation), _stress_error(computation))


def least_estimate(computation: Computation) -> ErrorEstimate:
    """What the estimates stay above on any mesh, percent: their least values, and the ends."""
    finest, peak = computation.finest, computation.peaks[-1]
    angle = reading(computation, finest.path[-1]).bending_angle_deg
    stress = LEAST_STRESS_ERROR * peak.value + _ends_stress_error(computation)
    return ErrorEstimate(
        percent(LEAST_ANGLE_ERROR * abs(angle) + _ends_error(computation), angle),
        percent(stress, peak.value),
    )


def _angle_error(computation: Computation) -> float | None:
    """That difference is about the error of the coarser mesh, so a careful guess at the finer's."""
    coarse, fine = (
        reading(computation, solution.path[-1]).bending_angle_deg
        for solution in computation.solutions[-2:]
    )
    more = max(abs(fine - coarse), LEAST_ANGLE_ERROR * abs(fine))
    error = care(len(computation.solved)) * more
    return percent(error + _ends_error(computation), fine)


def care(meshes: int) -> float:
    """Factor on the difference between the last two of so many meshes."""
    return TWO_MESHES if meshes == 2 else 1.0


def _ends_error(computation: Computation) -> float:
    """Error (°) of taking the ends from a short actuator, or from half bubbles."""
    if computation.ends is None:
        return 0.0
    ends, _ = added_by_ends(computation, computation.finest.path[-1])
    short = computation.ends.problem.moving_plane is None
    bubble = abs(2 * computation.finest.path[-1].rotation)
    return ENDS_ERROR * abs(ends) + (REACH_ERROR if short else FREE_REACH_ERROR) * bubble


def _stress_error(computation: Computation) -> float | None:
    coarse, fine = computation.peaks[-2:]
    error = peak_error(coarse, fine, len(computation.solved))
    return percent(error + _ends_stress_error(computation), fine.value)


def peak_error(coarse: Peak, fine: Peak, meshes: int) -> float:
    """Error (MPa) of the highest stress on the last of so many meshes.

    Half of the difference, or how much the elements around the peak disagree if that is more.
    """
    difference = care(meshes) * abs(coarse.value - fine.value) / 2
    least = FEW_MESHES.get(meshes, LEAST_STRESS_ERROR)
    return max(difference, fine.scatter, least * fine.value)


def _ends_stress_error(computation: Computation) -> float:
    """Error (MPa) of the finest mesh's highest stress where the ends are stressed more."""
    more = ends_factor(computation) > 1
    return ENDS_STRESS_ERROR * computation.peaks[-1].value if more else 0.0


def percent(error: float, value: float) -> float | None:
    """An error in percent of the value; None of zero."""
    return 100 * abs(error / value) if value else None
