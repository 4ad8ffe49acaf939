"""Reports as PNG and PDF: real files of the size and pages that are said, from the same records."""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from functools import cache
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from fakes import fake_report
from numpy.typing import NDArray
from report_findings import design_of, findings, made_up
from shapes_to_show import block

from bellows_design.approval import Reason, Verdict
from bellows_design.errors import DesignError
from bellows_design.reports.page.findings import Findings
from bellows_design.reports.page.pictures import contact_sheet, pages
from bellows_design.reports.page.pictures.rendering import Look, rendered, scale_of
from bellows_design.web.scene import Field, Surface
from printers import RuleResult

WHITE = 250
LOOK = Look("height", size=(160, 120))


def raised(values: Any = None, **scale: Any) -> Surface:
    """A block 20 mm × 10 mm × 10 mm, its height as colours."""
    points, triangles = block(20, 10, 10)
    points -= [10, 5, 5]
    heights = points[:, 2] if values is None else values
    return Surface("block", triangles, points, (Field("height", "mm", heights, **scale),))


def ink(pixels: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Where something is drawn."""
    return np.asarray((pixels[:, :, :3] < WHITE).any(axis=2))


def colour(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Mean of what is drawn."""
    return np.asarray(pixels[ink(pixels)][:, :3].mean(axis=0))


def test_a_rendering_has_its_size_and_shows_the_surface_in_the_middle() -> None:
    pixels = rendered(raised(), LOOK)
    assert pixels.shape == (120, 160, 3)
    drawn = np.argwhere(ink(pixels))
    assert 0.1 < len(drawn) / (120 * 160) < 0.95
    assert drawn.mean(axis=0) == pytest.approx([60, 80], abs=12)


@pytest.mark.parametrize("sides", [(20, 10, 10), (10, 10, 40), (60, 2, 2), (20, 20, 20)])
@pytest.mark.parametrize("cut", [False, True])
def test_a_rendering_fills_its_picture_and_cuts_nothing_off(
    sides: tuple[float, float, float], cut: bool
) -> None:
    points, triangles = block(*sides)
    points -= np.array(sides) / 2
    surface = Surface("block", triangles, points, (Field("height", "mm", points[:, 2]),))
    drawn = np.argwhere(ink(rendered(surface, replace(LOOK, cut=cut))))
    assert (drawn.min(axis=0) > 0).all() and (drawn.max(axis=0) < (119, 159)).all()
    assert (np.ptp(drawn, axis=0) / (120, 160)).max() > 0.7


def test_colours_are_about_those_of_their_bar() -> None:
    """Else light and shade would be read as values."""
    from matplotlib import colormaps

    seen = colour(rendered(raised(np.full(8, 5.0), low=0.0, high=10.0), LOOK))
    bar = 255 * np.array(colormaps["viridis"](0.5)[:3])
    assert np.abs(seen - bar).max() < 60


def test_drawing_without_a_screen_prints_nothing(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    rendered(raised(), LOOK)
    assert capfd.readouterr() == ("", "")


def test_a_cut_takes_the_half_in_front_away() -> None:
    """From the front, the inner side of the far wall is seen, whose values are other ones."""
    far = np.where(block(20, 10, 10)[0][:, 1] > 5, 1.0, 0.0)
    whole = rendered(raised(far), Look("height", size=(160, 120)))
    cut = rendered(raised(far), Look("height", cut=True, size=(160, 120)))
    yellow = [each[0] + each[1] - each[2] for each in (colour(cut), colour(whole))]
    assert yellow[0] > yellow[1] + 30


def test_a_frame_is_drawn_where_its_points_are() -> None:
    still = raised()
    moved = np.stack([still.positions, still.positions * [1, 1, 0.2]])
    surface = Surface("block", still.triangles, moved, still.fields)
    first, last = (rendered(surface, Look("height", frame, size=(160, 120))) for frame in (0, 1))
    assert ink(last).sum() < 0.8 * ink(first).sum()


def test_colours_have_the_ends_of_the_field_or_of_its_values() -> None:
    values = np.array([2.0, 4, np.nan, 3, 3, 3, 3, 3])
    assert scale_of(Field("height", "mm", values)) == (2.0, 4.0)
    assert scale_of(Field("height", "mm", values, low=0.0, high=9.0)) == (0.0, 9.0)


def png(found: Findings) -> NDArray[np.uint8]:
    """The contact sheet, read by another library than wrote it."""
    from PIL import Image

    content = contact_sheet.contact_sheet(found)
    assert content.startswith(b"\x89PNG")
    return np.asarray(Image.open(BytesIO(content)).convert("RGB"))


def test_a_contact_sheet_is_a_picture_of_its_size_with_all_its_parts() -> None:
    pixels = png(findings())
    (width, height), dots = contact_sheet.SIZE, contact_sheet.DOTS
    assert pixels.shape == (round(height * dots), round(width * dots), 3)
    rows = np.array_split(pixels[pixels.shape[0] // 8 :], 2)
    parts = [part for row in rows for part in np.array_split(row, 3, axis=1)]
    assert [part for part in parts if ink(part).mean() < 0.01] == []


def test_a_contact_sheet_of_a_design_that_was_never_evaluated_can_be_made() -> None:
    why = "the design was refused before it was evaluated"
    reason = Reason("printability", "leak_test", "not run", "pass", "", "There is no slicer.")
    found = findings(evaluation=None, verdict=Verdict((reason,)), deformed=why, sensitivities=why)
    assert ink(png(found)).any()


@cache
def usual_pdf() -> bytes:
    """The report on made-up findings."""
    return pages.as_pdf(findings())


def page_count(content: bytes) -> int:
    """Pages of a PDF."""
    return len(re.findall(rb"/Type /Page\b", content))


@pytest.mark.thorough
def test_a_pdf_has_pages_of_a4_that_are_counted() -> None:
    content = usual_pdf()
    assert content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")
    boxes = set(re.findall(rb"/MediaBox \[ ?([^\]]+?) ?\]", content))
    assert len(boxes) == 1
    assert [float(each) for each in boxes.pop().split()] == pytest.approx([0, 0, 595, 842], abs=1)
    assert 4 <= page_count(content) <= 12


@pytest.mark.thorough
def test_a_pdf_grows_by_pages_with_what_is_said() -> None:
    message = "A sentence of the rule that is long enough for some lines. " * 12
    rules = [RuleResult(f"rule_{n}", "warn", 1.0, 0.0, "mm", message, "there") for n in range(12)]
    short = page_count(usual_pdf())
    long = page_count(pages.as_pdf(findings(report=fake_report(*rules))))
    assert long > short


@pytest.mark.thorough
def test_dollar_signs_are_no_formulas() -> None:
    design = design_of().model_copy(update={"description": r"costs $\frac{1}{2$ and {more} %"})
    found = findings(design, made_up(design))
    assert pages.as_pdf(found).startswith(b"%PDF-")
    assert ink(png(found)).any()


@pytest.mark.parametrize("make", [contact_sheet.contact_sheet, pages.as_pdf])
@pytest.mark.parametrize("library", ["pyvista", "matplotlib"])
def test_without_a_library_one_sentence_says_so(
    make: Any, library: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    from importlib import util

    from bellows_design.reports.page.pictures import libraries

    monkeypatch.setitem(sys.modules, library, None)
    find = util.find_spec
    monkeypatch.setattr(
        libraries, "find_spec", lambda name: None if name == library else find(name)
    )
    with pytest.raises(DesignError) as told:
        make(findings())
    assert str(told.value) == (
        f"--png and --pdf need {library}, of the extra “pictures”: pip install -e '.[pictures]'."
    )


def test_a_machine_that_cannot_draw_is_told_so(monkeypatch: pytest.MonkeyPatch) -> None:
    import pyvista

    def fails(*_: Any, **__: Any) -> None:
        raise RuntimeError("bad X server connection")

    monkeypatch.setattr(pyvista, "Plotter", fails)
    with pytest.raises(DesignError, match=r"PyVista cannot draw .*: bad X server connection\.$"):
        rendered(raised(), LOOK)


def test_marks_are_written_towards_the_middle_of_their_chart() -> None:
    from matplotlib.figure import Figure

    from bellows_design.reports.page.curves.chart import Chart
    from bellows_design.reports.page.pictures.drawn import draw
    from bellows_design.web.charts import Line, Mark

    x = np.array([0.0, 1.0, 2.0])
    axes = Figure().subplots()
    draw(axes, Chart("", "", "", (Line("line", x, x),), marks=(Mark(0, 0, "a"), Mark(2, 2, "b"))))
    assert {text.get_text(): text.get_ha() for text in axes.texts} == {"a": "left", "b": "right"}
