"""What may come out otherwise, and what it does to responses in closed form."""

from __future__ import annotations

import math

import pytest
from fakes import FakeEvaluation
from responding import Responding

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.design.variation import counted, parameters, varied
from bellows_design.errors import DesignError
from bellows_design.neighbours.sensitivities import ANGLE, STRESS
from bellows_design.study.sensitivity.causes import Cause, Tolerances, causes
from bellows_design.study.sensitivity.tolerance import Tolerated, tolerated

FINGER = counted(load_design("finger"))
DESIGNS = [
    FINGER,
    counted(load_design("prototype_1")),
    counted(load_design("prototype_2")),
    counted(
        with_overrides(load_design("finger"), ["tendon_thickness=1.2", "bubble_thickness=1.4"])
    ),
]
WALL = 0.05


def moved(design: Design, cause: Cause) -> Design:
    """The design at the upper end of a cause."""
    values = parameters(design)
    return varied(design, {n: values[n] + change for n, change in cause.direction.items()})


def cause(design: Design, label: str) -> Cause:
    return next(each for each in causes(design, Tolerances(WALL)) if each.label.startswith(label))


@pytest.mark.parametrize("design", DESIGNS)
def test_wider_lines_move_both_faces_of_a_wall_by_half_and_leave_the_pitch(design: Design):
    before, after = design.bellows, moved(design, cause(design, "all walls")).bellows
    outer = [b - a for a, b in zip(before.bubble_size, after.bubble_size, strict=True)]
    inner = [b - a for a, b in zip(before.chamber_size, after.chamber_size, strict=True)]
    assert outer == pytest.approx([WALL, WALL, 0])
    assert inner == pytest.approx([-WALL, -WALL, -2 * WALL])
    assert after.tendon_width - before.tendon_width == pytest.approx(WALL)
    assert after.channel_width - before.channel_width == pytest.approx(-WALL)
    assert after.pitch == pytest.approx(before.pitch)
    assert after.outer_fillet - before.outer_fillet == pytest.approx(WALL / 2)
    assert after.inner_fillet - before.inner_fillet == pytest.approx(-WALL / 2)


@pytest.mark.parametrize("design", DESIGNS)
def test_each_wall_alone_leaves_the_others_and_together_they_are_all_walls(design: Design):
    own = [each for each in causes(design, Tolerances(WALL)) if each.part_of]
    total: dict[str, float] = {}
    for each in own:
        for name, change in each.direction.items():
            total[name] = total.get(name, 0.0) + change
    together = cause(design, "all walls").direction
    assert {n: v for n, v in total.items() if abs(v) > 1e-12} == pytest.approx(together)
    if design.indent is not None:
        remaining = [
            (after := moved(design, each)).indent.remaining_wall(after.bellows)
            - design.indent.remaining_wall(design.bellows)
            for each in (*own, cause(design, "all walls"))
        ]
        assert remaining == pytest.approx([0, 0, WALL, WALL])


def test_heights_change_by_half_a_layer_and_constants_by_ten_percent():
    half = FINGER.profile().layer_height / 2
    assert cause(FINGER, "bubble height").direction == {"bubble_height": half}
    assert cause(FINGER, "tendon height").direction == {"tendon_height": half}
    negative = cause(FINGER, "alpha[1]").direction["material.alpha[1]"]
    assert negative == pytest.approx(0.1 * abs(FINGER.material.alpha[1]))


@pytest.mark.parametrize("wrong", [{"wall": -0.1}, {"wall": 2.0}, {"modulus_percent": math.nan}])
def test_tolerances_out_of_bounds_are_refused(wrong: dict[str, float]):
    with pytest.raises(DesignError, match="must lie from 0 to"):
        Tolerances(**wrong)


ELASTICITIES = {
    "bubble_thickness": -1.0,
    "bubble_width": 1.0,
    "bubble_height": 0.5,
    "tendon_thickness": -0.1,
    "material.mu[0]": -0.03,
    "material.mu[1]": -0.4,
}


def of(stub: Responding) -> Tolerated:
    evaluation = FakeEvaluation(
        design=FINGER, bending_angle_deg=stub.middle, max_von_mises_mpa=stub.middle
    )
    return tolerated(evaluation, stub.sensitivities(), Tolerances(WALL), stub.answers)


def test_margins_of_a_linear_response_are_those_of_its_closed_form():
    found = of(Responding(FINGER, ELASTICITIES))
    bubble, tendon = 400 * (WALL / 20 - WALL / 1.2), 400 * -0.1 * WALL / 1.6
    height = 400 * 0.5 * 0.05 / 20
    constants = [400 * 0.003, 400 * 0.04]
    for response in (ANGLE, STRESS):  # the smooth maximum's derivative is not the highest stress's
        margins = found.margins[response]
        assert margins["print"].likely == pytest.approx(math.hypot(bubble + tendon, height))
        assert margins["print"].worst == pytest.approx(abs(bubble) + abs(tendon) + height)
        assert margins["material"].likely == pytest.approx(math.hypot(*constants))
        assert margins["material"].worst == pytest.approx(sum(constants))
        assert margins["mesh"].likely == margins["mesh"].worst == pytest.approx(4.0)
        three = [margins[source] for source in ("print", "material", "mesh")]
        assert margins["total"].likely == pytest.approx(math.hypot(*(m.likely for m in three)))
        assert margins["total"].worst == pytest.approx(sum(m.worst for m in three))


def test_the_largest_causes_are_evaluated_at_both_ends_and_a_linear_response_agrees():
    found = of(Responding(FINGER, ELASTICITIES))
    checked = {each.cause.label: each for each in found.contributions if each.check is not None}
    assert set(checked) == {"all walls ± 0.05 mm", "mu[1] ± 10 %"}
    for each in checked.values():
        assert each.check.upper == pytest.approx(each.changes)
        assert each.check.lower == pytest.approx({n: -c for n, c in each.changes.items()})
        assert max(each.check.nonlinearity_percent.values()) < 1e-9


def test_nonlinearity_is_how_far_the_worse_end_is_off_the_derivative():
    name = "material.mu[1]"
    found = of(Responding(FINGER, ELASTICITIES, {(name, name): 2.0}))
    check = next(each.check for each in found.contributions if "mu[1]" in each.cause.label)
    assert check.upper[ANGLE] == pytest.approx(400 * (-0.04 + 2 * 0.01))
    # 2 r² over 0.4 r at r = 0.1
    assert check.nonlinearity_percent[ANGLE] == pytest.approx(50)


def test_an_end_that_cannot_be_evaluated_is_named_and_costs_nothing_else():
    found = of(Responding(FINGER, ELASTICITIES, failing=(0, 3)))
    named = [each for each in found.contributions if each.unchecked]
    assert [each.unchecked for each in named] == ["as the test wants it."] * 2
    assert found.margins == of(Responding(FINGER, ELASTICITIES)).margins
