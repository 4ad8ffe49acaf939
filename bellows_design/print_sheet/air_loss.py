"""How small a hole a pressure hold finds: the air that a part may lose, as that of one round hole.

The air is an ideal gas of constant temperature in a cavity that gives way, so that its mass is
proportional to absolute pressure times volume. What leaves through a short round hole is the
isentropic flow of an ideal gas, choked beyond the critical ratio of pressures (ISO 6358-1:2013,
clause 4; White, Fluid Mechanics, chapter 9), times a coefficient of discharge.
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
"""Coefficient of a sharp-edged hole; a longer one lets less through, and may be wider."""


class State(Protocol):
    """The cavity at one pressure over that outside."""

    @property
    def pressure_mpa(self) -> float:
        """MPa."""

    @property
    def cavity_volume_mm3(self) -> float:
        """mm³."""


def hole_of_loss(states: Sequence[State], pressure: float, loss: float, seconds: float) -> float:
    """Diameter, mm, of the one round hole by which a held part loses so much of its pressure.

    Args:
        states: The cavity on its way to ``pressure``, at two pressures at least.
        pressure: At which the supply is closed, MPa over that outside; negative for a vacuum.
        loss: Fraction of ``pressure`` that is lost.
        seconds: In which it is lost, s.
    """
    later = (1 - loss) * pressure
    lost = abs(_mass(states, pressure) - _mass(states, later))
    area = lost / (seconds * DISCHARGE * _flux((pressure + later) / 2))
    return 1000 * math.sqrt(4 * area / math.pi)


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
