"""Sentences on bad values, swept over every key of a design and a printer."""

from __future__ import annotations

import re
import tomllib
from importlib.resources import files
from typing import Any

import pytest

from bellows_design.design import load_design, with_overrides
from bellows_design.design.overrides import known_keys
from bellows_design.errors import DesignError
from printers import Filament, PrinterProfile, PrintersError, SlicerAdvice, profile_from_table

VALUES = ("none", "true", "nan", "-inf", '"8 cm"', '"1,2"', "[]", "{}", "1e400", "9" * 400, "''")
PYTHON_WORDS = re.compile(r"\b(None|True|False|NoneType|none (mm|MPa|%)|true (mm|MPa|%))\b")


def told_by_design(assignment: str) -> tuple[str, ...]:
    try:
        with_overrides(load_design("finger"), [assignment])
    except DesignError as error:
        return error.sentences
    return ()


@pytest.mark.parametrize("value", VALUES)
def test_no_sentence_on_a_design_speaks_python_or_gives_words_a_unit(value: str) -> None:
    told = {key: told_by_design(f"{key}={value}") for key in known_keys()}
    sentences = [sentence for each in told.values() for sentence in each]
    assert len(sentences) > 10
    assert [each for each in sentences if PYTHON_WORDS.search(each)] == []
    assert all(each.endswith((".", "?")) and each.count("\n") == 0 for each in sentences)


def test_every_key_that_cannot_be_none_says_so() -> None:
    for key, told in ((key, told_by_design(f"{key}=none")) for key in known_keys()):
        for sentence in told:
            assert re.search(r"cannot be none|is missing|needs|must|unknown", sentence), key


BAD = (None, True, "3", "3,5", "8 cm", float("nan"), float("inf"), 10**400, [], {}, -1)


@pytest.mark.parametrize("record", [PrinterProfile, SlicerAdvice, Filament])
def test_numbers_of_a_printer_take_neither_text_nor_true(record: Any) -> None:
    table = tomllib.loads((files("printers") / "profiles/prusa_i3.toml").read_text("utf-8"))
    for key, field in record.model_fields.items():
        for bad in BAD:
            if field.annotation not in (int, float) and not (field.annotation is bool and bad):
                continue
            if field.annotation is bool and bad is True:
                continue
            soft = {"extends": "ninjaflex_85a", "name": "soft"}
            changed = table | {"slicer": dict(table["slicer"]), "filament": soft}
            tables = {PrinterProfile: changed, SlicerAdvice: changed["slicer"], Filament: soft}
            tables[record][key] = bad
            with pytest.raises(PrintersError) as caught:
                profile_from_table(changed)
            told = str(caught.value)
            assert key in told and "\n" not in told and not PYTHON_WORDS.search(told)


def test_true_for_a_count_and_text_for_a_length_of_a_printer_are_refused() -> None:
    table = tomllib.loads((files("printers") / "profiles/prusa_i3.toml").read_text("utf-8"))
    with pytest.raises(PrintersError, match="perimeters is true; it must be a whole number"):
        profile_from_table(table | {"slicer": table["slicer"] | {"perimeters": True}})
    with pytest.raises(PrintersError, match=r"line_width is '0,4'.*write 0.4, not 0,4"):
        profile_from_table(table | {"line_width": "0,4"})
    with pytest.raises(PrintersError, match=r"build_volume\.1 is '210'; it must be a number"):
        profile_from_table(table | {"build_volume": [250, "210", 210]})


@pytest.mark.parametrize(
    ("assignment", "words"),
    [
        ("load.pressure=14.5", "14.5 psi would be 0.099974 MPa"),
        ("load.pressure=100", "100 kPa would be 0.1 MPa"),
        ("load.pressure=14.5psi", "14.5psi is 0.099974 MPa"),
        ("bubble_thickness=1,2", "write 1.2, not 1,2"),
        ("bubble_thickness=12mm", "write 12, in mm and without the unit"),
        ('bubble_thickness="1.2"', "write 1.2 without quotes"),
        ("bubble_width=2", "2 cm would be 20 mm"),
        ("port=none", "port cannot be none: it must be a table of keys and values."),
        ("printer=[1]", "must be the name of a printer profile"),
    ],
)
def test_a_value_written_in_another_way_is_answered_with_the_right_one(
    assignment: str, words: str
) -> None:
    (sentence,) = told_by_design(assignment)
    assert words in sentence
