"""What notebooks show: a table and the shape in a frame of its own, all text escaped."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from IPython.core.interactiveshell import InteractiveShell

from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.plugin import (
    Preview,
    plate,
    preview,
)

SETTINGS = ["length=11.5", "offset=3", "number_of_bubbles=1"]
FRAME = re.compile(r'<iframe srcdoc="([^"]*)" sandbox="([^"]*)"')


@pytest.fixture(scope="module")
def design() -> Design:
    return with_overrides(load_design("prototype_1"), SETTINGS)


@pytest.fixture(scope="module")
def evaluation(design: Design) -> Evaluation:
    return evaluate(design)


def page_in(shown: Preview) -> str:
    """The page in the frame."""
    found = FRAME.search(shown._repr_html_())
    assert found is not None and found.group(2) == "allow-scripts allow-downloads"
    return unescape(found.group(1))


def test_a_design_is_a_table_and_a_page_without_other_files(design: Design) -> None:
    shown = preview(design)
    html, page = shown._repr_html_(), page_in(shown)
    assert page == shown.page and page.startswith("<!DOCTYPE html>")
    assert "1, walls of 1.5 mm" in html and design.digest[:16] in html
    assert not re.search(r"(src|href)=[\"']https?:", page)
    assert page.count("bellows-view") >= 1 and len(repr(shown)) < 2000


def test_texts_of_a_design_are_escaped() -> None:
    evil = with_overrides(
        load_design("prototype_1"), [*SETTINGS, 'description="<script>alert(1)</script>"']
    )
    html = preview(evil)._repr_html_()
    assert "<script>alert(1)" not in html and "&lt;script&gt;alert(1)" in html


def test_names_and_values_may_be_given_instead(design: Design) -> None:
    values = {"length": 11.5, "offset": 3, "number_of_bubbles": 1}
    assert preview("prototype_1", **values).page == preview(design).page


def test_an_evaluation_is_shown_deformed_with_its_errors(evaluation: Evaluation) -> None:
    shown = preview(evaluation)
    assert f"{evaluation.bending_angle_deg:.1f}°" in shown._repr_html_()
    assert "±" in shown._repr_html_() and "von Mises stress" in shown.page


def test_a_plate_is_shown_with_its_names(design: Design) -> None:
    shown = preview(plate([design, design]))
    assert shown.title == "plate" and shown.rows == []


def test_the_page_can_be_saved(design: Design, tmp_path: Path) -> None:
    shown = preview(design)
    shown.save(tmp_path / "part.html")
    assert (tmp_path / "part.html").read_text("utf-8") == shown.page


def test_the_extension_shows_designs_and_evaluations_by_themselves(design: Design) -> None:
    shell = InteractiveShell()
    formatter = shell.display_formatter.formatters["text/html"]
    shell.run_line_magic("load_ext", "bellows_design.plugin")
    assert formatter(design) == preview(design)._repr_html_()
    shell.run_line_magic("unload_ext", "bellows_design.plugin")
    assert formatter(design) is None


@pytest.mark.browser
def test_several_in_one_page_are_all_drawn(
    design: Design, evaluation: Evaluation, browser: Any, tmp_path: Path
) -> None:
    shown = [preview(design), preview(evaluation), preview(plate([design, design]))]
    body = "".join(each._repr_html_() for each in shown).replace('loading="lazy"', "")
    (tmp_path / "notebook.html").write_text(f"<!DOCTYPE html><body>{body}</body>", "utf-8")
    page = browser.new_page(viewport={"width": 900, "height": 1800})
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
    page.goto((tmp_path / "notebook.html").as_uri())
    for frame in page.frames[1:]:
        frame.wait_for_selector("canvas", timeout=60_000)
    frames, title = len(page.frames) - 1, page.title()
    page.close()
    assert (frames, title, wrong) == (3, "", [])
