"""Printer profiles as files: shipped, a user's own, and those of other packages."""

from __future__ import annotations

import importlib
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

import printers
from printers import PrintersError, available_profiles, load_profile
from printers.library.reading import LARGEST_FILE

PROFILES = Path(printers.__file__).parent / "profiles"


@pytest.mark.parametrize("name", ["delta", "../profiles/prusa_i3", "", "/etc/passwd"])
def test_an_unknown_name_is_answered_with_the_known_ones(name: str) -> None:
    with pytest.raises(PrintersError, match=r"known: .*prusa_i3"):
        load_profile(name)


@pytest.mark.parametrize(("name", "near"), [("prusa_i4", "prusa_i3"), ("ender", "ender_3_s1")])
def test_an_unknown_name_is_answered_with_the_one_that_is_near(name: str, near: str) -> None:
    with pytest.raises(PrintersError, match=f"did you mean {near}"):
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
    with pytest.raises(PrintersError, match=r"broken\.toml") as error:
        load_profile(path)
    assert "\n" not in str(error.value)


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


@pytest.fixture
def importable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder whose packages can be imported."""
    monkeypatch.syspath_prepend(tmp_path)
    importlib.invalidate_caches()
    yield tmp_path
    sys.modules.pop("lab_printers", None)


def test_another_package_adds_profiles_but_shadows_none(importable: Path) -> None:
    install(importable, "lab_printers")
    assert "delta" in available_profiles()
    assert load_profile("delta").nozzle_diameter == 0.6
    assert load_profile("prusa_i3").nozzle_diameter == 0.4


def test_an_entry_point_without_its_package_is_named(importable: Path) -> None:
    install(importable, "no_such_package")
    with pytest.raises(PrintersError, match="no_such_package"):
        load_profile("delta")


@pytest.mark.parametrize("code", ["def (", "raise RuntimeError('out of order')", "1 / 0"])
def test_a_package_that_cannot_be_imported_is_named(importable: Path, code: str) -> None:
    install(importable, "lab_printers")
    (importable / "lab_printers" / "__init__.py").write_text(code)
    with pytest.raises(PrintersError, match=r"entry point 'lab'.*'lab_printers'") as error:
        available_profiles()
    assert "\n" not in str(error.value)


def test_a_broken_package_does_not_keep_shipped_profiles_from_loading(importable: Path) -> None:
    install(importable, "no_such_package")
    assert load_profile("prusa_i3").name == "prusa_i3"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("#" * (LARGEST_FILE + 1), "larger than 1 MB"),
        ("a." * 400_000 + "a = 1", "more than 100 dots"),
        ("x = " + "[" * 900_000, "cannot be read"),
    ],
)
def test_a_file_in_a_zipped_package_is_guarded_like_any_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str, words: str
) -> None:
    install(tmp_path, "lab_printers")
    (tmp_path / "lab_printers" / "delta.toml").write_text(content)
    archive = tmp_path / "archive.zip"
    with zipfile.ZipFile(archive, "w") as packed:
        for path in sorted(tmp_path.glob("lab*/*")):
            packed.write(path, path.relative_to(tmp_path))
    monkeypatch.syspath_prepend(archive)
    importlib.invalidate_caches()
    try:
        with pytest.raises(PrintersError, match=words):
            load_profile("delta")
    finally:
        sys.modules.pop("lab_printers", None)


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_profile_extends_another_over_several_levels(tmp_path: Path) -> None:
    write(tmp_path, "wide", 'extends = "nozzle_0_6"\nname = "wide"\nline_width = 0.7')
    mine = write(
        tmp_path,
        "mine",
        'extends = "wide.toml"\nname = "mine"\n[slicer]\nfan = 0.0\n[rules]\noverhang = "info"',
    )
    profile, base = load_profile(mine), load_profile("nozzle_0_6")
    assert (profile.name, profile.line_width, profile.slicer.fan) == ("mine", 0.7, 0.0)
    assert profile.description == base.description
    assert profile.slicer.print_speed == base.slicer.print_speed
    assert profile.severity("overhang") == "info"


def test_an_heir_does_not_take_the_name_it_extends(tmp_path: Path) -> None:
    with pytest.raises(PrintersError, match="'name' is missing"):
        load_profile(write(tmp_path, "mine", 'extends = "prusa_i3"'))


@pytest.mark.parametrize("names", [["a"], ["a", "b"], ["a", "b", "c"]])
def test_files_that_extend_each_other_in_a_circle_are_refused(
    tmp_path: Path, names: list[str]
) -> None:
    for name, following in zip(names, [*names[1:], names[0]], strict=True):
        write(tmp_path, name, f'extends = "./{following}.toml"\nname = "{name}"')
    with pytest.raises(PrintersError, match=r"a\.toml.*circle.*a\.toml > ") as error:
        load_profile(tmp_path / "a.toml")
    assert "\n" not in str(error.value)


def test_a_chain_that_nobody_wrote_by_hand_is_refused(tmp_path: Path) -> None:
    for number in range(20):
        write(tmp_path, f"n{number}", f'extends = "n{number + 1}.toml"')
    with pytest.raises(PrintersError, match="more than 10 files"):
        load_profile(tmp_path / "n0.toml")


@pytest.mark.parametrize(
    ("parent", "words"),
    [
        (None, "there is no printer profile file"),
        ("x = " + "[" * 900_000, "cannot be read"),
        ("#" * (LARGEST_FILE + 1), "larger than 1 MB"),
        ('extends = "nobody"', "no printer profile 'nobody'"),
        ('extends = "prusa_i3"\nline_width = true', "line_width is true"),
    ],
)
def test_what_is_extended_is_guarded_like_any_other_file(
    tmp_path: Path, parent: str | None, words: str
) -> None:
    if parent is not None:
        write(tmp_path, "parent", parent)
    mine = write(tmp_path, "mine", 'extends = "parent.toml"\nname = "mine"')
    with pytest.raises(PrintersError, match=words) as error:
        load_profile(mine)
    assert "mine.toml" in str(error.value) and "\n" not in str(error.value)


def test_paths_count_from_the_file_that_names_them(tmp_path: Path) -> None:
    (tmp_path / "lab").mkdir()
    write(tmp_path / "lab", "soft", 'extends = "ninjaflex_85a"\nname = "soft"\nflow = 125.0')
    write(
        tmp_path / "lab",
        "base",
        'extends = "prusa_i3"\nname = "base"\nfilament = "soft.toml"',
    )
    mine = write(tmp_path, "mine", 'extends = "lab/base.toml"\nname = "mine"')
    filament = load_profile(mine).filament
    assert (filament.name, filament.flow, filament.density) == ("soft", 125, 1.19)


@pytest.mark.parametrize(
    "content", [None, "density = ", "density = 1.2", 'extends = "./mine.toml"']
)
def test_a_missing_or_broken_filament_is_named(tmp_path: Path, content: str | None) -> None:
    if content is not None:
        write(tmp_path, "soft", content.replace("mine", "soft"))
    mine = write(tmp_path, "mine", 'extends = "prusa_i3"\nname = "mine"\nfilament = "soft.toml"')
    with pytest.raises(PrintersError, match=r"mine\.toml.*soft\.toml") as error:
        load_profile(mine)
    assert "\n" not in str(error.value)
