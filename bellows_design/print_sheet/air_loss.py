"""How small a hole a pressure hold finds: the air that a part may lose, as that of one round hole.

The air is an ideal gas of constant temperature in a cavity that gives way, so that its mass is
proportional to absolute pressure times volume. Two bounds hold for what leaves through a round
hole, and the hole is as wide as either asks for:

- as through a sharp-edged orifice: isentropic flow of an ideal gas, choked beyond the critical
  ratio of pressures (ISO 6358-1:2013, clause 4; White, Fluid Mechanics, chapter 9), times a
  coefficient of discharge;
- as through a capillary as long as the wall is thick: laminar isothermal flow, Hagen and
  Poiseuille's law with the density of an ideal gas (White, Fluid Mechanics, chapter 6, and chapter
  9 on compressible duct flow, whose acceleration is left out)

      m = π d⁴ (p₁² − p₂²) / (256 μ L R T).

Through walls of some 1 mm the capillary decides: the hole is much longer than it is wide.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np

from bellows_design.design.conditions import ATMOSPHERE

GAMMA = 1.4
"""Ratio of the specific heats of air."""

GAS_TIMES_TEMPERATURE = 287.05 * 293.15
"""J/kg, of air at 20 °C."""

DISCHARGE = 0.6
"""Coefficient of a sharp-edged hole."""

VISCOSITY = 1.82e-5
"""Pa s, of air at 20 °C (Lemmon & Jacobsen, Int. J. Thermophysics 25, 2004)."""


class State(Protocol):
    """The cavity at one pressure over that outside."""

    @property
    def pressure_mpa(self) -> float:
        """MPa."""

    @property
    def cavity_volume_mm3(self) -> float:
        """mm³."""


def hole_of_loss(
    states: Sequence[State], pressure: float, loss: float, seconds: float, length: float
) -> float:
    """Diameter, mm, of the one round hole by which a held part loses so much of its pressure.

    Args:
        states: The cavity on its way to ``pressure``, at two pressures at least.
        pressure: At which the supply is closed, MPa over that outside; negative for a vacuum.
        loss: Fraction of ``pressure`` that is lost.
        seconds: In which it is lost, s.
        length: Of the hole, mm: the thickness of the wall it leads through.
    """
    later = (1 - loss) * pressure
    rate = abs(_mass(states, pressure) - _mass(states, later)) / seconds
    between = (pressure + later) / 2
    return max(orifice_diameter(rate, between), capillary_diameter(rate, between, length))


def orifice_diameter(rate: float, pressure: float) -> float:
    """Diameter, mm, of a hole in a thin wall that passes ``rate`` (kg/s).

    ``pressure``: inside, MPa over that outside.
    """
    return 1000 * math.sqrt(4 * rate / (math.pi * DISCHARGE * _flux(pressure)))


def capillary_diameter(rate: float, pressure: float, length: float) -> float:
    """Diameter, mm, of a capillary of ``length`` (mm) that passes ``rate`` (kg/s).

    ``pressure``: inside, MPa over that outside.
    """
    squares = 1e12 * abs((ATMOSPHERE + pressure) ** 2 - ATMOSPHERE**2)
    resistance = 256 * VISCOSITY * length * 1e-3 * GAS_TIMES_TEMPERATURE
    return 1000 * (rate * resistance / (math.pi * squares)) ** 0.25


def _mass(states: Sequence[State], pressure: float) -> float:
    """Air in the cavity, kg, its volume interpolated between the states."""
    known = sorted((abs(each.pressure_mpa), each.cavity_volume_mm3) for each in states)
    volume = np.interp(abs(pressure), [row[0] for row in known], [row[1] for row in known])
    return float((ATMOSPHERE + pressure) * volume * 1e-3 / GAS_TIMES_TEMPERATURE)


def _flux(pressure: float) -> float:
    """Air through a hole between ``pressure`` (MPa, over that outside) and outside, kg/(m² s)."""
    inside = ATMOSPHERE + pressure
    high, low = max(inside, ATMOSPHERE), min(inside, ATMOSPHERE)
    critical = (2 / (GAMMA + 1)) ** (GAMMA / (GAMMA - 1))
    ratio = max(low / high, critical)
    speed = ratio ** (2 / GAMMA) - ratio ** ((GAMMA + 1) / GAMMA)
    factor = math.sqrt(2 * GAMMA / (GAMMA - 1) / GAS_TIMES_TEMPERATURE * speed)
    return 1e6 * high * factor
