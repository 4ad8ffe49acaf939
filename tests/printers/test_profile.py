"""Printer profiles: what is shipped, what is refused, what other packages add."""

from __future__ import annotations

import importlib
import sys
import tomllib
from pathlib import Path

import pytest

import printers
from printers import PrinterProfile, available_profiles, load_profile

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
        ({"slicer": {"print_speed": 60.0}}, ["print_speed", "60", "1.5 mm³/s"]),
        ({"line_width": 1.0}, ["line_width", "1 mm", "2 times", "0.4 mm"]),
        ({"name": "a\nb"}, ["name", r"a\nb", "printable text on one line"]),
        ({"description": "\x1b[2J"}, ["description", r"\x1b[2J", "printable text on one line"]),
        ({"slicer": {"seam": "rear\x07"}}, ["seam", "printable text on one line"]),
        ({"slicer": {"sources": ["mine", "\u202e"]}}, ["sources.1", "printable text"]),
        ({"description": "x" * 2001}, ["description", "2000 characters"]),
        ({"layer_height": 0.39}, ["layer_height", "0.39 mm", "0.8 times"]),
    ],
)
def test_a_bad_value_is_named_in_one_sentence(values: dict[str, object], words: list[str]) -> None:
    with pytest.raises(ValueError) as error:
        PrinterProfile(**changed(**values))
    assert all(word in str(error.value) for word in words), str(error.value)
    assert "\n" not in str(error.value)
    assert "For further information" not in str(error.value)


def test_a_missing_key_is_named() -> None:
    table = changed()
    del table["line_width"]
    with pytest.raises(ValueError, match="'line_width' is missing"):
        PrinterProfile(**table)


@pytest.mark.parametrize("name", ["ender", "../profiles/prusa_i3", "", "/etc/passwd"])
def test_an_unknown_name_is_answered_with_the_known_ones(name: str) -> None:
    with pytest.raises(ValueError, match=r"known: .*prusa_i3"):
        load_profile(name)


def test_a_profile_can_be_loaded_from_a_file(tmp_path: Path) -> None:
    text = (PROFILES / "prusa_i3.toml").read_text(encoding="utf-8")
    (tmp_path / "mine.toml").write_text(text.replace('"prusa_i3"', '"mine"'), encoding="utf-8")
    assert load_profile(tmp_path / "mine.toml").name == "mine"
    assert load_profile(str(tmp_path / "mine.toml")).name == "mine"


@pytest.mark.parametrize("content", [None, b"line_width = ", b"\xff\xfe"])
def test_a_missing_or_broken_file_is_named(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "broken.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ValueError, match=r"broken\.toml") as error:
        load_profile(path)
    assert "\n" not in str(error.value)


def test_a_profile_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="frozen"):
        load_profile("prusa_i3").line_width = 0.5  # type: ignore[misc]


def install(folder: Path, value: str) -> None:
    """Lay out a package with a profile, as an installer would."""
    info = folder / "lab_printers-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: lab-printers\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[bellows_design.printers]\nlab = {value}\n")
    package = folder / "lab_printers"
    package.mkdir()
    (package / "__init__.py").write_text("")
    text = (PROFILES / "nozzle_0_6.toml").read_text(encoding="utf-8")
    (package / "delta.toml").write_text(text.replace('"nozzle_0_6"', '"delta"'), encoding="utf-8")
    shadow = text.replace('"nozzle_0_6"', '"prusa_i3"')
    (package / "prusa_i3.toml").write_text(shadow, encoding="utf-8")


def test_another_package_adds_profiles_but_shadows_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install(tmp_path, "lab_printers")
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    try:
        assert "delta" in available_profiles()
        assert load_profile("delta").nozzle_diameter == 0.6
        assert load_profile("prusa_i3").nozzle_diameter == 0.4
    finally:
        sys.modules.pop("lab_printers", None)


def test_an_entry_point_without_its_package_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install(tmp_path, "no_such_package")
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    with pytest.raises(ValueError, match="no_such_package"):
        load_profile("delta")
