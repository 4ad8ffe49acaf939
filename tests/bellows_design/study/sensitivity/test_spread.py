"""The global study of a response in closed form: box, samples, surrogate, indices."""

from __future__ import annotations

import pytest
from responding import Responding

from bellows_design.design.shipped import load_design
from bellows_design.design.variation import counted
from bellows_design.errors import DesignError
from bellows_design.neighbours.sensitivities import ANGLE, RESPONSES
from bellows_design.study.sensitivity.spread import box_around, spread_over

pytest.importorskip("SALib")
FINGER = counted(load_design("finger"))
LINEAR = {"bubble_width": 1.2, "bubble_thickness": -1.0, "load.pressure": 0.4, "offset": 0.001}


def test_parameters_without_effect_have_no_part_in_the_box():
    box = box_around(Responding(FINGER, LINEAR).sensitivities(), 10.0, "unit-cell")
    assert box.names == ("bubble_width", "bubble_thickness", "load.pressure")


def test_shares_of_a_linear_response_are_the_squares_of_its_elasticities():
    stub = Responding(FINGER, LINEAR)
    found = stub.sensitivities()
    spread = spread_over(box_around(found, 10.0, "unit-cell"), found, 10, 0, stub.answers)
    total = 1.2**2 + 1.0**2 + 0.4**2
    for response in RESPONSES:
        for index in spread.spreads[response].indices:
            assert index.first == pytest.approx(LINEAR[index.parameter] ** 2 / total, abs=0.01)
        assert spread.spreads[response].surrogate.error.largest_percent < 1e-6


def test_shares_due_to_a_product_are_in_the_totals_of_both_parameters():
    pair = ("bubble_width", "bubble_thickness")
    stub = Responding(FINGER, LINEAR, {pair: 20.0})
    found = stub.sensitivities()
    spread = spread_over(box_around(found, 10.0, "unit-cell"), found, 12, 0, stub.answers)
    # Variances of a x and b x y, x and y uniform within ± r: a² r²/3 and b² r⁴/9.
    alone = {name: LINEAR[name] ** 2 * 0.01 / 3 for name in (*pair, "load.pressure")}
    product = 20.0**2 * 1e-4 / 9
    variance = sum(alone.values()) + product
    for index in spread.spreads[ANGLE].indices:
        mixed = product if index.parameter in pair else 0.0
        assert index.first == pytest.approx(alone[index.parameter] / variance, abs=0.02)
        assert index.total == pytest.approx((alone[index.parameter] + mixed) / variance, abs=0.02)


def test_samples_without_a_result_are_left_out_and_counted():
    stub = Responding(FINGER, LINEAR, failing=(2, 5))
    found = stub.sensitivities()
    box = box_around(found, 10.0, "unit-cell")
    spread = spread_over(box, found, 12, 0, stub.answers)
    assert spread.failed == spread.to_dict()["failed"] == 2
    assert spread.spreads[ANGLE].surrogate.error.largest_percent < 1e-6
    hopeless = Responding(FINGER, LINEAR, failing=tuple(range(12)))
    with pytest.raises(DesignError, match="too few"):
        spread_over(box, found, 12, 0, hopeless.answers)
