"""The air of a stroke: an ideal gas at constant temperature."""

from __future__ import annotations

import pytest

from bellows_design.force.air import air_of_stroke


def test_a_rigid_vessel_at_one_bar_takes_its_volume_of_free_air() -> None:
    air = air_of_stroke(5000.0, 5000.0, 0.1, flow=6.0)
    assert air.free_litres == pytest.approx(0.005, rel=1e-12)
    assert air.seconds == pytest.approx(0.05, rel=1e-12)
    assert air.volume_change_mm3 == 0


def test_what_grows_is_filled_at_the_whole_absolute_pressure() -> None:
    rigid, grown = air_of_stroke(5000.0, 5000.0, 0.1), air_of_stroke(5000.0, 6000.0, 0.1)
    more = 1000 * (0.101325 + 0.1) / 0.1 * 1e-6
    assert grown.free_litres - rigid.free_litres == pytest.approx(more, rel=1e-12)


def test_a_vacuum_takes_air_out() -> None:
    air = air_of_stroke(5000.0, 4500.0, -0.05)
    assert air.free_litres < 0 < air.seconds
