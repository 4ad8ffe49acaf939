"""The page's values make the design that the command line would make, or explain themselves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.errors import BellowsError, DesignError
from bellows_design.studio.choices.changed import changed, opened_text, problems
from bellows_design.studio.choices.parameters import current_values, sliders
from bellows_design.studio.choices.saving import toml_text

BASE = load_design("prototype_1")


def explained(values: dict[str, Any]) -> list[dict[str, Any]]:
    with pytest.raises(BellowsError) as error:
        changed(BASE, values)
    return problems(error.value, values)


@pytest.mark.parametrize(
    ("values", "settings"),
    [
        ({"bubble_width": 20.5}, ["bubble_width=20.5"]),
        ({"bellows.bubble_width": 20}, ["bubble_width=20"]),
        ({"load.pressure": 0.05, "length": 60}, ["load.pressure=0.05", "length=60"]),
        ({"number_of_bubbles": 6}, ["number_of_bubbles=6"]),
        ({"material": "dragon_skin_30"}, ["material=dragon_skin_30"]),
        ({"limits.max_von_mises": 3.0}, ["limits.max_von_mises=3"]),
        (
            {"indent": {"side": "outside", "shape": "arc", "depth": 0.4, "width": 2.0}},
            ["indent={depth=0.4, width=2.0}"],
        ),
        ({"indent.depth": 0.4, "indent.width": 2.0}, ["indent.depth=0.4", "indent.width=2"]),
    ],
)
def test_values_of_the_page_are_those_of_set(values: dict[str, Any], settings: list[str]) -> None:
    first = settings[:1] if "indent.depth" not in values else ["indent={depth=0.4, width=2.0}"]
    expected = with_overrides(BASE, [*first, *settings[1:]])
    assert changed(BASE, values).digest == expected.digest


def test_null_takes_an_indent_and_a_count_away() -> None:
    indented = load_design("prototype_2_indent")
    assert changed(indented, {"indent": None}).indent is None
    counted = changed(BASE, {"number_of_bubbles": 5})
    assert changed(counted, {"number_of_bubbles": None}).digest == BASE.digest


def test_full_rounds_follow_unless_they_are_moved_themselves() -> None:
    full = changed(BASE, {"inner_fillet": 1.0})  # half of the chamber's length
    assert changed(full, {"chamber_length": 1.6}).bellows.inner_fillet == pytest.approx(0.8)
    with pytest.raises(DesignError, match="inner_fillet"):
        changed(full, {"chamber_length": 1.6, "inner_fillet": 1.0})


@pytest.mark.parametrize(
    ("values", "parameter"),
    [
        ({"bubble_width": 3.0}, "bubble_width"),
        ({"bubble_width": None}, "bubble_width"),
        ({"bubble_width": "wide"}, "bubble_width"),
        ({"bubble_width": float("nan")}, "bubble_width"),
        ({"tendon_width": 40.0}, "tendon_width"),
        ({"bubble_width": 11.0}, "bubble_width"),  # narrower than the tendon
        ({"inner_fillet": 1.2}, "inner_fillet"),
        ({"chamber_length": 0.8}, "chamber_length"),  # shorter than its fillet is wide
        ({"length": 11.0, "offset": 8.0}, "length"),
        ({"number_of_bubbles": 30}, "number_of_bubbles"),
        ({"number_of_bubbles": 2.5}, "number_of_bubbles"),
        ({"load.pressure": 0.0}, "load.pressure"),
        ({"load.pressure": 5.0}, "load.pressure"),
        ({"material": "unobtainium"}, "material"),
        ({"indent.depth": 0.4}, "indent.width"),
        ({"indent": {"depth": 3.0, "width": 6.0}}, "indent.depth"),
        ({"port.tube_diameter": 0.5}, "port.tube_diameter"),
        ({"limits.max_von_mises": -1.0}, "limits.max_von_mises"),
    ],
)
def test_each_problem_stands_beside_a_parameter_of_its_sentence(
    values: dict[str, Any], parameter: str
) -> None:
    found = explained(values)
    assert parameter in {
        name for each in found for name in (each["parameter"], *each["parameters"])
    }
    assert all(each["message"].endswith((".", "?")) for each in found)


def test_of_several_names_the_one_that_was_moved_gets_the_sentence() -> None:
    (wide,) = explained({"tendon_width": 40.0})
    (narrow,) = explained({"bubble_width": 11.0})
    assert wide["parameter"] == "tendon_width" and narrow["parameter"] == "bubble_width"
    assert set(narrow["parameters"]) >= {"tendon_width", "bubble_width"}


def test_plain_words_of_a_sentence_are_no_parameters() -> None:
    (found,) = explained({"inner_fillet": 1.2})
    assert "length" in found["message"]
    assert found["parameters"] == ["inner_fillet", "chamber_length"]


@pytest.mark.parametrize(
    "key", ["name.x", "__class__", "scenes", "bellows", "load", "indent.x", ""]
)
def test_no_other_keys_are_taken(key: str) -> None:
    found = explained({key: {"pressure": "x"}})
    assert found


@pytest.mark.parametrize("name", ["../../etc/x", "a/b", "..", "C:\\x", "con", "", "a\0b"])
def test_names_stay_in_the_folder_of_exports(name: str) -> None:
    with pytest.raises(DesignError):
        changed(BASE, {"name": name})


def test_a_page_opens_no_files_of_materials_and_printers(tmp_path: Path) -> None:
    secret = tmp_path / "secret.toml"
    secret.write_text("password = 'hunter2'")
    for key in ("material", "printer"):
        with pytest.raises(DesignError, match="names and tables") as refused:
            changed(BASE, {key: str(secret)})
        assert "hunter2" not in str(refused.value)
        text = BASE.to_toml().replace(
            'material = "ninjaflex"' if key == "material" else 'printer = "prusa_i3"',
            f"{key} = {str(secret)!r}",
        )
        with pytest.raises(DesignError, match="names and tables"):
            opened_text(text)


@pytest.mark.parametrize(
    "printer",
    [
        {"name": "x", "extends": "/etc/passwd"},
        {"name": "x", "extends": "secret.toml"},
        {"name": "x", "extends": "prusa_i3", "filament": "../secret.toml"},
        {"name": "x", "extends": "prusa_i3", "filament": {"extends": "C:\\secret"}},
    ],
)
def test_nor_does_a_table_lead_to_a_file(printer: dict[str, Any]) -> None:
    with pytest.raises(DesignError, match="names and tables"):
        changed(BASE, {"printer": printer})


@pytest.mark.parametrize("text", ["", "x = ", "a" * 10 + "=[" * 5000, "name = 'a'\n" + "." * 500])
def test_text_that_is_no_design_is_refused_in_sentences(text: str) -> None:
    with pytest.raises(DesignError) as refused:
        opened_text(text)
    assert all(sentence for sentence in refused.value.sentences)


@pytest.mark.parametrize("name", shipped_designs())
def test_saved_designs_are_commented_and_load_to_the_same_digest(name: str) -> None:
    design = changed(load_design(name), {"bubble_width": 20.25, "load.pressure": 0.07})
    text = toml_text(design)
    assert Design.from_toml(text).digest == design.digest
    assert "outer width of a bubble, along y; mm" in text


def test_a_saved_design_with_tables_and_marks_in_its_texts_is_the_same() -> None:
    table = BASE.model_dump(mode="json") | {
        "description": 'a "quoted" text = [with] # marks, """three"""',
        "scenes": {"desk": {"kind": "blocked", "support": "wall", "distance": 8.0}},
        "material": load_design("finger").material.model_dump(mode="json") | {"name": "mine"},
        "printer": BASE.profile().model_dump(mode="json") | {"name": "mine"},
    }
    table["limits"] = table["limits"] | {"scenes": ["desk"]}
    design = Design.of(Design.of(table).model_dump())
    read = Design.from_toml(toml_text(design))
    assert read.digest == design.digest and read.description == design.description


@pytest.mark.parametrize("name", shipped_designs())
def test_sliders_hold_the_design_and_stay_within_its_bounds(name: str) -> None:
    design = load_design(name)
    found = sliders(design)
    assert len({each["name"] for each in found}) == len(found) >= 15
    for each in found:
        assert each["least"] <= each["lowest"] < each["highest"] <= each["most"]
        assert each["step"] > 0 and each["meaning"] and each["group"]
        if each["value"] is not None:
            assert each["lowest"] <= each["value"] <= each["highest"]
    values = {each["name"]: each["value"] for each in found if not each["automatic"]}
    assert changed(design, values).digest == design.digest


def test_what_follows_is_said_back() -> None:
    full = changed(BASE, {"inner_fillet": 1.0})
    values = current_values(changed(full, {"chamber_length": 1.6}))
    assert values["inner_fillet"] == pytest.approx(0.8)
