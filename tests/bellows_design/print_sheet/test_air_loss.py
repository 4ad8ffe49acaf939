"""The hole that a pressure hold finds, against closed forms of compressible flow."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pytest

from bellows_design.print_sheet.air_loss import (
    DISCHARGE,
    capillary_diameter,
    hole_of_loss,
    orifice_diameter,
)

ATMOSPHERE = 101_325.0
"""Pa."""

THIN = 0.0
"""mm: a wall through which any hole is an orifice."""

GAS, VISCOSITY = 287.05 * 293.15, 1.82e-5
"""J/kg and Pa s, of air at 20 °C."""


@dataclass(frozen=True)
class State:
    pressure_mpa: float
    cavity_volume_mm3: float


def rigid(volume: float, pressure: float = 0.5) -> list[State]:
    return [State(0.0, volume), State(pressure, volume)]


def test_a_small_loss_from_a_rigid_vessel_is_that_of_choked_flow() -> None:
    """ISO 6358: the mass flow of dry air at 20 °C is 0.0404 kg/(s √K) · A p / √T."""
    pressure, loss, seconds, volume = 0.3e6, 1e-3, 60.0, 11_000e-9
    lost = loss * pressure * volume / (287.05 * 293.15)
    upstream = ATMOSPHERE + pressure * (1 - loss / 2)
    area = lost / (seconds * DISCHARGE * 0.0404 * upstream / math.sqrt(293.15))
    expected = 1000 * math.sqrt(4 * area / math.pi)
    found = hole_of_loss(rigid(11_000), 0.3, loss, seconds, THIN)
    assert found == pytest.approx(expected, rel=2e-3)


def test_at_low_pressures_it_is_that_of_bernoulli() -> None:
    pressure, loss, seconds, volume = 1e-3, 0.01, 10.0, 1e-5
    gas = 287.05 * 293.15
    density, gauge = ATMOSPHERE / gas, pressure * 1e6 * (1 - loss / 2)
    lost = loss * pressure * 1e6 * volume / gas
    area = lost / (seconds * DISCHARGE * math.sqrt(2 * density * gauge))
    found = hole_of_loss(rigid(volume * 1e9), pressure, loss, seconds, THIN)
    assert found == pytest.approx(1000 * math.sqrt(4 * area / math.pi), rel=0.01)


def test_a_cavity_that_gives_way_loses_more_air_for_the_same_pressure() -> None:
    soft = [State(0.0, 5_000.0), State(0.1, 11_000.0)]
    assert hole_of_loss(soft, 0.1, 0.05, 60, THIN) > hole_of_loss(
        rigid(11_000), 0.1, 0.05, 60, THIN
    )


def test_a_vacuum_is_lost_through_a_hole_too() -> None:
    shrinking = [State(0.0, 5_000.0), State(-0.05, 3_000.0)]
    assert 0 < hole_of_loss(shrinking, -0.05, 0.05, 60, THIN) < 1


def test_the_diameter_grows_as_the_root_of_loss_over_time() -> None:
    one = hole_of_loss(rigid(1000), 0.1, 0.001, 60, THIN)
    assert hole_of_loss(rigid(1000), 0.1, 0.001, 15, THIN) == pytest.approx(2 * one)
    assert hole_of_loss(rigid(4000), 0.1, 0.001, 60, THIN) == pytest.approx(2 * one)


def test_a_capillary_at_low_pressures_is_that_of_hagen_and_poiseuille() -> None:
    """Q = π d⁴ Δp / (128 μ L), and the density hardly changes on the way."""
    pressure, length, diameter = 100.0, 1e-3, 10e-6
    volume_rate = math.pi * diameter**4 * pressure / (128 * VISCOSITY * length)
    rate = volume_rate * (ATMOSPHERE + pressure / 2) / GAS
    assert capillary_diameter(rate, pressure * 1e-6, 1.0) == pytest.approx(10e-3, rel=1e-6)


@pytest.mark.parametrize("pressure", [0.1, 0.5, -0.05])
def test_a_capillary_passes_what_the_pressure_along_it_drives(pressure: float) -> None:
    """Integrated along the capillary: dp/dx = −128 μ m R T / (π d⁴ p)."""
    rate, length = 1e-10, 0.8
    diameter = 1e-3 * capillary_diameter(rate, pressure, length)
    high, low = sorted((ATMOSPHERE, ATMOSPHERE + 1e6 * pressure), reverse=True)
    steps = 20_000
    at = high
    for _ in range(steps):
        slope = 128 * VISCOSITY * rate * GAS / (math.pi * diameter**4)
        middle = at - slope / at * length * 1e-3 / steps / 2
        at -= slope / middle * length * 1e-3 / steps
    assert at == pytest.approx(low, rel=1e-6)


def test_the_hole_is_the_wider_of_orifice_and_capillary() -> None:
    """Through a wall of 1 mm the capillary decides, laminar; through a thin one the orifice."""
    loss, seconds, volume, pressure = 0.05, 60.0, 11_000.0, 0.1
    rate = loss * pressure * 1e6 * volume * 1e-9 / GAS / seconds
    between = pressure * (1 - loss / 2)
    capillary, orifice = capillary_diameter(rate, between, 0.8), orifice_diameter(rate, between)
    assert hole_of_loss(rigid(volume), pressure, loss, seconds, 0.8) == pytest.approx(capillary)
    assert hole_of_loss(rigid(volume), pressure, loss, seconds, 1e-4) == pytest.approx(orifice)
    assert 1.5 * orifice < capillary < 0.8 / 50
    assert 4 * rate / (math.pi * capillary * 1e-3 * VISCOSITY) < 2300  # Reynolds' number
