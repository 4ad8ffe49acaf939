"""The examples run, and say what is true. The design script is tested with the CadQuery plugin."""

from __future__ import annotations

import re
import runpy
from contextlib import redirect_stdout
from functools import cache
from io import StringIO
from itertools import pairwise
from pathlib import Path

import pytest
from inertia import needs_inertia

from bellows_design.own_body.analysis.evaluate import evaluate as evaluated

EXAMPLES = Path(__file__).parents[2] / "examples"


@cache
def printed_by(example: str) -> tuple[str, ...]:
    """Lines that an example prints when it is run as a program."""
    with redirect_stdout(StringIO()) as printed:
        runpy.run_path(str(EXAMPLES / example), run_name="__main__")
    return tuple(printed.getvalue().splitlines())


@needs_inertia
def test_the_balloon_of_the_documentation_holds_as_much_as_the_closed_form_says() -> None:
    _, *path, last = printed_by("balloon.py")
    computed, closed = map(float, re.findall(r"([\d.]+) MPa", last))
    assert computed == pytest.approx(closed, rel=1e-3)
    rows = [line.split() for line in path]
    assert len(rows) > 4
    for _, pressure, expected, _ in rows:
        assert float(pressure) == pytest.approx(float(expected), rel=2e-3)
    assert [row[3] for row in rows][:3] == ["True"] * 3 and rows[-1][3] == "False"


@pytest.mark.slow
def test_the_bar_converges_to_half_a_per_cent_from_the_elastica() -> None:
    _, *rows = printed_by("own_body.py")
    (_, *coarse), (_, *middle), (_, *fine), (_, *exact) = (line.split() for line in rows)
    for first, second, third, theory in zip(coarse, middle, fine, exact, strict=True):
        assert abs(float(third) - float(second)) < abs(float(second) - float(first))
        assert float(third) == pytest.approx(float(theory), rel=6e-3)


@pytest.mark.thorough
def test_the_clamp_of_the_bar_holds_the_force_at_its_lever_arm() -> None:
    force = runpy.run_path(str(EXAMPLES / "own_body.py"))["FORCE"]
    for line in printed_by("own_body.py")[1:]:
        _, arm, _, moment = line.split()
        assert float(moment) == pytest.approx(force * float(arm), rel=1e-3)


@pytest.mark.thorough
def test_the_ball_presses_on_the_plate_a_little_more_than_hertz_says() -> None:
    """By 0.45 of the contact's radius over the ball's, as the verification of contact says.

    The first contact is hardly wider than an element.
    """
    _, *rows, last = printed_by("pressing.py")
    assert len(rows) == 5
    for row in rows:
        distance, force, hertz, _, radius = numbers(row)
        more = 0.45 * (distance / 10) ** 0.5
        assert force == pytest.approx(hertz * (1 + more), rel=0.08)
        assert radius == pytest.approx((10 * distance) ** 0.5, rel=0.2)
    done, stored = numbers(last)
    assert done == pytest.approx(stored, rel=0.03)


@pytest.mark.slow
def test_the_finger_of_ones_own_rubber_bends_as_far_as_its_stiffness_says() -> None:
    shear, misfit, reached, angle, stress, strain, warning = printed_by("own_material.py")
    assert numbers(shear) == pytest.approx([0.368], rel=0.01)
    error, largest = numbers(misfit)
    assert error < 0.03 * largest
    assert reached.startswith("reached 0.01 of 0.01 MPa.") and "unit-cell" in reached
    assert numbers(angle) == pytest.approx([403, 1.3], rel=0.05)
    assert numbers(stress) == pytest.approx([0.408, 3.5], rel=0.05)
    assert numbers(strain) == pytest.approx([35], abs=2)
    assert warning.startswith("warning: distant parts of the actuator run through each other")


@pytest.mark.thorough
def test_the_pneunet_bends_more_for_each_pascal_the_more_its_chambers_balloon() -> None:
    """On a coarse mesh up to two and a half times its air; measured is 2.7° at 20 kPa."""
    body = runpy.run_path(str(EXAMPLES / "pneunet.py"))["pneunet"](size=8.0)
    load = type(body.load)(largest_volume=2.5, points=2)
    found = evaluated(body.model_copy(update={"load": load}), meshes=1)
    assert found.converged and 0.018 < found.pressure_mpa < 0.024
    points = [(0.0, 0.0), *((at.pressure_mpa, at.chord_angle_deg or 0) for at in found.curve)]
    slopes = [(b - a) / (q - p) for (p, a), (q, b) in pairwise(points)]
    assert slopes == sorted(slopes) and slopes[-1] > 1.2 * slopes[0] > 0


def numbers(line: str) -> list[float]:
    """All numbers in a line."""
    return [float(found) for found in re.findall(r"\d+\.?\d*", line)]
