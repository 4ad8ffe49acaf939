"""What is compared of a curve: its slope before the knee, the knee, and values at pressures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

from solver.arrays import Reals

ZERO = 10.0
"""Pressure at which angles are zero, kPa."""

POINTS = 4000
"""Of a curve between its first and last equilibrium."""


@dataclass(frozen=True)
class Curve:
    """A quantity over the pressure in kPa, in the order of the path."""

    pressure: Reals
    value: Reals

    def at(self, pressure: float) -> float:
        """Where the path is at a pressure for the last time; NaN if it is not."""
        above = self.pressure > pressure
        crossings = np.flatnonzero(above[1:] != above[:-1])
        if not len(crossings):
            return float("nan")
        k = crossings[-1]
        share = (pressure - self.pressure[k]) / (self.pressure[k + 1] - self.pressure[k])
        return float(self.value[k] + share * (self.value[k + 1] - self.value[k]))

    def slope(self, low: float, high: float) -> float:
        """Mean one between two pressures, per kPa."""
        return (self.at(high) - self.at(low)) / (high - low)

    @property
    def knee(self) -> float:
        """Pressure of its first maximum, kPa, or where it is steepest if it only rises.

        NaN where it does not get as far.
        """
        rises = np.diff(self.pressure)
        inner = self.value[:-1] > KNEE_FROM
        falls = np.flatnonzero(inner & (rises < 0))
        if len(falls):
            return float(self.pressure[falls[0]])
        places = np.flatnonzero(inner)
        if not len(places):
            return float("nan")
        place = places[(rises[inner] / np.diff(self.value)[inner]).argmin()]
        return float(self.pressure[place])


KNEE_FROM = 3.0
"""Angles from which on a knee is looked for, degrees."""


def computed_curve(readings: Mapping[str, Sequence[float]], quantity: str) -> Curve:
    """Through the equilibria of a path, over the volume; angles are zero at ``ZERO``."""
    volume = np.log(readings["volume_mm3"])
    fine = np.linspace(volume[0], volume[-1], POINTS)
    pressure = CubicSpline(volume, readings["pressure_kpa"])(fine)
    value = PchipInterpolator(volume, readings[quantity])(fine)
    found = Curve(pressure, value)
    return Curve(pressure, value - found.at(ZERO)) if quantity == "angle_deg" else found


def measured_curve(table: Mapping[str, Sequence[float]], quantity: str) -> Curve:
    """Through the medians."""
    return Curve(np.array(table["pressure_kpa"]), np.array(table[quantity]))


def measured_knee(table: Mapping[str, Sequence[float]]) -> float:
    """Pressure at which medians 1 kPa apart differ the most, kPa."""
    pressure, angle = np.array(table["pressure_kpa"]), np.array(table["bending_angle_deg"])
    place = int((angle[2:] - angle[:-2]).argmax())
    return float(pressure[place + 1])
