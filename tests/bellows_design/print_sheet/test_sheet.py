"""The sheet's figures are those of design, profile and evaluation; its forms are valid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from fakes import FakeEstimate, FakeEvaluation

from bellows_design import load_design, with_overrides
from bellows_design.analysis.evaluation import MeshReading, MeshSize
from bellows_design.analysis.whole_actuator import Reading
from bellows_design.design.design import Design
from bellows_design.leak_test.record import Unavailable
from bellows_design.pipeline import Outcome, examine
from bellows_design.print_sheet import sheet_files
from bellows_design.print_sheet.air_loss import hole_of_loss
from bellows_design.print_sheet.blocks import Heading, Paragraph, Steps, Table
from bellows_design.print_sheet.figures import ALLOWED_LOSS, HOLD_SECONDS, Figures, figures_of
from bellows_design.print_sheet.html import as_html
from bellows_design.print_sheet.markdown import as_markdown
from bellows_design.print_sheet.remedies import remedies
from printers import load_profile

VOID = {"meta"}
"""Elements of HTML without an end."""


class Checked(HTMLParser):
    """Raises ``AssertionError`` unless every element is closed by its own end."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.open += [] if tag in VOID else [tag]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def text_of(html: str) -> str:
    """What a reader of valid HTML reads."""
    parser = Checked()
    parser.feed(html)
    parser.close()
    assert parser.open == []
    return "".join(parser.text)


def state(pressure: float, angle: float) -> Reading:
    return Reading(pressure, angle, 1.0, 1000 + 5000 * abs(pressure))


def evaluation(design: Design, angle: float = 300.0, **changes: Any) -> FakeEvaluation:
    """Made-up results at the design's pressure, with a path of three states on the way."""
    pressure = design.load.pressure
    path = tuple(state(share * pressure, share * angle) for share in (0, 0.1, 0.45, 1))
    meshes = tuple(
        MeshReading(MeshSize(1, 1, 1), state(pressure, value)) for value in (0.98 * angle, angle)
    )
    found = FakeEvaluation(
        design=design, path=path, meshes=meshes, pressure_mpa=pressure, bending_angle_deg=angle
    )
    return replace(found, **changes)


@pytest.fixture
def examined(stub_stages: Callable[..., None]) -> Callable[..., Outcome]:
    """The outcome for a design with a made-up evaluation."""

    def examined(design: Design, angle: float = 300.0, **changes: Any) -> Outcome:
        stub_stages(evaluation(design, angle, **changes))
        return examine(design, leak_tester=Unavailable("there is none"))

    return examined


def figures(found: Outcome) -> Figures:
    assert found.evaluation is not None
    return figures_of(found, found.evaluation)


def sheet_text(found: Outcome) -> str:
    return text_of(sheet_files(found)[f"{found.design.name}_sheet.html"].decode())


def test_angles_are_those_of_the_evaluation_with_its_error(
    examined: Callable[..., Outcome],
) -> None:
    found = figures(examined(load_design("finger"), 321.0))
    between, end = found.angles
    assert (end.pressure, end.angle, end.error) == (0.1, 321.0, pytest.approx(3.21))
    assert (between.pressure, between.angle) == (pytest.approx(0.045), pytest.approx(0.45 * 321))
    assert between.error == pytest.approx(0.45 * 321 * (0.01 + 0.02))  # and the coarse mesh's 2 %


def test_without_an_estimate_or_a_path_nothing_is_made_up(
    examined: Callable[..., Outcome],
) -> None:
    found = figures(
        examined(
            load_design("finger"), path=(), error_estimate=FakeEstimate(bending_angle_percent=None)
        )
    )
    assert [each.error for each in found.angles] == [None]
    assert found.hole is None and found.volume_at_rest is None
    assert "not estimated" in sheet_text(
        examined(load_design("finger"), error_estimate=FakeEstimate(bending_angle_percent=None))
    )


def test_plastic_is_the_parts_volume_times_the_flow(examined: Callable[..., Outcome]) -> None:
    found = figures(examined(load_design("finger")))
    profile = load_profile("prusa_i3")
    assert found.plastic == pytest.approx(1000 * profile.slicer.flow / 100)  # of the 10 mm cube
    assert found.mass == pytest.approx(found.plastic * profile.filament.density / 1000)
    assert found.filament_length == pytest.approx(found.plastic / 2.405 / 1000, rel=1e-3)
    line = profile.line_width * profile.layer_height * profile.slicer.print_speed
    assert found.least_hours == pytest.approx(1000 / line / 3600)


def test_walls_are_counted_in_lines_and_layers(examined: Callable[..., Outcome]) -> None:
    text = sheet_text(examined(load_design("finger")))
    assert "bubble_thickness 1.2 mm = 3 lines" in text
    assert "bottom wall at the indent 0.8 mm = 8 layers" in text


@pytest.mark.parametrize("angle", [111.1, 222.2])
@pytest.mark.parametrize("pressure", [0.05, 0.08])
def test_the_sheet_shows_the_figures(
    pressure: float, angle: float, examined: Callable[..., Outcome]
) -> None:
    design = with_overrides(load_design("finger"), [f"load.pressure={pressure}"])
    text = sheet_text(examined(design, angle, max_von_mises_mpa=2.34, cavity_volume_mm3=7654.0))
    for figure in (
        f"{angle:.1f}°", f"± {angle / 100:.1f}°", f"{pressure:.3g} MPa ({10 * pressure:.3g} bar)",
        "2.34 MPa (± 1.0 %) of 4 MPa", "7.7 cm³", design.digest, "there is none",
    ):  # fmt: skip
        assert figure in text, figure


def test_the_hole_leads_through_the_thinnest_wall(examined: Callable[..., Outcome]) -> None:
    """0.8 mm at the indent, of walls of 0.8, 1.2 and 1.6 mm."""
    found = figures(examined(load_design("finger")))
    path = evaluation(load_design("finger")).path
    assert found.hole == hole_of_loss(path, 0.1, ALLOWED_LOSS, HOLD_SECONDS, 0.8)
    assert f"{1000 * (found.hole or 0):.0f} µm through the thinnest wall, 0.8 mm" in sheet_text(
        examined(load_design("finger"))
    )


def test_losses_of_others_are_stated_as_they_were_measured(
    examined: Callable[..., Outcome],
) -> None:
    text = sheet_text(examined(load_design("finger")))
    assert "lost 10 of 220, 6 of 160 and 6 of 50 kPa in 120 s" in text


@pytest.mark.parametrize("supports", [True, False])
def test_sheet_and_settings_say_the_same_of_supports(
    supports: bool, examined: Callable[..., Outcome]
) -> None:
    from bellows_design.export.companions import prusa_text

    profile = load_profile("prusa_i3")
    slicer = profile.slicer.model_copy(update={"supports": supports})
    own = profile.model_copy(update={"slicer": slicer})
    found = examined(load_design("finger").model_copy(update={"printer": own}))
    text, part = sheet_text(found), replace(found.part, profile=own)
    assert ("no supports" not in text and "with supports" in text) == supports
    assert f"support_material = {int(supports)}\n" in prusa_text(part)


def test_a_vacuum_is_tested_as_one(examined: Callable[..., Outcome]) -> None:
    design = with_overrides(load_design("finger"), ["load.pressure=-0.05"])
    text = sheet_text(examined(design, -60.0))
    assert "0.05 MPa (0.5 bar) vacuum" in text and "Evacuate slowly" in text
    assert "Pump up" not in text


def test_markdown_and_html_say_the_same(examined: Callable[..., Outcome]) -> None:
    files = sheet_files(examined(load_design("finger")))
    signs = str.maketrans("", "", "\\|#*- \n")
    html = text_of(files["finger_sheet.html"].decode()).partition("}\n\n")[2]
    markdown = files["finger_sheet.md"].decode()
    plain = "".join(line.partition(". ")[2] if line[:1].isdigit() else line
                    for line in markdown.splitlines())  # fmt: skip
    assert plain.translate(signs) == html.translate(signs)


NASTY = '<script>alert("1")</script> & | * _a_ [x](y) `c`'


def test_any_text_is_escaped() -> None:
    blocks = (
        Heading(NASTY, 1), Paragraph(NASTY), Table((NASTY,), ((NASTY,),)), Steps(((NASTY, NASTY),))
    )  # fmt: skip
    html = as_html(NASTY, blocks)
    assert text_of(html).count(NASTY) == 7 and "<script" not in html
    row = as_markdown(blocks).splitlines()[4]
    assert row.count("|") == 3 and row.count(r"\|") == 1 and r"\<script\>" in row


def test_a_description_is_escaped_in_the_sheet(examined: Callable[..., Outcome]) -> None:
    design = load_design("finger").model_copy(update={"description": NASTY})
    html = sheet_files(examined(design))["finger_sheet.html"].decode()
    assert NASTY in text_of(html) and "<script" not in html


def test_the_page_needs_no_other(examined: Callable[..., Outcome]) -> None:
    html = sheet_files(examined(load_design("finger")))["finger_sheet.html"].decode()
    assert not [word for word in ("src=", "href=", "@import", "url(", "http:") if word in html]


def test_remedies_begin_with_what_costs_least_and_follow_the_profile() -> None:
    profile = load_profile("prusa_i3")
    thick = profile.model_copy(update={"layer_height": 0.2})
    flowing = profile.slicer.model_copy(update={"flow": 125.0, "seam": "aligned"})
    plain = [what for what, _ in remedies(profile)]
    assert "Look where" in plain[0] and "Dry" in plain[1] and "design" in plain[-1]
    assert any("if the filament's maker allows it" in each for each in plain)
    assert f"flow from {profile.slicer.flow:g} to" in " ".join(plain)
    assert "Lower the layers from 0.2 to 0.1 mm." in [what for what, _ in remedies(thick)]
    other = " ".join(what for what, _ in remedies(profile.model_copy(update={"slicer": flowing})))
    assert "Raise the flow" not in other and "seam from aligned to random" in other


def test_a_design_that_was_not_evaluated_has_no_sheet(examined: Callable[..., Outcome]) -> None:
    assert sheet_files(replace(examined(load_design("finger")), evaluation=None)) == {}


def test_the_sheets_are_among_the_files(examined: Callable[..., Outcome], tmp_path: Path) -> None:
    from bellows_design.export.statements import files_of

    assert {"finger_sheet.md", "finger_sheet.html"} < set(files_of(examined(load_design("finger"))))
