"""The page on the real studio: what it shows is what the solver found."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from browser import opened
from studio_in_browser import moved, running_studio, saved, sliders, wait_for_answer

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design

pytestmark = [pytest.mark.browser, pytest.mark.slow]

LONG_MS = 600_000
"""For solves on a machine that does other things as well."""


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("studio")
    store = {"BELLOWS_CACHE": str(folder / "store")}
    with running_studio("prototype_1", folder / "exports", store) as url:
        yield url


class Heard:
    """What came through the page's websocket."""

    def __init__(self, page: Any) -> None:
        self.messages: list[dict[str, Any]] = []
        page.on("websocket", lambda socket: socket.on("framereceived", self._take))

    def _take(self, frame: str | bytes) -> None:
        if isinstance(frame, str):
            self.messages.append(json.loads(frame))
            return
        length = int.from_bytes(frame[:4], "little")
        self.messages.append(json.loads(frame[4 : 4 + length]))

    def last(self, kind: str) -> dict[str, Any]:
        return [each for each in self.messages if each["type"] == kind][-1]


@contextmanager
def studio_page(browser: Any, address: str, **context: Any) -> Iterator[tuple[Any, Heard]]:
    """The page with the refined answer of the design that was opened."""
    with opened(browser, "about:blank", calm=True, accept_downloads=True, **context) as (
        page,
        seen,
    ):
        heard = Heard(page)
        page.goto(address)
        wait_for_answer(page, milliseconds=LONG_MS)
        yield page, heard
        assert seen.all == []


def _expect_what_was_heard(page: Any, heard: Heard) -> None:
    answer = heard.last("answer")
    assert page.locator("#angle").inner_text() == f"{answer['bending_angle_deg']:.1f}"
    assert int(page.locator("#angle").get_attribute("data-revision")) == answer["revision"]
    assert page.locator("#figures").get_attribute("data-state") == answer["state"]


def _answered(page: Any) -> None:
    page.wait_for_timeout(200)
    page.locator("#figures[data-state=preview], #figures[data-state=refined]").wait_for(
        timeout=LONG_MS
    )


def test_three_sliders_by_mouse_keyboard_and_typing(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (page, heard):
        _expect_what_was_heard(page, heard)
        angles = [heard.last("answer")["bending_angle_deg"]]
        box = page.locator("#p-bubble_height-range").bounding_box()
        page.mouse.click(box["x"] + 0.55 * box["width"], box["y"] + box["height"] / 2)
        for act in (
            lambda: None,
            lambda: page.locator("#p-chamber_length-range").press("ArrowRight"),
            lambda: page.locator("#p-load-pressure-field").fill("0,08"),
        ):
            act()
            page.keyboard.press("Enter")
            _answered(page)
            _expect_what_was_heard(page, heard)
            angles.append(heard.last("answer")["bending_angle_deg"])
        assert len({round(angle, 3) for angle in angles}) == 4
        assert angles[3] < 0.95 * angles[2]  # less pressure bends less


def test_saved_design_is_the_one_that_was_answered(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (page, heard):
        assert Design.from_toml(saved(page)).digest == load_design("prototype_1").digest
        moved(page, "bubble_height", [20.5, 21.0], 300)
        assert Design.from_toml(saved(page)).digest == heard.last("problems")["digest"]
        assert Design.from_toml(saved(page)).bellows.bubble_height == 21.0


def test_undo_and_redo_bring_designs_back(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (page, heard):
        first = heard.last("problems")["digest"]
        moved(page, "bubble_height", [20.5], 300)
        second = heard.last("problems")["digest"]
        page.keyboard.press("Control+z")
        wait_for_answer(page, milliseconds=LONG_MS)
        assert heard.last("problems")["digest"] == first
        page.keyboard.press("Control+y")
        _answered(page)
        assert heard.last("problems")["digest"] == second != first


def test_invalid_combination_is_explained_and_the_shape_stays(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (page, heard):
        page.locator("#p-bubble_thickness-field").fill("9.9")
        page.keyboard.press("Enter")
        problem = page.locator('[data-parameter="bubble_thickness"] .problem')
        problem.filter(has_text="hollow").wait_for()
        assert page.locator("#stage-view.dimmed").count() == 1
        assert heard.last("problems")["problems"][0]["message"] in problem.inner_text()
        page.locator("#undo").click()
        wait_for_answer(page, milliseconds=LONG_MS)
        assert page.locator("#stage-view.dimmed").count() == 0


def test_pinned_design_is_compared_and_the_section_cuts(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (page, heard):
        before = heard.last("answer")["bending_angle_deg"]
        page.locator("#pin").click()
        moved(page, "bubble_height", [21.0], 300)
        gain = heard.last("answer")["bending_angle_deg"] - before
        shown = page.locator("#angle-compared").inner_text().replace("−", "-")
        assert float(shown.split("°")[0]) == pytest.approx(gain, abs=0.051)
        assert page.get_by_role("checkbox", name="pinned").count() == 1
        section = page.get_by_role("button", name="Section")
        page.locator("h1").click()
        page.keyboard.press("s")
        assert section.get_attribute("aria-pressed") == "true"
        page.locator("#blend:not([disabled])").wait_for(timeout=LONG_MS)
        page.locator("#blend").focus()
        page.keyboard.press("Home")
        assert page.locator("#blend-text").inner_text() == "at rest"


def test_connection_that_is_lost_is_said_and_comes_back_with_the_changes(
    browser: Any, address: str
) -> None:
    with opened(browser, "about:blank", calm=True) as (page, _):
        sockets: list[Any] = []

        def pass_on(socket: Any) -> None:
            socket.connect_to_server()
            sockets.append(socket)

        page.route_web_socket("**/session*", pass_on)
        page.goto(address)
        wait_for_answer(page, milliseconds=LONG_MS)
        moved(page, "bubble_height", [20.5], 300)
        sockets[-1].close()
        page.locator("#banner", has_text="Connected again").wait_for(timeout=LONG_MS)
        _answered(page)
        assert len(sockets) == 2
        assert page.locator("#p-bubble_height-field").input_value() == "20.5"
        assert page.locator("#design-changed").is_visible()


def test_two_tabs_are_two_designs(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (one, heard), studio_page(browser, address) as (other, _):
        moved(one, "bubble_height", [20.5], 300)
        assert other.locator("#p-bubble_height-field").input_value() == "20"
        assert sliders(other)["bubble_height"]["value"] == 20
        _expect_what_was_heard(one, heard)


def test_walk_of_five_random_moves_shows_what_evaluate_finds(
    browser: Any, address: str, tmp_path: Path
) -> None:
    from studio_moves import checked, walked

    with studio_page(browser, address) as (page, _):
        moves = list(walked(page, 5))
    assert [move.state for move in moves if move.state == "stuck"] == []
    assert all(move.how for move in moves if not move.answered)
    assert any(move.answered for move in moves)
    assert [check for check in checked(moves, 2) if not check.agrees] == []


@pytest.mark.parametrize(("width", "theme"), [(400, "dark"), (1280, "light")])
def test_page_with_its_first_answer_fits_and_can_be_read(
    browser: Any, address: str, width: int, theme: str
) -> None:
    from browser import hard_to_read, wider_than_the_window

    with studio_page(browser, address, width=width, theme=theme) as (page, _):
        assert wider_than_the_window(page) == 0
        assert hard_to_read(page) == []


def test_forces_come_with_picture_and_figures(browser: Any, address: str) -> None:
    with studio_page(browser, address) as (page, heard):
        page.locator("#tab-forces").click()
        page.locator("label[for=scene-blocked]").click()
        page.locator("#scene-field-support").select_option("held")
        page.locator("#scene-run").click()
        page.locator("#scene-figures", has_text="Force").wait_for(timeout=LONG_MS)
        figures = {each["label"]: each["value"] for each in heard.last("scene")["figures"]}
        assert figures["Force"] > 0
        assert page.locator("#scene-picture").evaluate(
            "image => image.decode().then(() => image.naturalWidth)"
        )


def test_downloaded_part_is_the_one_that_the_command_writes(browser: Any, tmp_path: Path) -> None:
    store = {"BELLOWS_CACHE": str(tmp_path / "store")}
    with (
        running_studio("finger", tmp_path / "exports", store) as url,
        studio_page(browser, url) as (page, _),
    ):
        page.locator("#run").click()
        page.locator("#run-status", has_text="Approved").wait_for(timeout=LONG_MS)
        with page.expect_download() as download:
            page.locator("#run-files a", has_text="finger.stl").click()
        downloaded = Path(download.value.path()).read_bytes()
    output = tmp_path / "by-command"
    command = [sys.executable, "-m", "bellows_design", "run", "finger", "--output", str(output)]
    subprocess.run(command, env={**os.environ, **store}, check=True, capture_output=True)
    assert downloaded == (output / "finger" / "finger.stl").read_bytes()
