"""Charts: values lie where they must, ticks are round, text is text."""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bellows_design.web.charts import (
    Bar,
    ChartError,
    Limit,
    Line,
    Mark,
    bar_chart,
    line_chart,
    scatter_chart,
)
from bellows_design.web.charts.scales import log_ticks, nice_ticks, scale, short

SVG = "{http://www.w3.org/2000/svg}"
PRESSURE = [0.0, 0.05, 0.1]
ANGLE = [0.0, 20.0, 50.0]


def drawn(markup: str) -> ElementTree.Element:
    """The chart as a tree: it is well-formed."""
    return ElementTree.fromstring(markup)


def of_class(root: ElementTree.Element, name: str) -> list[ElementTree.Element]:
    return [found for found in root.iter() if name in found.get("class", "").split()]


def texts(root: ElementTree.Element) -> list[str]:
    return [found.text or "" for found in root.iter(f"{SVG}text")]


def places(path: ElementTree.Element) -> list[tuple[float, float]]:
    pairs = re.findall(r"([-\d.]+) ([-\d.]+)", path.get("d", ""))
    return [(float(x), float(y)) for x, y in pairs]


def chart(*lines: Line, **options: object) -> ElementTree.Element:
    labels = {"x_label": "pressure, MPa", "y_label": "angle, °", "title": "Angle"}
    return drawn(line_chart(lines, **(labels | options)))  # type: ignore[arg-type]


def test_values_lie_between_the_ends_of_their_axes_in_proportion() -> None:
    root = chart(Line("angle", PRESSURE, ANGLE), x_bounds=(0, 0.2), y_bounds=(0, 100))
    (path,) = of_class(root, "line")
    (start_x, start_y), (middle_x, middle_y), (end_x, end_y) = places(path)
    assert math.isclose(middle_x - start_x, (end_x - start_x) / 2, abs_tol=0.02)
    assert math.isclose(start_y - middle_y, (start_y - end_y) * 0.4, abs_tol=0.02)
    (axis,) = [line for line in of_class(root, "axis") if line.get("y1") == line.get("y2")]
    assert math.isclose(end_x - start_x, (float(axis.get("x2", 0)) - start_x) / 2, abs_tol=0.02)


def test_a_curve_breaks_where_a_value_is_missing() -> None:
    root = chart(Line("angle", [0, 1, 2, 3, 4], [0, 1, math.nan, 3, 4], points=True))
    (path,) = of_class(root, "line")
    assert path.get("d", "").count("M") == 2 and len(places(path)) == 4
    assert len(of_class(root, "point")) == 4


def test_a_band_goes_along_its_upper_end_and_back_along_its_lower_one() -> None:
    low, high = [0.0, 18.0, 45.0], [0.0, 22.0, 55.0]
    root = chart(Line("angle", PRESSURE, ANGLE, low, high), y_bounds=(0, 100))
    (band,), (path,) = of_class(root, "band"), of_class(root, "line")
    outline, curve = places(band), places(path)
    assert len(outline) == 6
    assert outline[2][1] < curve[2][1] < outline[3][1]
    assert outline[2][0] == outline[3][0] == curve[2][0]


def test_a_limit_lies_at_its_value_and_one_off_the_axis_is_left_out() -> None:
    limits = [Limit(50.0, "limit 50°"), Limit(0.1, "design", "x"), Limit(500.0, "far")]
    root = chart(Line("angle", PRESSURE, ANGLE), limits=limits, y_bounds=(0, 100))
    level, upright = of_class(root, "limit")
    end_x, end_y = places(of_class(root, "line")[0])[-1]
    assert float(level.get("y1", 0)) == end_y and float(upright.get("x1", 0)) == end_x
    assert [found.text for found in of_class(root, "limit-text")] == ["limit 50°", "design"]


def test_a_limit_beyond_the_curve_widens_the_axis() -> None:
    root = chart(Line("angle", PRESSURE, ANGLE), limits=[Limit(90.0, "limit")])
    assert len(of_class(root, "limit")) == 1 and "100" in texts(root)


def test_the_text_of_a_limit_stands_where_the_curve_leaves_room() -> None:
    rising = chart(Line("a", [0, 1], [0, 10]), limits=[Limit(10.0, "limit")])
    falling = chart(Line("a", [0, 1], [10, 0]), limits=[Limit(10.0, "limit")])
    assert of_class(rising, "limit-text")[0].get("text-anchor") == "start"
    assert of_class(falling, "limit-text")[0].get("text-anchor") == "end"


def test_equal_ratios_are_equally_long_on_a_logarithmic_axis() -> None:
    root = chart(Line("error", [1, 10, 100], [0.1, 0.01, 0.001]), x_log=True, y_log=True)
    one, two, three = places(of_class(root, "line")[0])
    assert math.isclose(two[0] - one[0], three[0] - two[0], abs_tol=0.02)
    assert math.isclose(two[1] - one[1], three[1] - two[1], abs_tol=0.02)


def test_values_without_a_logarithm_are_left_out() -> None:
    root = chart(Line("error", [1, 2, 3, 4], [0.0, -1.0, 1.0, 10.0]), y_log=True)
    assert len(places(of_class(root, "line")[0])) == 2


def test_text_is_escaped_and_the_chart_says_what_it_shows() -> None:
    evil = "<script>alert('&')</script>"
    marked = line_chart(
        [Line(evil, PRESSURE, ANGLE), Line("b", PRESSURE, ANGLE)],
        x_label=evil,
        y_label=evil,
        title=evil,
        limits=[Limit(1, evil)],
        marks=[Mark(0.05, 20, evil)],
    )
    assert "<script" not in marked
    root = drawn(marked)
    title, description = root.find(f"{SVG}title"), root.find(f"{SVG}desc")
    assert title is not None and title.text == evil and texts(root).count(evil) == 5
    assert description is not None and "from 0 at 0 to 50 at 0.1" in (description.text or "")
    assert root.get("aria-labelledby") == f"{title.get('id')} {description.get('id')}"


def test_more_than_one_curve_has_a_key_and_keys_do_not_lie_over_each_other() -> None:
    names = [f"a curve with a long name {number}" for number in range(5)]
    root = chart(*(Line(name, PRESSURE, ANGLE) for name in names))
    keys = [found for found in root.iter(f"{SVG}text") if found.text in names]
    assert len({(key.get("x"), key.get("y")) for key in keys}) == 5
    assert not {"angle"} & set(texts(chart(Line("angle", PRESSURE, ANGLE))))
    (first, second) = (float(keys[number].get("y", 0)) for number in (0, 4))
    top = min(y for _, y in places(of_class(root, "line")[1]))
    assert first < second < top


def test_points_say_their_numbers_or_what_they_are_told_to() -> None:
    cloud = Line("tried", [1.0, 2.0], [3.0, 4.0], joined=False, labels=("design 1", "design <2>"))
    root = drawn(scatter_chart([cloud], x_label="x", y_label="y", title="Front"))
    said = [point.findtext(f"{SVG}title") for point in of_class(root, "point")]
    assert said == ["design 1", "design <2>"] and not of_class(root, "line")


def test_bars_go_from_zero_to_their_side_and_those_without_a_value_are_left_out() -> None:
    bars = [Bar("width", -2.0, 0.5), Bar("height", 1.0), Bar("gap", math.nan), Bar("pitch", 0.0)]
    root = drawn(bar_chart(bars, label="% per %", title="Elasticity"))
    left, right, none = of_class(root, "bar")
    edge = {name: float(left.get(name, 0)) for name in ("x", "width")}
    zero = edge["x"] + edge["width"]
    assert math.isclose(float(right.get("x", 0)), zero, abs_tol=0.02)
    assert math.isclose(edge["width"], 2 * float(right.get("width", 0)), abs_tol=0.03)
    assert float(none.get("width", 0)) <= 0.5
    assert [said for said in texts(root) if said[-1].isdigit()] == ["−2.00", "+1.00", "0.00"]
    assert "gap" not in texts(root)


def test_the_sign_of_a_bar_is_written_and_not_only_a_colour() -> None:
    root = drawn(bar_chart([Bar("a", 3.0), Bar("b", -3.0)], label="l", title="t"))
    assert {"+3.00", "−3.00"} <= set(texts(root))


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        ([Line("a", [1, 2], [1])], "2 numbers of x and 1 of y"),
        ([Line("a", [1, 2], [1, 2], low=[0, 0])], "one end of a band"),
        ([Line("a", [1, 2], [1, 2], low=[0], high=[3])], "1 of low"),
        ([Line("a", [1, 2], [math.nan, math.inf])], "no finite value"),
        ([], "no finite value"),
    ],
)
def test_what_cannot_be_drawn_is_refused_with_a_sentence(lines: list[Line], sentence: str) -> None:
    with pytest.raises(ChartError, match=sentence):
        chart(*lines)


def test_numpy_arrays_are_drawn_as_lists_are() -> None:
    arrays = chart(Line("a", np.array(PRESSURE), np.array(ANGLE)))  # type: ignore[arg-type]
    assert ElementTree.tostring(arrays) == ElementTree.tostring(chart(Line("a", PRESSURE, ANGLE)))


@given(st.floats(-1e4, 1e4), st.floats(1e-3, 1e6))
def test_ticks_are_round_and_as_far_apart_as_each_other(low: float, span: float) -> None:
    ticks = nice_ticks(low, low + span)
    steps = np.diff(ticks)
    assert 2 <= len(ticks) <= 8
    assert all(low - 1e-6 * span <= tick <= low + span * (1 + 1e-6) for tick in ticks)
    assert np.allclose(steps, steps[0], rtol=1e-3)
    leading = f"{steps[0]:.6e}"[0:4]
    assert leading in ("1.00", "2.00", "5.00", "9.99", "1.99", "4.99")


def test_values_that_are_the_same_but_for_rounding_are_drawn_as_one_level() -> None:
    found = scale([1000.0, 1000.0 + 1e-10], 0, 400)
    assert found.high - found.low > 1 and 100 < found(1000.0) < 300


@given(st.lists(st.floats(-1e5, 1e5), min_size=1, max_size=8))
def test_a_scale_shows_all_its_values(values: list[float]) -> None:
    found = scale(values, 0, 400)
    assert all(0 - 1e-6 <= found(value) <= 400 + 1e-6 for value in values)


def test_ticks_of_a_logarithmic_axis_are_powers_of_ten_or_shares_where_these_are_few() -> None:
    assert log_ticks(0.001, 100) == pytest.approx((0.001, 0.01, 0.1, 1, 10, 100))
    assert log_ticks(1, 6) == pytest.approx((1, 2, 5))


@pytest.mark.parametrize(
    ("value", "step", "text"), [(-0.5, 0.1, "−0.5"), (3.0, 1.0, "3"), (0.25, 0.05, "0.25")]
)
def test_numbers_have_the_digits_of_their_step(value: float, step: float, text: str) -> None:
    assert short(value, step) == text
