"""What is said on a TOML file that is none, and on values written in another way."""

from __future__ import annotations

import tomllib

import pytest

from printers.toml_errors import toml_error, value_hint


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("wall = 1,2", "write 1.2, not 1,2"),
        ("wall = -1,25e-1", "write -1.25e-1, not -1,25e-1"),
        ("wall = 8cm", "8cm is 80 mm: write 80, in mm"),
        ("wall = 8,5 cm # so", "8,5 cm is 85 mm: write 85, in mm"),
        ("wall = 1.2 mm", "write 1.2, in mm and without the unit"),
        ("pressure = 14.5 psi", "14.5 psi is 0.099974 MPa: write 0.099974, in MPa"),
        ("pressure = 100kPa", "100kPa is 0.1 MPa: write 0.1, in MPa"),
        ("pressure = 1 bar", "1 bar is 0.1 MPa"),
        ("speed = 15 mm/s", "write the number alone, without “mm/s”"),
        ("angle = 45°", "write the number alone, without “°”"),
        ("fan = 30%", "write the number alone, without “%”"),
        ("wall = .8", "write 0.8, not .8"),
        ("wall = 01.2", "write 1.2, not 01.2"),
        ("length = 1 000", "write 1000, not 1 000"),
        ("retraction = True", "write true, not True"),
        ("retraction = no", "write false, not no"),
        ("port = None", "leave the key out instead of None"),
        ("material = mine.toml", 'text stands in quotes: "mine.toml"'),
        ("material = “ninjaflex”", "text stands between straight quotes"),
        ("wall: 1.2", "TOML writes key = value"),
    ],
)
def test_a_line_that_is_no_toml_is_answered_with_its_place_and_how_it_is_written(
    line: str, words: str
) -> None:
    text = f'name = "x"\n\n{line}\nlast = 1\n'
    with pytest.raises(tomllib.TOMLDecodeError) as caught:
        tomllib.loads(text)
    told = toml_error(caught.value, text)
    assert told.startswith("at line 3, column ") and words in told and not told.endswith(".")


@pytest.mark.parametrize("text", ["x = [1, 2", 'x = "abc', "= 3", "x = 1\nx = 2", "[a", "x = ["])
def test_a_cause_without_a_remedy_keeps_its_place(text: str) -> None:
    with pytest.raises(tomllib.TOMLDecodeError) as caught:
        tomllib.loads(text)
    told = toml_error(caught.value, text)
    assert "line" in told or "at its end" in told


@pytest.mark.parametrize("value", ["1.2", "ninjaflex", "", "cm", "[1, 2]", "1e-3"])
def test_what_is_written_right_has_no_hint(value: str) -> None:
    assert value_hint(value) == ""


def test_a_unit_of_another_kind_is_not_converted() -> None:
    assert "80" not in value_hint("8 cm", "MPa").replace("8 cm", "")
    assert value_hint("8 MPa", "mm") == "write the number alone, without “MPa”, in mm"
