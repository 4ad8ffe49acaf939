"""Excel workbooks are read as tables of text are; without openpyxl one sentence says what to do."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tensile import curve, table

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.loading import load_measurements
from bellows_design.materials.measurements.options import ReadingOptions

STRAIN, STRESS = curve()


def workbook(folder: Path, *rows: list[Any], percent: bool = False) -> Path:
    """A workbook with these rows above the test; strains as Excel shows per cent, if asked for."""
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.create_sheet("Notes")
    for row in rows:
        book.active.append(row)
    for strain, stress in zip(STRAIN.tolist(), STRESS.tolist(), strict=True):
        book.active.append([strain, stress])
        if percent:
            book.active.cell(book.active.max_row, 1).number_format = "0.0%"
    book.save(folder / "it.xlsx")
    return folder / "it.xlsx"


def test_a_workbook_is_read_with_its_preamble_and_units(tmp_path: Path) -> None:
    path = workbook(tmp_path, ["Specimen", 1], [None], ["Strain", "Stress"], ["mm/mm", "MPa"])
    data = load_measurements(path)
    assert data.stretch == pytest.approx(1 + STRAIN, rel=1e-12)
    assert data.stress == pytest.approx(STRESS, rel=1e-12)
    assert any("the sheet “Sheet” is read" in note for note in data.reading.notes)


def test_cells_shown_as_per_cent_are_per_cent_whatever_the_header_says(tmp_path: Path) -> None:
    for header in ("Strain (%)", "Strain"):
        data = load_measurements(workbook(tmp_path, [header, "Stress (MPa)"], percent=True))
        assert data.stretch == pytest.approx(1 + STRAIN, rel=1e-9)


def test_decimal_signs_do_not_concern_numbers_of_a_workbook(tmp_path: Path) -> None:
    path = workbook(tmp_path, ["strain [-]", "stress_mpa"])
    data = load_measurements(path, ReadingOptions(decimal="comma"))
    assert data.stretch == pytest.approx(1 + STRAIN)


def test_several_sheets_with_tables_are_asked_about(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    path = workbook(tmp_path, ["strain [-]", "stress_mpa"])
    book = openpyxl.load_workbook(path)
    for _ in range(3):
        book["Notes"].append([1, 2])
    book.save(path)
    with pytest.raises(DesignError, match="several sheets with tables, “Sheet”, “Notes”"):
        load_measurements(path)


def test_a_damaged_workbook_is_refused_in_one_sentence(tmp_path: Path) -> None:
    pytest.importorskip("openpyxl")
    path = tmp_path / "it.xlsx"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("nothing.txt", "x")
    content = path.read_bytes()
    for damaged in (content, content[:40], content[:4] + b"\0" * 50):
        path.write_bytes(damaged)
        with pytest.raises(DesignError, match="cannot be read as a workbook"):
            load_measurements(path)


def test_without_openpyxl_the_extra_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = "bellows_design.materials.measurements.table.workbook.find_spec"
    monkeypatch.setattr(module, lambda _: None)
    (tmp_path / "it.xlsx").write_bytes(b"PK\x03\x04")
    with pytest.raises(DesignError, match=r"the extra “xlsx”: pip install -e '.\[xlsx\]'"):
        load_measurements(tmp_path / "it.xlsx")


def test_a_workbook_under_another_name_is_known_by_its_content(tmp_path: Path) -> None:
    path = workbook(tmp_path, ["strain [-]", "stress_mpa"])
    other = path.rename(tmp_path / "it.csv")
    assert load_measurements(other).stretch.size == np.size(STRAIN)
    plain = tmp_path / "plain.xlsx"
    plain.write_text(table("strain [-],stress_mpa", STRAIN, STRESS), "utf-8")
    assert load_measurements(plain).stretch.size == np.size(STRAIN)
