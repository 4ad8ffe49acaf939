"""What a page is told at once, without CAD or a solve."""

from __future__ import annotations

import json
from threading import Event
from typing import Any

import pytest

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.errors import DesignError
from bellows_design.materials import material_names
from bellows_design.studio.tasks.quick import tasks
from bellows_design.studio.workers.reporting import Cancelled, Report
from printers import available_profiles

BASE = load_design("prototype_1").to_toml()


def done(task: str, **values: Any) -> dict[str, dict[str, Any]]:
    """What a task reports, by kind."""
    heard: dict[str, dict[str, Any]] = {}

    def hear(event: dict[str, Any], arrays: Any) -> None:
        json.dumps(event)
        heard[event["kind"]] = {**event, "arrays": arrays}

    tasks()[task](values, {}, Report(hear, Event()))
    return heard


@pytest.mark.parametrize("name", shipped_designs())
def test_start_says_all_that_the_page_shows_before_anything_is_computed(name: str) -> None:
    start = done("open", name=name, text=None)["start"]
    assert start["name"] == name and Design.from_toml(start["toml"]).name == name
    assert {each["name"] for each in start["designs"]} == set(shipped_designs())
    assert {each["name"] for each in start["materials"]} == set(material_names())
    assert start["printers"] == list(available_profiles())
    assert start["material"] in material_names() and start["printer"] in start["printers"]
    assert (start["indent"] is None) == (load_design(name).indent is None)


def test_a_text_opens_as_the_design_that_it_is() -> None:
    assert done("open", name=None, text=BASE)["start"]["toml"] == BASE


def test_an_unknown_design_is_named_with_what_is_near() -> None:
    with pytest.raises(DesignError, match="did you mean prototype_1"):
        done("open", name="prototyp_1", text=None)


def test_names_of_files_open_nothing(tmp_path: Any) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(BASE)
    with pytest.raises(DesignError, match="unknown design"):
        done("open", name=str(path), text=None)


def test_a_valid_change_has_no_problems_its_facts_and_its_lights() -> None:
    heard = done("change", base=BASE, values={"length": 64.0})
    assert heard["problems"]["problems"] == []
    assert heard["problems"]["bubble_count"] == 9
    assert heard["problems"]["values"]["length"] == 64.0
    assert heard["lights"]["source"] == "declared"
    assert "shape_follows" in heard  # no cell is known yet


def test_an_invalid_change_has_its_problems_and_nothing_else() -> None:
    heard = done("change", base=BASE, values={"bubble_width": 3.0})
    assert list(heard) == ["problems"]
    assert heard["problems"]["problems"][0]["parameter"] == "bubble_width"


def test_an_unknown_printer_is_a_problem_of_the_printer() -> None:
    (problem,) = done("change", base=BASE, values={"printer": "nowhere"})["problems"]["problems"]
    assert problem["parameter"] == "printer" and "nowhere" in problem["message"]


def test_a_changed_design_is_saved_under_a_name_of_its_own() -> None:
    same = done("toml", base=BASE, values={})["toml"]
    other = done("toml", base=BASE, values={"length": 64.0})["toml"]
    assert same["name"] == "prototype_1"
    assert other["name"] == f"prototype_1-{other['digest'][:8]}"
    assert Design.from_toml(other["text"]).digest == other["digest"]


def test_a_stale_job_reports_nothing_more() -> None:
    stale = Event()
    stale.set()
    with pytest.raises(Cancelled):
        tasks()["change"]({"base": BASE, "values": {}}, {}, Report(lambda *_: None, stale))
