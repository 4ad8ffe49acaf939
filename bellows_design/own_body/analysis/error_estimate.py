"""How far off the numbers of an own body may be, from the difference of its last two meshes.

The factors are those of bellows (``bellows_design.analysis.error_estimate``), calibrated there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.error_estimate import (
    LEAST_ANGLE_ERROR,
    LEAST_STRESS_ERROR,
    care,
    peak_error,
    percent,
)
from bellows_design.own_body.analysis.readings import BodyReading, reading
from bellows_design.own_body.body import OwnBody


@dataclass(frozen=True)
class BodyErrorEstimate:
    """Estimated errors in percent of the values; None with one mesh, or where there is no value.

    ``pressure_percent`` is that of a pressure which a given volume takes.
    """

    bending_angle_percent: float | None = None
    chord_angle_percent: float | None = None
    tip_displacement_percent: float | None = None
    contact_force_percent: float | None = None
    pressure_percent: float | None = None
    max_von_mises_percent: float | None = None


def error_estimate(computation: Computation[OwnBody]) -> BodyErrorEstimate:
    """From the difference between the last two meshes, in percent of the finest.

    Nothing is estimated from a single mesh or without convergence.
    """
    if len(computation.solved) < 2 or not computation.converged:
        return BodyErrorEstimate()
    body, meshes = computation.design, len(computation.solved)
    coarse, fine = (reading(body, each) for each in computation.solutions[-2:])
    rough, peak = computation.peaks[-2:]
    pairs = {
        name: _difference(_vector(coarse, name), _vector(fine, name), meshes)
        for name in ("bending_angle_deg", "chord_angle_deg", "tip_displacement_mm",
                     "contact_force_n", "pressure_mpa")
    }  # fmt: skip
    return BodyErrorEstimate(
        bending_angle_percent=pairs["bending_angle_deg"],
        chord_angle_percent=pairs["chord_angle_deg"],
        tip_displacement_percent=pairs["tip_displacement_mm"],
        contact_force_percent=pairs["contact_force_n"],
        pressure_percent=pairs["pressure_mpa"] if body.load.by_volume else None,
        max_von_mises_percent=percent(peak_error(rough, peak, meshes), peak.value),
    )


def _vector(found: BodyReading, name: str) -> np.ndarray | None:
    """A value of a reading as an array; None where it has none."""
    value = getattr(found, name)
    return None if value is None else np.atleast_1d(value)


def _difference(coarse: np.ndarray | None, fine: np.ndarray | None, meshes: int) -> float | None:
    """Estimated error of the finer value, percent."""
    if coarse is None or fine is None:
        return None
    size = float(np.linalg.norm(fine))
    changed = max(float(np.linalg.norm(fine - coarse)), LEAST_ANGLE_ERROR * size)
    return percent(care(meshes) * changed, size)


def least_of(estimates: BodyErrorEstimate) -> tuple[tuple[float, float], ...]:
    """The estimates that there are, each with the value that it stays above, percent."""
    pairs = (
        (error, 100 * (LEAST_STRESS_ERROR if name.startswith("max") else LEAST_ANGLE_ERROR))
        for name, error in vars(estimates).items()
    )
    return tuple((error, least) for error, least in pairs if error is not None)
