"""A report shows the values of its records with their errors, escapes all text, loads nothing."""

from __future__ import annotations

import re
from typing import Any

import pytest
from fakes import FakeEstimate, FakeStrain, fake_report
from report_findings import design_of, findings, made_up, page_text, part_of, read

from bellows_design.approval import NotJudged, Reason, Verdict
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.force.air import Air
from bellows_design.force.result import ForceCurve, ForceError, ForceReading, SceneResult, Seconds
from bellows_design.leak_test.record import LeakOutcome, LeakTest
from bellows_design.neighbours.sensitivities import (
    ANGLE,
    STRESS,
    VOLUME,
    Sensitivities,
    Sensitivity,
)
from bellows_design.print_sheet.figures import figures_of
from bellows_design.reports.page.make import LARGEST, page_of, report_html
from printers import RuleResult

HOSTILE = '</script><img src=x onerror="alert(1)">&"\''


def test_the_head_states_verdict_figures_and_their_errors() -> None:
    found = findings(evaluation=made_up(design_of(), error_estimate=FakeEstimate(10.0, 5.0)))
    text = read(found).text
    assert "Approved" in text and found.outcome.design.digest in text
    assert "60.0° ± 3.0° (5 %)" in text
    assert "3.00 MPa ± 0.30 MPa (10 %) 75 % of the limit, 4 MPa" in text
    printed = figures_of(found.outcome, found.outcome.evaluation)  # type: ignore[arg-type]
    assert f"{printed.mass:.1f} g" in text and f"over {printed.least_hours:.1f} h" in text


@pytest.mark.parametrize(
    ("angle", "said"),
    [(60.0, "turned to the angle of the finest"), (61.0, "Shapes, angles and colours are those")],
)
def test_the_shape_says_whose_angle_it_has(angle: float, said: str) -> None:
    found = findings(evaluation=made_up(design_of(), bending_angle_deg=angle))
    assert said in read(found).text


def test_without_an_estimate_none_is_shown() -> None:
    estimate = FakeEstimate(None, None)
    text = read(findings(evaluation=made_up(design_of(), error_estimate=estimate))).text
    assert "error not estimated" in text and "±" not in text.partition("design digest")[0]
    assert "Without a band" in text and "The band is" not in text


def test_a_refused_design_names_all_reasons_and_what_is_not_judged() -> None:
    reasons = tuple(
        Reason("stress", f"rule_{n}", 5.0, 4.0, "MPa", f"Reason number {n}.") for n in range(3)
    )
    verdict = Verdict(reasons, ("A warning.",), (NotJudged("stability", "nobody can tell"),))
    text = read(findings(verdict=verdict)).text
    assert "Refused" in text and "3 reasons against it" in text
    assert all(f"Reason number {n}." in text for n in range(3))
    assert "A warning." in text and "Not judged: stability , as nobody can tell" in text


def test_a_design_that_was_refused_before_its_evaluation_has_a_report() -> None:
    reason = Reason("printability", "leak_test", "not run", "pass", "", "There is no slicer.")
    why = "the design was refused before it was evaluated"
    found = findings(evaluation=None, verdict=Verdict((reason,)), deformed=why, sensitivities=why)
    text = read(found).text
    assert "There is no slicer." in text and "not computed" in text
    assert f"There is no deformed shape: {why}." in text
    assert "Nothing was computed." in text


def test_hostile_names_and_descriptions_are_text() -> None:
    design = design_of().model_copy(update={"description": HOSTILE})
    material = design.material.model_copy(update={"name": HOSTILE[:60], "source": HOSTILE})
    design = design.model_copy(update={"material": material})
    rule = RuleResult("overhang", "warn", 1.0, 0.0, "mm", HOSTILE, HOSTILE)
    found = findings(design, made_up(design, warnings=(HOSTILE,)), fake_report(rule))
    html = report_html(found)
    page = page_text(html)
    assert HOSTILE.replace(" ", "") in page.text.replace(" ", "")
    assert not [tag for tag, attributes in page.elements if "onerror" in attributes or tag == "img"]
    assert b"<img" not in html.replace(b"data:image", b"")[: html.index(b"<script>")]


def test_nothing_is_loaded_from_anywhere() -> None:
    page = read(findings())
    for tag, attributes in page.elements:
        for name in ("src", "href", "data", "action", "poster", "srcset"):
            value = attributes.get(name)
            assert value is None or value.startswith("#"), (tag, name, value)
    policy = next(each["content"] for tag, each in page.elements if "http-equiv" in each)
    assert policy is not None and policy.startswith("default-src 'none'")


def test_styles_load_nothing_either() -> None:
    html = report_html(findings()).decode()
    styles = " ".join(re.findall(r"<style>(.*?)</style>", html, re.DOTALL))
    assert "@import" not in styles and "url(" not in styles


def test_a_report_is_not_larger_than_it_may_be() -> None:
    assert 100_000 < len(report_html(findings())) < LARGEST


def test_every_section_has_its_place_in_the_contents() -> None:
    page = read(findings())
    keys = [each["id"] for tag, each in page.elements if tag == "section"]
    links = [each["href"] for tag, each in page.elements if tag == "a"]
    assert len(keys) == 12 and set(links) >= {f"#{key}" for key in keys}


@pytest.mark.parametrize("pressure", [0.1, -0.05])
def test_curves_end_where_the_path_does(pressure: float) -> None:
    design = design_of("finger", f"load.pressure={pressure}")
    found = findings(design)
    text = read(found).text
    assert ("0.05 MPa vacuum" in text) == (pressure < 0)
    chart = _charts(found)["Bending angle against pressure"]
    assert chart.lines[0].x[-1] == pressure and chart.lines[0].y[-1] == 60.0


def test_bands_are_the_errors_widened_by_the_coarse_mesh() -> None:
    chart = _charts(findings())["Bending angle against pressure"]
    line = chart.lines[0]
    assert line.high[-1] - line.y[-1] == pytest.approx(0.01 * 60.0)
    coarse = abs((60 + 1 / 100) - (60 + 1 / 400)) / (60 + 1 / 400)
    assert line.high[2] - line.y[2] == pytest.approx((0.01 + coarse) * 30.0)


def test_limit_point_and_touch_are_marked() -> None:
    found = made_up(
        design_of(), converged=False, pressure_mpa=0.05, limit_pressure_mpa=0.052,
        touch_pressure_mpa=0.05, message="the load turns at 0.052 MPa",
    )  # fmt: skip
    charts = _charts(findings(evaluation=found))
    marks = {each.text: each.value for each in charts["Bending angle against pressure"].limits}
    assert marks == {"walls first touch": 0.05, "limit point": 0.052, "design pressure": 0.1}
    text = read(findings(evaluation=found)).text
    assert "The load turns at 0.052 MPa." in text and "0.05 MPa of 0.1 MPa asked" in text


def test_the_limit_of_the_stress_is_drawn() -> None:
    design = design_of("finger", "limits.max_von_mises=3.5")
    limits = _charts(findings(design))["Highest von Mises stress against pressure"].limits
    assert [(each.value, each.text) for each in limits] == [
        (3.5, "limit 3.5 MPa"),
        (4.0, "yield strength 4 MPa"),
    ]


def test_every_rule_has_its_row_and_what_did_not_pass_its_sentence() -> None:
    rule = RuleResult(
        "overhang", "warn", 53.25, 0.0, "mm²", "(26.3, 0.9, 4.3) mm", "they hang free",
        uncertainty=7.0, margin=-2.0, points=((26.3, 0.9, 4.3),),
    )  # fmt: skip
    found = findings(report=fake_report(rule))
    text = read(found).text
    assert "53.25 ± 7 mm²" in text and "-2 mm²" in text and "overhang: They hang free." in text
    drawings = [each for each in _pictures(found) if each.title.startswith("Places")]
    assert len(drawings) == 2
    assert all([text.text for text in each.texts] == ["1"] for each in drawings)


def test_a_leak_test_that_was_not_run_says_why() -> None:
    assert "It was not run: there is no slicer here." in read(findings()).text


def test_a_leak_test_shows_its_rules() -> None:
    rules = tuple(
        RuleResult(name, "pass", 0.91, 0.95, "lines", "whole part", f"{name} holds")
        for name in ("leak_path", "printed_depth")
    )
    outcome = LeakOutcome("PrusaSlicer", "2.9", "ab" * 32, rules, {"notes": ["one note"]}, 12.3)
    text = read(findings(leak_test=LeakTest("required", outcome))).text
    assert "PrusaSlicer 2.9" in text and "12.3 s" in text
    assert "leak_path holds." in text and "One note." in text


def test_scenes_show_their_force_with_its_error_and_failures_why() -> None:
    scenes = (SceneResult("blocked", _curve()), SceneResult("wall", failure="it is not reached"))
    found = findings(further=scenes)
    text = read(found).text
    assert "Scene blocked" in text and "2 N (± 6 % estimated)" in text
    assert "Scene wall" in text and "It is not reached." in text
    line = _charts(found)["Force in the scene blocked"].lines[0]
    assert (list(line.x), list(line.y)) == ([0.05, 0.1], [1.0, 2.0])
    assert list(line.high) == pytest.approx([1.06, 2.12])


def test_without_scenes_the_report_says_how_to_ask_for_one() -> None:
    assert "bellows report --scene NAME" in read(findings()).text


def test_elasticities_are_bars_and_sentences() -> None:
    found = findings(sensitivities=_sensitivities())
    text = read(found).text
    assert "bubble_width + 1 %: angle +1.20 %, highest stress +1.02 %." in text
    bars = _charts(found)["Change of the bending angle for + 1 % of each number"].bars
    assert [(bar.name, bar.value) for bar in bars] == [("bubble_width", 1.2), ("length", -0.3)]


def test_without_sensitivities_the_reason_is_given() -> None:
    text = read(findings(sensitivities="the pressure was not reached")).text
    assert "No sensitivities: the pressure was not reached." in text


def test_the_material_curve_has_its_range_and_the_strains_reached() -> None:
    design = design_of()
    material = design.material.model_copy(update={"valid_strain": (-0.3, 2.0)})
    design = design.model_copy(update={"material": material})
    evaluation = made_up(design, strain=FakeStrain(valid=(-0.3, 2.0)))
    chart = _charts(findings(design, evaluation))[f"Nominal stress of {material.name} over strain"]
    assert chart.shaded == ((-30.0, 200.0),)
    assert [mark.x for mark in chart.marks] == pytest.approx([-20.0, 30.0])
    from solver.material.homogeneous import UNIAXIAL, nominal_stress

    wanted = nominal_stress(UNIAXIAL, [0.8, 1.3], material.law_constants())  # type: ignore[arg-type]
    assert [mark.y for mark in chart.marks] == pytest.approx(wanted.tolist())


def test_a_material_without_a_tested_range_says_so() -> None:
    found = findings()
    assert "does not state the range of its tests" in read(found).text
    name = found.outcome.design.material.name
    assert _charts(found)[f"Nominal stress of {name} over strain"].shaded == ()


def test_meshes_seconds_and_versions_are_told() -> None:
    from bellows_design.versions import versions

    text = read(findings()).text
    assert "What each mesh says" in text and "2400" in text
    assert all(version in text for version in versions().values())


def test_files_beside_the_report_are_named_with_their_hashes() -> None:
    files = {"finger.stl": {"sha256": "cd" * 32, "bytes": 12345}}
    text = read(findings(files=files)).text
    assert "finger.stl" in text and "12345" in text and "cd" * 32 in text
    assert "without an export" in read(findings()).text


def test_printing_and_testing_are_those_of_the_sheet() -> None:
    text = read(findings()).text
    assert "Proof pressure: 0.1 MPa (1 bar)" in text
    assert "When it leaks: one change at a time" in text


def test_the_deformed_actuator_has_a_frame_for_each_pressure() -> None:
    space = next(each for each in page_of(findings()).sections if each.key == "deformed").blocks[0]
    surface = space.surfaces[0]  # type: ignore[union-attr]
    assert surface.frame_labels == (
        "0 MPa, 0°",
        "0.03333 MPa, 20°",
        "0.06667 MPa, 40°",
        "0.1 MPa, 60°",
    )
    assert surface.fields[0].limit == 4.0 and surface.fields[0].high == 4.0


def test_every_parameter_is_in_the_table() -> None:
    text = read(findings()).text
    design = design_of()
    for name, value in design.bellows:
        assert name in text
        assert value is None or f"{name} {value:g}" in text
    assert "indent.depth 0.4" in text


def _charts(found: Any) -> dict[str, Any]:
    return {each.title: each for each in _pictures(found)}


def _pictures(found: Any) -> list[Any]:
    blocks = [block for section in page_of(found).sections for block in section.blocks]
    return [each.content for block in blocks for each in getattr(block, "pictures", ())]


def _curve() -> ForceCurve:
    def reading(share: float) -> ForceReading:
        return ForceReading(
            0.1 * share, 0.0, 2 * share, (0.0, -2 * share), 3.0, (20.0, 0.0), 5.0, False, True,
            1500.0, 2.0, 5.0, ForceError(interpolation=1.0, mesh=5.0),
            ((0.0, 0.0), (10.0, -1.0), (20.0, 0.0)), ((20.0, 0.0),),
        )  # fmt: skip

    air = Air(1000.0, 1500.0, 0.001, 10.0)
    return ForceCurve(
        design_of(), "blocked", Blocked(), True, "", (reading(0.5), reading(1.0)), (), None, 1.0,
        None, air, (), Seconds(1.0, 0.1),
    )  # fmt: skip


def _sensitivities() -> Sensitivities:
    def row(name: str, angle: float, stress: float) -> Sensitivity:
        values = {ANGLE: angle, STRESS: stress, VOLUME: 0.1}
        return Sensitivity(name, 20.0, "mm", values, values)

    rows = (row("length", -0.3, 0.1), row("bubble_width", 1.2, 1.02))
    responses = {ANGLE: 60.0, STRESS: 3.1, VOLUME: 1500.0}
    return Sensitivities(design_of(), responses, rows, {}, (), (), 1.04, 0.09, 1e-12, (), 3.0)


def test_thickness_colours_are_those_of_the_walls() -> None:
    from numpy import nanmedian

    from bellows_design.reports.page.thickness.surface import thickness_map

    design = design_of()
    found = thickness_map(design, part_of("finger").mesh)
    high = found.positions[:, 2] > 0.6 * design.bellows.bubble_height
    assert nanmedian(found.thickness[high]) == pytest.approx(1.2, abs=0.02)
    assert found.triangles.max() == len(found.positions) - 1
