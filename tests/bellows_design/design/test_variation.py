"""Parameters that may be varied, and the fillets that are led along."""

from __future__ import annotations

import pytest

from bellows_design.design.design import Design
from bellows_design.design.overrides import known_keys
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.design.variation import (
    between,
    counted,
    geometric_parameters,
    kinked,
    led_along,
    parameters,
    varied,
)
from bellows_design.errors import DesignError


def with_indent(**numbers: float | str) -> Design:
    table = load_design("prototype_1").model_dump()
    table["indent"] = {"side": "outside", "shape": "rectangular", **numbers}
    return Design.of(table)


@pytest.mark.parametrize("name", shipped_designs())
def test_parameters_are_keys_that_a_design_may_be_set_by(name: str) -> None:
    for parameter in parameters(load_design(name)):
        assert parameter.partition("[")[0] in known_keys()


def test_a_prototype_has_its_twelve_numbers_the_constants_and_the_pressure() -> None:
    design = load_design("prototype_1")
    values = parameters(design)
    assert len(geometric_parameters(design)) == 12
    assert values["bubble_width"] == 20 and values["load.pressure"] == 0.1
    assert values["material.mu[1]"] == 3.2778 and values["material.alpha[1]"] == -0.0054
    assert led_along(design) == {}


def test_exponents_that_a_law_fixes_are_no_parameters() -> None:
    table = load_design("prototype_1").model_dump() | {"material": "ninjaflex_yeoh"}
    names = {name for name in parameters(Design.of(table)) if name.startswith("material")}
    assert names == {"material.mu[0]", "material.higher[0]", "material.higher[1]"}


def test_full_rounds_follow_what_they_round() -> None:
    design = load_design("finger")
    led = led_along(design)
    assert led == {
        "inner_fillet": ("chamber_length",),
        "outer_fillet": ("chamber_length", "bubble_thickness"),
    }
    assert not led.keys() & geometric_parameters(design).keys()
    bellows = varied(design, {"chamber_length": 2.3}).bellows
    assert (bellows.inner_fillet, bellows.outer_fillet) == pytest.approx((1.15, 2.35))
    thicker = varied(design, {"bubble_thickness": 1.25}).bellows
    assert (thicker.inner_fillet, thicker.outer_fillet) == pytest.approx((1.0, 2.25))


def test_a_fillet_a_hair_short_of_a_full_round_stays_one() -> None:
    table = load_design("finger").model_dump()
    table["bellows"]["inner_fillet"] = 0.96
    design = Design.of(table)
    for length in (1.4, 2.0, 2.6):
        bellows = varied(design, {"chamber_length": length}).bellows
        assert bellows.chamber_fillet == length / 2
        assert bellows.inner_fillet < length / 2
    assert varied(design, {"chamber_length": 1.0}).bellows.inner_fillet == pytest.approx(0.48)


def test_a_full_round_that_is_given_does_not_follow() -> None:
    bellows = varied(load_design("finger"), {"chamber_length": 2.4, "inner_fillet": 0.8}).bellows
    assert (bellows.inner_fillet, bellows.outer_fillet) == pytest.approx((0.8, 2.4))


def test_a_full_fillet_of_an_indent_follows_its_depth() -> None:
    design = with_indent(depth=0.5, width=3.0, fillet=0.5)
    assert led_along(design) == {"indent.fillet": ("indent.depth",)}
    indent = varied(design, {"indent.depth": 0.6}).indent
    assert indent is not None and indent.fillet == pytest.approx(0.6)
    assert led_along(with_indent(depth=0.5, width=3.0, fillet=0.3)) == {}


def test_only_what_is_named_changes() -> None:
    design = load_design("prototype_1")
    other = varied(design, {"bubble_width": 21, "material.mu[0]": 0.2, "load.pressure": 0.12})
    assert other.bellows.bubble_width == 21.0 and other.material.mu == (0.2, 3.2778)
    back = {name: parameters(design)[name] for name in ("bubble_width", "load.pressure")}
    assert varied(other, {**back, "material.mu[0]": 0.19825}) == design


@pytest.mark.parametrize("name", ["bubble_wdth", "number_of_bubbles", "indent.depth", "port.wall"])
def test_a_name_that_is_no_parameter_is_refused(name: str) -> None:
    with pytest.raises(DesignError, match="unknown parameter"):
        varied(load_design("prototype_1"), {name: 1.0})


def test_values_that_describe_no_design_are_refused() -> None:
    with pytest.raises(DesignError, match="bubble_thickness"):
        varied(load_design("prototype_1"), {"bubble_thickness": 9.9})


def test_the_way_between_designs_is_straight_and_keeps_full_rounds() -> None:
    design = load_design("finger")
    other = varied(design, {"chamber_length": 2.4, "bubble_width": 18.0, "load.pressure": 0.08})
    middle = between(design, other, 0.25)
    assert middle.bellows.chamber_length == pytest.approx(2.1)
    assert middle.bellows.bubble_width == pytest.approx(19.5)
    assert middle.load.pressure == pytest.approx(0.095)
    assert middle.bellows.inner_fillet == pytest.approx(1.05)
    assert between(design, other, 0.0) == design and between(design, other, 1.0) == other


def test_designs_of_other_parameters_have_no_way_between_them() -> None:
    with pytest.raises(DesignError, match=r"do not share the parameters indent\.depth"):
        between(load_design("prototype_2"), load_design("prototype_2_indent"), 0.5)


def test_level_floors_have_two_derivatives() -> None:
    assert kinked(load_design("prototype_1")) == ("bubble_thickness", "tendon_thickness")
    assert kinked(load_design("finger")) == ()


def test_a_counted_design_is_the_same_body() -> None:
    design = load_design("prototype_1")
    assert counted(design).bellows.number_of_bubbles == 7
    assert counted(design).bellows.bubble_middles == design.bellows.bubble_middles
