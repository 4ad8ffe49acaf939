"""Reports in Chromium: no errors, shapes that move, keys that work, narrow and dark."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from browser import NARROW, hard_to_read, opened, wider_than_the_window
from report_findings import design_of, findings, made_up

from bellows_design import load_design
from bellows_design.design.shipped import shipped_designs
from bellows_design.reports.page.make import report_html

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser

MOVING = "Bellows.of(document.querySelector('#deformed .bellows-view'))"

FOLDED = "document.querySelector('details td').checkVisibility()"

ON_PAPER = """() => {
    const view = document.querySelector('#deformed .bellows-view').shadowRoot;
    const paper = view.querySelector('canvas.paper');
    const { data } = paper.getContext('2d').getImageData(0, 0, paper.width, paper.height);
    const corner = [...data.slice(0, 4)];
    return [corner, data.filter((value, at) => value !== corner[at % 4]).length];
}"""
"""The colour of the picture's corner, and how many bytes differ from it."""

CUT_OFF = """where => [...document.querySelectorAll(where)]
    .filter(each => each.scrollWidth > each.clientWidth).length"""
"""How many boxes must be scrolled sideways."""


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("report") / "finger_report.html"
    evaluation = made_up(design_of(), warnings=("A warning that is rather long. " * 4,))
    path.write_bytes(report_html(findings(evaluation=evaluation)))
    return path


def shown(page: Page) -> None:
    """Scroll to the moving shape, and wait until it is there."""
    page.locator("#deformed").scroll_into_view_if_needed()
    page.wait_for_selector("#deformed .bellows-view[data-ready]", timeout=60_000)


def state(page: Page) -> dict[str, Any]:
    found: dict[str, Any] = page.evaluate(f"async () => (await {MOVING}).state()")
    return found


def test_a_report_opens_without_any_error(browser: Browser, report: Path) -> None:
    with opened(browser, report) as (page, seen):
        page.evaluate("Bellows.startAll()")
        shown(page)
        assert page.title() == "finger: report"
        assert seen.all == []


def test_the_slider_moves_the_shape(browser: Browser, report: Path) -> None:
    with opened(browser, report) as (page, seen):
        shown(page)
        before = state(page)
        page.locator("#deformed input[type=range]").first.fill("0")
        after = state(page)
        assert (before["frame"], after["frame"]) == (3, 0)
        assert seen.all == []


def test_keys_move_the_shape_and_reach_every_section(browser: Browser, report: Path) -> None:
    with opened(browser, report) as (page, seen):
        shown(page)
        page.locator("#deformed .bellows-view .stage").focus()
        page.keyboard.press("[")
        assert state(page)["frame"] < 3
        page.locator("nav.contents a").last.focus()
        page.keyboard.press("Enter")
        assert page.evaluate("location.hash") == "#printing"
        assert seen.all == []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_narrow_page_needs_no_scrolling_sideways_and_is_readable(
    browser: Browser, report: Path, theme: Any
) -> None:
    with opened(browser, report, width=NARROW, theme=theme) as (page, seen):
        shown(page)
        assert wider_than_the_window(page) == 0
        assert hard_to_read(page) == []
        assert seen.all == []


def test_narrow_charts_are_seen_whole(browser: Browser, report: Path) -> None:
    with opened(browser, report, width=NARROW) as (page, _):
        assert page.evaluate(CUT_OFF, ".picture:has(> .chart)") == 0


def test_views_that_nobody_scrolled_to_start_too(browser: Browser, report: Path) -> None:
    """Else they would be empty on paper."""
    with opened(browser, report, height=300) as (page, seen):
        page.wait_for_selector("#deformed .bellows-view[data-ready]", timeout=60_000)
        assert page.evaluate("scrollY") == 0
        assert seen.all == []


def test_paper_shows_what_is_folded_and_the_colours_of_legends(
    browser: Browser, report: Path
) -> None:
    """Also without the backgrounds, which browsers leave out unless they are asked for them."""
    with opened(browser, report) as (page, _):
        shown(page)
        assert not page.evaluate(FOLDED)
        page.emulate_media(media="print")
        assert page.evaluate(FOLDED)
        scale = page.locator("#deformed .legend-scale")
        assert scale.evaluate("each => getComputedStyle(each).printColorAdjust") == "exact"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_paper_shows_the_shape_on_white(browser: Browser, report: Path, theme: Any) -> None:
    """A picture stands for the view: its own canvas may be empty in another size."""
    with opened(browser, report, theme=theme) as (page, seen):
        shown(page)
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        corner, different = page.evaluate(ON_PAPER)
        assert corner == [255, 255, 255, 255] and different > 1000
        page.evaluate("dispatchEvent(new Event('afterprint'))")
        assert page.locator("#deformed canvas.paper").count() == 0
        assert seen.all == []


def test_dark_pages_are_dark(browser: Browser, report: Path) -> None:
    with opened(browser, report, theme="dark") as (page, _):
        background = page.evaluate("getComputedStyle(document.body).backgroundColor")
        assert max(map(int, background[4:-1].split(","))) < 60


@pytest.mark.slow
@pytest.mark.parametrize("name", shipped_designs())
def test_the_report_of_every_shipped_design_opens(
    browser: Browser, tmp_path: Path, name: str
) -> None:
    """Whole: examined, with sensitivities, as ``bellows report`` makes it."""
    from bellows_design.pipeline import examine
    from bellows_design.reports.page.findings import findings_of
    from bellows_design.store import Store

    design = load_design(name)
    path = tmp_path / f"{name}_report.html"
    path.write_bytes(report_html(findings_of(examine(design, store=Store.usual()))))
    assert path.stat().st_size < 8_000_000
    with opened(browser, path) as (page, seen):
        page.evaluate("Bellows.startAll()")
        shown(page)
        last = state(page)
        assert last["frame"] == last["frames"] - 1
        assert wider_than_the_window(page) == 0
        assert seen.all == []
