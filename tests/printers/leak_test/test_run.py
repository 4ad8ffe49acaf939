"""The whole leak test: verdicts, rules, places in the part's coordinates, bounds of memory."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from bead_boxes import CAVITY, WIDTH, Box, joined_beads, rotation, with_gap

from printers import Opening, PrinterProfile, PrintersError, RuleResult, load_profile
from printers.gcode.beads import BRIDGE, SKIRT, SUPPORT
from printers.leak_test import LeakTest, field, leak_test
from printers.rule_table import RULES


@pytest.fixture(scope="module")
def profile() -> PrinterProfile:
    plain = load_profile("prusa_i3")
    thick = {"layer_height": 0.2, "sealing_layer_height": 0.2, "minimum_solid_layers": 4}
    return plain.model_copy(update=thick)


def result_of(box: Box, profile: PrinterProfile, **options: object) -> LeakTest:
    return leak_test(box.beads, [box.opening], profile, **{"seams": False, **options})  # type: ignore[arg-type]


def verdicts(test: LeakTest) -> dict[str, str]:
    return {rule.rule: rule.verdict for rule in test.rules}


def test_a_sound_box_is_sealed(profile: PrinterProfile) -> None:
    box = Box()
    test = result_of(box, profile, seams=True, solid_volume=box.volume / 1.1)
    assert test.verdict == "sealed"
    assert test.leaks == () and test.width == 0
    assert test.margin == pytest.approx(0.04, abs=0.01)
    assert test.depth.lines == pytest.approx(box.wall_thickness / 0.4, abs=0.15)
    assert test.material.share == pytest.approx(1.0)
    assert set(verdicts(test).values()) == {"pass"}
    names = {"leak_path", "printed_depth", "seam_loss", "printed_material", "layer_height"}
    assert set(verdicts(test)) == names


def test_its_rules_stand_in_the_table(profile: PrinterProfile) -> None:
    names = {rule.rule for rule in result_of(Box(), profile, solid_volume=1.0, seams=True).rules}
    assert names <= set(RULES)


def layer_height(test: LeakTest) -> RuleResult:
    (result,) = [rule for rule in test.rules if rule.rule == "layer_height"]
    return result


@pytest.mark.parametrize(
    ("sealing", "verdict"), [(0.2, "pass"), (0.25, "pass"), (0.1, "fail"), (0.199, "fail")]
)
def test_layers_are_judged_as_they_are_printed(
    profile: PrinterProfile, sealing: float, verdict: str
) -> None:
    """The box has layers of 0.2 mm, whatever the profile asks for."""
    asked = profile.model_copy(update={"layer_height": 0.1, "sealing_layer_height": sealing})
    result = layer_height(result_of(Box(), asked))
    assert (result.measured, result.required, result.verdict) == (0.2, sealing, verdict)
    assert result.where == "all layers of the G-code above the first"


def test_one_thick_layer_in_the_middle_is_found(profile: PrinterProfile) -> None:
    beads = Box().beads
    layers = len(np.unique(beads.layer)) - 1
    thick = replace(beads, height=np.where(beads.layer == 5, 0.3, beads.height))
    result = layer_height(leak_test(thick, [Box().opening], profile, seams=False))
    assert (result.measured, result.verdict) == (0.3, "fail")
    assert result.where == f"1 of {layers} layers of the G-code above the first"


@pytest.mark.parametrize("kind", [SKIRT, SUPPORT, BRIDGE])
def test_thick_bridges_skirts_supports_and_first_layers_are_no_layers(kind: int) -> None:
    beads = Box().beads
    first = replace(beads, height=np.where(beads.layer == 0, 0.3, beads.height))
    other = replace(first, kind=np.full(len(beads), kind), height=np.full(len(beads), 0.4))
    assert set(joined_beads([first, other]).layer_heights) == {0.2}
    assert joined_beads([first.chosen(first.layer == 0), other]).layer_heights.tolist() == [0.3]


def test_every_result_states_severity_and_source_of_its_rule(profile: PrinterProfile) -> None:
    test = result_of(Box(), profile, seams=True, solid_volume=1.0)
    for result in test.rules:
        rule = RULES[result.rule]
        assert (result.severity, result.source) == (rule.severity, rule.source)


@pytest.mark.parametrize("severity", ["fail", "warn", "info"])
def test_a_profile_says_what_too_little_plastic_means(
    profile: PrinterProfile, severity: str
) -> None:
    stricter = profile.model_copy(update={"rules": {"printed_material": severity}})
    test = result_of(Box(), stricter, solid_volume=1.0)
    (result,) = [rule for rule in test.rules if rule.rule == "printed_material"]
    assert (result.verdict, result.severity) == (severity, severity)


def test_a_leak_fails_with_its_width_and_place(profile: PrinterProfile) -> None:
    test = result_of(Box(wall=with_gap(0.2, lambda z, number: 2.3 < z < 2.5)), profile)
    assert test.verdict == "leaks"
    assert test.width == pytest.approx(0.2 / WIDTH * 0.4, abs=0.02)
    assert test.depth.lines == 0 and test.seams is None
    assert verdicts(test) == {
        "leak_path": "fail", "printed_depth": "fail", "layer_height": "pass"
    }  # fmt: skip
    (leak,) = test.leaks
    assert leak.place[2] == pytest.approx(2.3) and CAVITY - 0.3 < leak.place[0] < 2.8


def test_beads_that_only_touch_are_marginal(profile: PrinterProfile) -> None:
    test = result_of(Box(wall=with_gap(0.0)), profile)
    assert test.verdict == "marginal"
    assert verdicts(test)["leak_path"] == "warn"
    assert len(test.leaks) == 1 and abs(test.leaks[0].place[1]) < 0.1


def test_two_leaks_are_both_told(profile: PrinterProfile) -> None:
    heights = (2.3, 4.3)
    rule = lambda z, number: any(abs(z - at - 0.1) < 0.05 for at in heights)  # noqa: E731
    test = result_of(Box(wall=with_gap(0.2, rule)), profile)
    assert sorted(round(leak.place[2], 1) for leak in test.leaks) == list(heights)


def test_a_wall_of_two_lines_is_too_thin_where_three_are_asked_for(profile: PrinterProfile) -> None:
    test = result_of(Box(lines=2), profile)
    assert test.verdict == "sealed"
    assert verdicts(test)["printed_depth"] == "fail"
    assert test.depth.lines == pytest.approx(Box(lines=2).wall_thickness / 0.4, abs=0.15)


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_too_little_or_too_much_plastic_warns(profile: PrinterProfile, share: float) -> None:
    box = Box()
    test = result_of(box, profile, solid_volume=box.volume / 1.1 / share)
    assert verdicts(test)["printed_material"] == "warn"
    assert test.material.share == pytest.approx(share)


def test_places_are_in_the_parts_coordinates(profile: PrinterProfile) -> None:
    """The box is turned by 17° and tested so; told back, the leak lies where it was."""
    box = Box(wall=with_gap(0.2, lambda z, number: 2.3 < z < 2.5))
    turned = replace(box, angle=17.0)
    back = np.eye(3)
    back[:2, :2] = rotation(17.0).T
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = back, (100.0, 50.0, 7.0)
    shift = matrix[:3, 3]
    plain = np.array(result_of(box, profile).leaks[0].place)
    for transform in (matrix, (back, shift), lambda points: points @ back.T + shift):
        told = result_of(turned, profile, transform=transform).leaks[0].place
        assert np.abs(np.array(told) - plain - shift).max() < 0.5
        assert abs(told[1] - 50.0) < 0.1


def test_skirts_close_nothing(profile: PrinterProfile) -> None:
    """A box around the leaking one would seal it, were it no skirt."""
    leaking, fence = Box(wall=with_gap(0.2, lambda z, number: 2.3 < z < 2.5)).beads, Box().beads
    skirt = replace(fence, kind=np.full(len(fence), SKIRT))
    opening = [Box().opening]
    sealed = leak_test(joined_beads([leaking, fence]), opening, profile, seams=False)
    assert sealed.verdict == "sealed"
    assert (
        leak_test(joined_beads([leaking, skirt]), opening, profile, seams=False).verdict == "leaks"
    )


def test_the_result_is_plain_json(profile: PrinterProfile) -> None:
    record = result_of(Box(), profile, seams=True).to_dict()
    assert json.loads(json.dumps(record))["verdict"] == "sealed"
    assert "view" not in record and record["margin"] > 0
    figures = result_of(Box(), profile, seams=True).figures()
    assert record.items() >= figures.items() and record.keys() - figures == {"rules", "notes"}


def test_the_same_beads_give_the_same_result(profile: PrinterProfile) -> None:
    box = Box(wall=with_gap(0.2), angle=17.0)
    assert result_of(box, profile).to_dict() == result_of(box, profile).to_dict()


def test_a_large_part_is_tested_on_coarser_cells_and_says_so(
    profile: PrinterProfile, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(field, "MOST_CELLS", 300_000)
    test = result_of(Box(), profile)
    assert 0.05 < test.voxel < 0.4 / 3
    assert test.verdict == "sealed"
    assert "cells of" in test.notes[0]


def test_a_part_too_large_for_any_grid_is_refused(
    profile: PrinterProfile, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(field, "MOST_CELLS", 10_000)
    with pytest.raises(PrintersError, match="too large for the leak test"):
        result_of(Box(), profile)


@pytest.mark.parametrize("voxel", [0.0, -0.05, 0.2, float("nan")])
def test_cells_must_tell_lines_apart(profile: PrinterProfile, voxel: float) -> None:
    with pytest.raises(PrintersError, match="voxel is"):
        result_of(Box(), profile, voxel=voxel)


def test_without_an_opening_or_beads_there_is_nothing_to_test(profile: PrinterProfile) -> None:
    box = Box()
    with pytest.raises(PrintersError, match="no opening"):
        leak_test(box.beads, [], profile)
    nothing = box.beads.chosen(np.zeros(len(box.beads), dtype=bool))
    with pytest.raises(PrintersError, match="no beads"):
        leak_test(nothing, [box.opening], profile)


@pytest.mark.parametrize("transform", [np.eye(3), 2 * np.eye(4), np.full((4, 4), np.nan)])
def test_a_transform_must_be_a_rigid_motion(profile: PrinterProfile, transform: np.ndarray) -> None:
    with pytest.raises(PrintersError, match="transform"):
        result_of(Box(), profile, transform=transform)


def test_a_second_mouth_is_plugged_too(profile: PrinterProfile) -> None:
    """The same hole, declared twice, is one hole; a box without it declared leaks through it."""
    box = Box()
    assert (
        leak_test(box.beads, [box.opening, box.opening], profile, seams=False).verdict == "sealed"
    )
    low = Opening("other", (0.0, 0.0, 30.0), (0.0, 0.0, 1.0), 0.5)
    with pytest.raises(PrintersError, match="other"):
        leak_test(box.beads, [box.opening, low], profile, seams=False)
