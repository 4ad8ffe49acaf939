"""The initial shear modulus as the beginning of the tests tells it, without any law.

Over small strains the stress of every incompressible material is that of a neo-Hookean one times
μ (1 + a x + b x² + …), x the log stretch. A parabola through the ratio leads to μ. It is less
precise than a law that fits, but owes nothing to what the law does at large strains.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bellows_design.materials.measurements.points import Measurements
from solver.arrays import Reals
from solver.material.homogeneous import MODES, UNIAXIAL, nominal_stress
from solver.material.ogden import packed

REACH = 0.4
"""Log stretch up to which points of uniaxial tests count; of others while they shear as much."""

FEWEST_POINTS = 8

BIAS = 0.01
"""Relative error of the parabola itself: that of materials of the library and of Treloar's rubber
without noise is at most this."""


CERTAIN = 3.0
"""Standard errors from which on a difference counts."""


class InitialModulus(NamedTuple):
    """Shear modulus and standard error, MPa."""

    value: float
    error: float

    def contradicts(self, modulus: float, percent: float) -> bool:
        """True if ``modulus`` (MPa) is off by more than so many per cent, and not by chance."""
        off = abs(modulus - self.value)
        return off > percent / 100 * self.value and off > CERTAIN * self.error


def initial_modulus(data: Measurements) -> InitialModulus | None:
    """The initial shear modulus of ``data``; None where too little was measured near zero."""
    found = [each for mode in data.modes if (each := _of_mode(data, mode)) is not None]
    if not found:
        return None
    weights = np.array([1 / each.error**2 for each in found])
    value = float(np.average([each.value for each in found], weights=weights))
    return InitialModulus(value, float(1 / np.sqrt(weights.sum())))


def _of_mode(data: Measurements, mode: str) -> InitialModulus | None:
    stretch, stress = data.of(mode)
    logs = np.log(stretch)
    reach = REACH * UNIAXIAL.gap / MODES[mode].gap
    near = (np.abs(logs) <= reach) & (logs != 0)
    if near.sum() < FEWEST_POINTS or np.abs(logs[near]).min() > reach / 5:
        return None
    unit = nominal_stress(MODES[mode], stretch[near], packed([1.0], [2.0]))
    return _extrapolated(logs[near], stress[near] / unit, np.abs(unit))


def _extrapolated(logs: Reals, ratio: Reals, unit: Reals) -> InitialModulus | None:
    """The ratio at zero strain; its points weigh as in a fit, by relative errors with a floor."""
    weight = np.minimum(1.0, unit / (0.05 * unit.max()))
    basis = np.stack([np.ones_like(logs), logs, logs**2], axis=1) * weight[:, None]
    target = ratio * weight
    solution, *_ = np.linalg.lstsq(basis, target, rcond=None)
    left = target - basis @ solution
    noise = float(left @ left) / (logs.size - 3)
    error = float(np.sqrt(noise * np.linalg.pinv(basis.T @ basis)[0, 0]))
    value = float(solution[0])
    return InitialModulus(value, float(np.hypot(error, BIAS * value))) if value > 0 else None
