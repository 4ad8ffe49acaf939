"""The record of a printer profile: what is shipped, and what is refused."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from pydantic import BaseModel

import printers
from printers import (
    Filament,
    PrinterProfile,
    PrintersError,
    SlicerAdvice,
    available_filaments,
    available_profiles,
    load_filament,
    load_profile,
    profile_from_table,
)

PROFILES = Path(printers.__file__).parent / "profiles"


def changed(**values: object) -> dict[str, object]:
    table = tomllib.loads((PROFILES / "prusa_i3.toml").read_text(encoding="utf-8"))
    table["slicer"] |= values.pop("slicer", {})
    return table | values


@pytest.mark.parametrize("name", available_profiles())
def test_every_shipped_profile_loads_under_its_own_name(name: str) -> None:
    assert load_profile(name).name == name


def test_the_prusa_profile_counts_walls_in_nozzle_widths_as_the_paper_does() -> None:
    profile = load_profile("prusa_i3")
    assert profile.line_width == profile.nozzle_diameter == 0.4
    assert profile.minimum_wall == pytest.approx(1.2)
    assert profile.minimum_floor == pytest.approx(0.8)
    assert profile.build_volume == (250, 210, 210)


def test_three_thin_lines_of_the_sealing_profile_make_its_least_wall() -> None:
    assert load_profile("direct_drive_sealing").minimum_wall == pytest.approx(0.96)


@pytest.mark.parametrize("name", available_profiles())
def test_the_advised_speed_stays_below_the_advised_flow(name: str) -> None:
    profile = load_profile(name)
    assert 0 < profile.volumetric_flow <= profile.slicer.maximum_volumetric_flow


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"line_width": float("nan")}, ["line_width", "nan mm", "finite"]),
        ({"line_width": 400.0}, ["line_width", "400", "mm"]),
        ({"line_width": 0.0004}, ["line_width", "0.0004 mm"]),
        ({"layer_height": -0.1}, ["layer_height", "-0.1 mm"]),
        ({"build_volume": [0.25, 0.21, 0.21]}, ["build_volume", "0.25", "20"]),
        ({"build_volume": [250.0, 210.0]}, ["build_volume"]),
        ({"minimum_lines": 2.5}, ["minimum_lines", "2.5"]),
        ({"minimum_gap": float("inf")}, ["minimum_gap", "inf mm"]),
        ({"wall": 1.2}, ["unknown key 'wall'", "line_width"]),
        ({"slicer": {"fan": 300.0}}, ["slicer", "fan", "300 percent", "100"]),
        ({"slicer": {"glue": True}}, ["slicer", "unknown key 'glue'"]),
        ({"slicer": {"print_speed": 60.0}}, ["print_speed", "60", "1.2 mm³/s"]),
        ({"line_width": 1.0}, ["line_width", "1 mm", "2 times", "0.4 mm"]),
        ({"name": "a\nb"}, ["name", r"a\nb", "printable text on one line"]),
        ({"description": "\x1b[2J"}, ["description", r"\x1b[2J", "printable text on one line"]),
        ({"slicer": {"seam": "rear\x07"}}, ["seam", "'random'", "'rear'"]),
        ({"slicer": {"seam": "staggered"}}, ["seam", "staggered", "write", "random"]),
        ({"slicer": {"perimeter_flow": 115.0}}, ["perimeter_flow", "one key now, flow"]),
        ({"slicer": {"infill_flow": 115.0}}, ["infill_flow", "one key now, flow"]),
        ({"perimeter_flow": 115.0}, ["perimeter_flow", "one key now, flow in [slicer]"]),
        ({"print_speed": 20.0}, ["unknown key 'print_speed'; it belongs into [slicer]"]),
        ({"shore": "85A"}, ["unknown key 'shore'; it belongs into [filament]"]),
        ({"filament": "wool"}, ["no filament 'wool'", "ninjaflex_85a"]),
        ({"filament": {"name": "mine"}}, ["filament", "'description' is missing"]),
        ({"filament": {"extends": "cheetah_95a", "name": "x", "density": 0.0}}, ["density", "0 g"]),
        ({"filament": 3}, ["filament", "3"]),
        ({"extends": 3}, ["extends", "3", "name"]),
        ({"rules": {"overhang": "ignore"}}, ["rules.overhang", "'ignore'", "'warn'"]),
        ({"rules": {"overhangs": "warn"}}, ["no rule 'overhangs'", "overhang"]),
        ({"rules": {"airtightness": "warn"}}, ["airtightness", "keeps its severity"]),
        ({"first_layer_height": 0.39}, ["first_layer_height", "0.39 mm", "0.8 times"]),
        ({"slicer": {"sources": ["mine", "\u202e"]}}, ["sources.1", "printable text"]),
        ({"description": "x" * 2001}, ["description", "2000 characters"]),
        ({"layer_height": 0.39}, ["layer_height", "0.39 mm", "0.8 times"]),
    ],
)
def test_a_bad_value_is_named_in_one_sentence(values: dict[str, object], words: list[str]) -> None:
    with pytest.raises(PrintersError) as error:
        profile_from_table(changed(**values))
    assert all(word in str(error.value) for word in words), str(error.value)
    assert "\n" not in str(error.value)
    assert "For further information" not in str(error.value)


@pytest.mark.parametrize("record", [PrinterProfile, SlicerAdvice, Filament])
def test_every_number_but_counts_and_shares_states_its_unit(record: type[BaseModel]) -> None:
    extras = {name: field.json_schema_extra or {} for name, field in record.model_fields.items()}
    numbers = {name for name, field in record.model_fields.items() if field.annotation is float}
    assert numbers - {name for name, extra in extras.items() if "unit" in extra} <= {
        "minimum_bed_contact"
    }


def test_a_missing_key_is_named() -> None:
    table = changed()
    del table["line_width"]
    with pytest.raises(PrintersError, match="'line_width' is missing"):
        profile_from_table(table)


def test_a_profile_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="frozen"):
        load_profile("prusa_i3").line_width = 0.5  # type: ignore[misc]


@pytest.mark.parametrize("name", available_filaments())
def test_every_shipped_filament_loads_under_its_own_name_and_names_its_sources(name: str) -> None:
    filament = load_filament(name)
    assert filament.name == name and filament.shore.removesuffix("A").removesuffix("D") in name
    assert all(len(source) > 20 for source in filament.sources)


def test_a_filament_gives_the_settings_that_the_profile_leaves_out() -> None:
    table = changed(filament="cheetah_95a")
    table["slicer"].pop("flow")  # type: ignore[attr-defined]
    profile, filament = profile_from_table(table), load_filament("cheetah_95a")
    assert profile.filament == filament
    assert profile.slicer.nozzle_temperature == filament.nozzle_temperature == 240
    assert profile.slicer.flow == filament.flow == 105
    assert load_profile("prusa_i3").slicer.flow == 110, "its own, not the filament's 120"


def test_a_whole_profile_is_a_table_of_one() -> None:
    profile = load_profile("prusa_mini")
    assert profile_from_table(profile.model_dump(mode="json")) == profile


def test_severities_are_those_of_the_rules_but_where_the_profile_says_otherwise() -> None:
    profile = profile_from_table(changed(rules={"overhang": "fail", "bridge": "info"}))
    assert profile.severity("overhang") == "fail" and profile.severity("bridge") == "info"
    assert profile.severity("gap") == load_profile("prusa_i3").severity("gap") == "fail"
