"""The view of layers in a real browser."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from browser import NARROW, hard_to_read, opened, wider_than_the_window
from shapes_to_show import two_layers

from bellows_design.web.element import viewer_script
from bellows_design.web.layers import layers_element
from bellows_design.web.style import page_style

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser

FIRST = "Bellows.of(document.querySelector('.bellows-view'))"


@contextmanager
def shown(browser: Browser, folder: Path, **window: Any) -> Iterator[Page]:
    """A page with two layers, the first one shown; nothing may go wrong on it."""
    file = folder / "page.html"
    head = f"<!DOCTYPE html><html lang=en><meta charset=utf-8><style>{page_style()}</style>"
    body = f"<div class=page>{layers_element(two_layers(), layer=0)}</div>{viewer_script()}"
    file.write_text(f"{head}{body}</html>", "utf-8")
    with opened(browser, file, **window) as (page, seen):
        page.wait_for_selector(".bellows-view[data-ready]")
        yield page
        assert seen.all == []


def state(page: Page) -> dict[str, Any]:
    """What the view says that it shows, once that is drawn."""
    frames(page)
    found: dict[str, Any] = page.evaluate(f"async () => (await {FIRST}).state()")
    return found


def frames(page: Page) -> None:
    """Until the browser has drawn twice, so that changed sizes are known."""
    page.evaluate("new Promise((f) => requestAnimationFrame(() => requestAnimationFrame(f)))")


def pixels(page: Page) -> np.ndarray:
    """The canvas as it is drawn. *Shape:* `(height, width, 4)`."""
    import base64
    from io import BytesIO

    from PIL import Image

    draw = f"async () => {{ const v = await {FIRST}; v.draw(); return v.canvas.toDataURL(); }}"
    picture = base64.b64decode(page.evaluate(draw).split(",")[1])
    return np.asarray(Image.open(BytesIO(picture)).convert("RGBA"), dtype=int)


def test_beads_come_back_with_places_widths_and_kinds(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path) as page:
        first = state(page)
        page.get_by_label("Layer", exact=True).fill("1")
        second = state(page)
    assert (first["layers"], first["beads"], first["kinds"]) == (2, 4, ["external perimeter"])
    assert first["first"]["places"] == pytest.approx([100, 50, 110, 50], abs=0.005)
    assert first["first"]["width"] == pytest.approx(0.42)
    assert (second["layer"], second["beads"], second["top_mm"]) == (1, 2, 0.35)
    assert second["kinds"] == ["solid infill"] and second["marks"] == ["leak, 0.15 mm <wide>"]


def test_beads_are_drawn_at_their_width_where_they_lie(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path) as page:
        picture, about = pixels(page), state(page)
    scale = about["pixels_per_mm"]
    assert about["centre"] == pytest.approx([105, 54])
    height, width, _ = picture.shape
    column = picture[:, width // 2, 3] > 127
    drawn = np.flatnonzero(column)
    lower = drawn[drawn > height / 2]
    assert lower.mean() == pytest.approx(height / 2 + 4 * scale, abs=1.5)
    assert len(lower) == pytest.approx(0.42 * scale, abs=2)


def test_the_scale_bar_is_as_long_as_it_says(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path) as page:
        bar = page.locator(".scale-bar i").bounding_box()
        about = state(page)
    assert bar is not None
    assert bar["width"] == pytest.approx(about["scale_bar_mm"] * about["pixels_per_mm"], abs=1)


def test_a_mark_s_button_leads_to_its_layer_and_place(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path) as page:
        before = state(page)
        page.get_by_role("button", name="leak, 0.15 mm <wide>").click()
        after = state(page)
        page.get_by_role("button", name="Whole layer").click()
        whole = state(page)
    assert (before["layer"], after["layer"]) == (0, 1)
    assert after["centre"] == [105, 54]
    assert after["pixels_per_mm"] >= before["pixels_per_mm"] == whole["pixels_per_mm"]


@pytest.mark.parametrize("mark", [False, True])
def test_a_view_that_was_shown_while_it_had_no_size_is_fitted_once_it_has_one(
    browser: Browser, tmp_path: Path, mark: bool
) -> None:
    go = "v.goTo(v.data.marks[0])" if mark else "v.resetView()"
    hidden = "document.querySelector('.page').hidden"
    with shown(browser, tmp_path) as page:
        page.evaluate(f"async () => {{ const v = await {FIRST}; {go}; }}")
        wanted = state(page)
        page.evaluate(f"{hidden} = true")
        frames(page)
        page.evaluate(f"async () => {{ const v = await {FIRST}; {go}; }}")
        page.evaluate(f"{hidden} = false")
        frames(page)
        found = state(page)
        drawn = pixels(page)[:, :, 3] > 127
    assert found == wanted
    assert found["scale_bar_mm"] <= 10
    assert drawn.any()


def test_where_the_reader_has_gone_stays_when_the_window_changes(
    browser: Browser, tmp_path: Path
) -> None:
    with shown(browser, tmp_path) as page:
        page.keyboard.press("Tab")
        page.keyboard.press("+")
        before = state(page)
        page.set_viewport_size({"width": 700, "height": 900})
        frames(page)
        after = state(page)
    assert (after["centre"], after["pixels_per_mm"]) == (before["centre"], before["pixels_per_mm"])


def test_the_whole_layer_stays_whole_when_the_window_changes(
    browser: Browser, tmp_path: Path
) -> None:
    with shown(browser, tmp_path) as page:
        before = state(page)
        page.set_viewport_size({"width": 300, "height": 900})
        frames(page)
        after = state(page)
    assert after["pixels_per_mm"] < before["pixels_per_mm"]


def test_keys_change_layer_move_and_zoom(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path) as page:
        start = state(page)
        page.keyboard.press("Tab")
        for key in ("]", "ArrowRight", "ArrowUp", "+"):
            page.keyboard.press(key)
        moved = state(page)
        page.keyboard.press("[")
        page.keyboard.press("r")
        back = state(page)
    assert moved["layer"] == 1 and moved["centre"][0] > start["centre"][0]
    assert moved["centre"][1] > start["centre"][1]
    assert moved["pixels_per_mm"] == pytest.approx(1.25 * start["pixels_per_mm"])
    assert back == start


def test_the_mouse_drags_the_picture(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path) as page:
        before = state(page)
        page.mouse.move(500, 250)
        page.mouse.down()
        page.mouse.move(560, 210, steps=3)
        page.mouse.up()
        page.mouse.move(700, 300)
        after = state(page)
    scale = before["pixels_per_mm"]
    moved = np.subtract(before["centre"], after["centre"]) * scale
    assert moved == pytest.approx([60, 40], abs=1)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_it_fits_and_is_readable(browser: Browser, tmp_path: Path, theme: str) -> None:
    with shown(browser, tmp_path, width=NARROW, theme=theme) as page:
        assert wider_than_the_window(page) == 0
        assert hard_to_read(page) == []
