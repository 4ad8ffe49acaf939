"""Words of others, as they may stand in messages and files."""

from __future__ import annotations

import pytest

from bellows_design.validation.quoting import reproducible


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
