"""Words of others, as they may stand in messages and files."""

from __future__ import annotations

from pathlib import Path

import pytest

from bellows_design.validation.quoting import did_you_mean, near_file, reproducible


@pytest.mark.parametrize(
    ("said", "kept"),
    [
        ("no such file: /tmp/tmpab12/part.stl.", "no such file: part.stl."),
        (r"cannot open C:\Users\me\AppData\part.stl", "cannot open part.stl"),
        ("see ~/x/y and ./a/b and ../c", "see y and b and c"),
        ("settings 3/4 and and/or stay", "settings 3/4 and and/or stay"),
        ("in bellows-slicing-x_1y it stopped", "in … it stopped"),
        ("\x1b[1;31mred\x1b[0m\r\n\x9b2Jand\0 more", "red and? more"),
        ("x" * 400, "x" * 299 + "…"),
    ],
)
def test_what_a_program_says_has_no_folders_and_no_control_characters(said: str, kept: str) -> None:
    assert reproducible(said) == kept


KEYS = ("bubble_thickness", "bubble_width", "tendon_thickness", "load.pressure", "port.length")


@pytest.mark.parametrize(
    ("unknown", "named"),
    [
        ("bubble_thicknes", "bubble_thickness"),
        ("thickness", "tendon_thickness or bubble_thickness"),
        ("presure", "load.pressure"),
    ],
)
def test_only_what_is_about_as_near_as_the_nearest_is_named(unknown: str, named: str) -> None:
    assert did_you_mean(unknown, KEYS) == f"; did you mean {named}?"


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ("part.slt", "part.stl"),
        ("prt.stl", "part.stl"),
        ("part", "part.stl"),
        ("elsewhere.toml", None),  # pyproject.toml has the same suffix, and is another file
        ("part.stl", None),  # is there, if as a folder
    ],
)
def test_a_file_is_near_by_its_name_not_by_its_suffix(
    given: str, named: str | None, tmp_path: Path
) -> None:
    for name in ("part.stl", "pyproject.toml"):
        (tmp_path / name).mkdir()
    hint = near_file(tmp_path / given)
    assert (f"{named}”?" in hint) if named else not hint
