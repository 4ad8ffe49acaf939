"""How long air takes to fill an actuator through its channel.

Isothermal flow of a gas through a duct with friction. All of the air is taken as lying behind the
whole length of the channel, which is slower than the truth:

    G^2 = (p_s^2 - p^2) / (R T (f L/D + K + 2 ln(p_s/p)))

F. M. White, Fluid Mechanics, chapter 9 (compressible duct flow with friction). G is the mass flow
per area, f Darcy's friction factor: 64/Re of laminar flow, or Blasius' 0.316/Re^0.25 if that is
more; K = 1.5 for entrance and exit.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import trapezoid

from bellows_design.design.design import Design

ATMOSPHERE_PA, GAS_CONSTANT, TEMPERATURE_K, VISCOSITY_PA_S = 101_325.0, 287.05, 293.15, 1.81e-5
ENTRANCE_AND_EXIT = 1.5

FILLED = 0.95
"""Fraction of the design pressure at which an actuator counts as filled."""

POINTS = 200
"""Pressures between which the filling is integrated."""


def filling_seconds(design: Design, cavity_volume_mm3: float) -> float:
    """Time (s) until the air inside is at 95 % of the design pressure, from a supply at all of it.

    Args:
        design: States the channel and the pressure, which must be positive.
        cavity_volume_mm3: Air inside under pressure; all the time, which is slower than the truth.
    """
    p, height = design.bellows, design.bellows.channel_height
    supply = ATMOSPHERE_PA + 1e6 * design.load.pressure
    last = ATMOSPHERE_PA + FILLED * 1e6 * design.load.pressure
    area = 1e-6 * p.channel_width * height
    diameter = 1e-3 * 2 * p.channel_width * height / (p.channel_width + height)
    pressures = np.linspace(ATMOSPHERE_PA, last, POINTS)
    flows = np.array(
        [area * _mass_flux(supply, each, diameter, 1e-3 * p.length) for each in pressures]
    )
    capacity = 1e-9 * cavity_volume_mm3 / (GAS_CONSTANT * TEMPERATURE_K)
    return float(capacity * trapezoid(1 / flows, pressures))


def _mass_flux(supply: float, inside: float, diameter: float, length: float) -> float:
    """Mass flow per area, kg/(m² s), between two absolute pressures, Pa."""
    factor, found = 0.03, 0.0
    for _ in range(30):  # a fixed-point iteration that contracts: G falls as the root of f
        losses = factor * length / diameter + ENTRANCE_AND_EXIT + 2 * math.log(supply / inside)
        found = math.sqrt((supply**2 - inside**2) / (GAS_CONSTANT * TEMPERATURE_K * losses))
        reynolds = found * diameter / VISCOSITY_PA_S
        factor = max(64 / reynolds, 0.316 / reynolds**0.25)
    return found
