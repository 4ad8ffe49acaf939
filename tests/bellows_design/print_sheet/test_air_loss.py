"""The hole that a pressure hold finds, against closed forms of compressible flow."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pytest

from bellows_design.print_sheet.air_loss import DISCHARGE, hole_of_loss

ATMOSPHERE = 101_325.0
"""Pa."""


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
    found = hole_of_loss(rigid(11_000), 0.3, loss, seconds)
    assert found == pytest.approx(expected, rel=2e-3)


def test_at_low_pressures_it_is_that_of_bernoulli() -> None:
    pressure, loss, seconds, volume = 1e-3, 0.01, 10.0, 1e-5
    gas = 287.05 * 293.15
    density, gauge = ATMOSPHERE / gas, pressure * 1e6 * (1 - loss / 2)
    lost = loss * pressure * 1e6 * volume / gas
    area = lost / (seconds * DISCHARGE * math.sqrt(2 * density * gauge))
    found = hole_of_loss(rigid(volume * 1e9), pressure, loss, seconds)
    assert found == pytest.approx(1000 * math.sqrt(4 * area / math.pi), rel=0.01)


def test_a_cavity_that_gives_way_loses_more_air_for_the_same_pressure() -> None:
    soft = [State(0.0, 5_000.0), State(0.1, 11_000.0)]
    assert hole_of_loss(soft, 0.1, 0.05, 60) > hole_of_loss(rigid(11_000), 0.1, 0.05, 60)


def test_a_vacuum_is_lost_through_a_hole_too() -> None:
    shrinking = [State(0.0, 5_000.0), State(-0.05, 3_000.0)]
    assert 0 < hole_of_loss(shrinking, -0.05, 0.05, 60) < 1


def test_the_diameter_grows_as_the_root_of_loss_over_time() -> None:
    one = hole_of_loss(rigid(1000), 0.1, 0.001, 60)
    assert hole_of_loss(rigid(1000), 0.1, 0.001, 15) == pytest.approx(2 * one)
    assert hole_of_loss(rigid(4000), 0.1, 0.001, 60) == pytest.approx(2 * one)
