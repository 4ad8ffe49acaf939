"""Reading tables of measurements: what is understood, and one sentence for all else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from damage import soon
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.loading import load_measurements, parse_measurements

ROWS = [(1.1, 0.3), (1.2, 0.5), (1.5, 0.9), (2.0, 1.4), (3.0, 2.2)]


def table(header: str = "stretch,stress_mpa", rows: str | None = None) -> str:
    body = rows if rows is not None else "\n".join(f"{x},{y}" for x, y in ROWS)
    return f"{header}\n{body}\n"


def written(folder: Path, content: str | bytes) -> Path:
    path = folder / "data.csv"
    path.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)
    return path


def test_a_file_without_modes_is_uniaxial(tmp_path: Path) -> None:
    data = load_measurements(written(tmp_path, table()))
    assert data.modes == ("uniaxial",) and data.name == "data.csv"
    stretch, stress = data.of("uniaxial")
    assert stretch.tolist() == [x for x, _ in ROWS] and stress.tolist() == [y for _, y in ROWS]


def test_strain_is_stretch_less_one_and_columns_come_in_any_order() -> None:
    rows = "\n".join(f"{y},{x - 1!r},planar" for x, y in ROWS)
    data = parse_measurements(table("Stress_MPa, strain, MODE", rows), "it")
    assert data.modes == ("planar",)
    assert data.of("planar")[0] == pytest.approx([x for x, _ in ROWS])


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_separators_line_ends_comments_and_quotes(delimiter: str, end: str) -> None:
    lines = ["\ufeff# NinjaFlex; 2026, µ", "", "mode,stretch,stress_mpa # columns"]
    lines += [f' "Uniaxial" , {x} , +{y}e0 # point' for x, y in ROWS] + ["biaxial,.5,-4.", "  "]
    text = end.join(lines).replace(",", delimiter).removeprefix("\ufeff")
    data = parse_measurements(text, "it")
    assert data.modes == ("uniaxial", "biaxial") and data.stretch.size == 6
    assert data.of("biaxial")[1].tolist() == [-4.0]


def test_a_byte_order_mark_is_no_column(tmp_path: Path) -> None:
    assert load_measurements(written(tmp_path, "\ufeff" + table())).stress.size == 5


def test_the_fitted_range_is_that_of_all_principal_strains() -> None:
    assert parse_measurements(table(), "it").valid_strain == pytest.approx((3**-0.5 - 1, 2.0))
    rows = "\n".join(f"biaxial,{x},{y}" for x, y in ROWS)
    data = parse_measurements(table("mode,stretch,stress_mpa", rows), "it")
    assert data.valid_strain == pytest.approx((1 / 9 - 1, 2.0))


GOOD = "\n".join(f"{x},{y}" for x, y in ROWS)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("# nothing\n\n", "is empty"),
        (table("stretch,stress"), "line 1: the column “stress” has no unit; --units stress=UNIT"),
        (table("stretch,stres_mpa"), "line 1 names the columns “stretch, stres_mpa” (stretch, ?)"),
        (table("stretch,stretch"), "none is a stress; name them with --columns"),
        (table("stretch,strain,stress_mpa"), "both columns stretch and strain"),
        (table("mode,stress_mpa"), "none is a strain or none is a stress"),
        (table("mode,stretch"), "none is a stress; name them with --columns"),
        (table("stretch;stress_mpa,"), "name them with --columns"),
        ("1.1,0.3\n1.2,0.5\n", "names no columns above line 1"),
        (table(rows="1.1,0.3"), "has 1 point but must have at least 5"),
        (table(rows=GOOD + "\n1.2"), "line 7 has 1 value but the header names 2 columns"),
        (table(rows=GOOD + "\n1,2,0,5"), "decimal commas need semicolons between them"),
        (table("stretch;stress_mpa", "1,2;0,5\n1.3;0.7"), "mixes decimal signs"),
        (table(rows=GOOD + "\n1.2,nan"), "line 7: stress_mpa is “nan” but must be a finite number"),
        (table(rows=GOOD + "\n-inf,1"), "stretch is “-inf” but must be a finite number"),
        (table(rows=GOOD + "\n1.2,1e999"), "stress_mpa is “1e999” but must be"),
        (table(rows=GOOD + "\n1.2,"), "has 1 value but the header names 2 columns"),
        (table(rows=GOOD + "\n,2"), "stretch is “” but must be a number; --skip 7-7"),
        (table(rows=GOOD + "\n1_0,2"), "stretch is “1_0” but must be a number"),
        (table(rows=GOOD + "\n٣,2"), "stretch is “٣” but must be a number"),
        (table(rows=GOOD + "\n0x1,2"), "must be a number"),
        (table(rows=GOOD + "\n__import__('os'),2"), "must be a number"),
        (
            table(rows=GOOD + "\n0,-1"),
            "line 7: stretch is a stretch of 0 but must lie between 0.05",
        ),
        (table(rows=GOOD + "\n-1.5,-1"), "is a stretch of -1.5 but must lie between 0.05 and 20"),
        (table("strain [-],stress_mpa", GOOD + "\n100,1.2"), "as strain from -0.95 to 19"),
        (table("strain [-],stress_mpa", GOOD + "\n100,1.2"), "--units tells it"),
        (table("strain [-],stress_mpa", GOOD + "\n-1,-1.2"), "is a stretch of 0 but must lie"),
        (table(rows=GOOD + "\n4,350000"), "350000 MPa but must lie between -1000 and 1000"),
        (table(rows=GOOD + "\n0.5,2"), "2 MPa at stretch 0.5 but must be negative in compression"),
        (table(rows=GOOD + "\n2.5,-2"), "-2 MPa at stretch 2.5 but must be positive in tension"),
        (table(rows="\n".join(["1.2,1e-9"] * 5)), "no stress above 1e-06 MPa"),
        (table(rows="\n".join(f"{x},{y * 400}" for x, y in ROWS)), "which no elastomer has"),
        (table("mode,stretch,stress_mpa", "shear,1.2,3"), "mode is “shear”; known are uniaxial"),
        (table("mode,stretch,stress_mpa", "biaxal,1.2,3"), "did you mean biaxial"),
        (table("mod,stretch,stress_mpa", "biaxial,1.2,3"), "unknown column “mod”; did you mean"),
    ],
)
def test_what_is_not_understood_is_refused_in_one_sentence(
    tmp_path: Path, text: str, words: str
) -> None:
    with pytest.raises(DesignError) as caught:
        load_measurements(written(tmp_path, text))
    sentence = str(caught.value)
    assert words in sentence and "\n" not in sentence and sentence.endswith((".", "?"))
    assert "data.csv" in sentence


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"\xff\xfe\x00stretch,", "not a text file"),
        (b"stretch,stress_mpa\n1\x00,2\n", "null character"),
        (bytes(range(256)) * 50, "not a text file"),
        (b"#" * 20_000_001, "is larger than 20 MB"),
        (b"stretch,stress_mpa\n" + b"1.5,1\n" * 100_001, "more than 100000 points"),
    ],
)
def test_junk_and_floods_are_refused_quickly(tmp_path: Path, content: bytes, words: str) -> None:
    with soon(), pytest.raises(DesignError, match=words):
        load_measurements(written(tmp_path, content))


@pytest.mark.parametrize("given", ["missing.csv", ".", "/dev/zero", "a\0b.csv", "x" * 5000])
def test_what_is_no_file_is_refused_in_one_sentence(given: str) -> None:
    with pytest.raises(DesignError) as caught:
        load_measurements(given)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 200


WORDS = (
    *("stretch", "strain", "stress_mpa", "mode", "uniaxial", "planar", "1.5", "0.2", "-3", "1,5"),
    *("", "nan", "1e400", '"', "#", "1e-320", "2.0", "0", "\u2028", "\x85", "𝟙", "1.5.2", "é"),
)
CELLS = st.sampled_from(WORDS) | st.text(max_size=6)
TABLES = st.builds(
    lambda rows, delimiter, end: end.join(delimiter.join(row) for row in rows),
    st.lists(st.lists(CELLS, max_size=4), max_size=9),
    st.sampled_from([",", ";", "\t", " ", ",;"]),
    st.sampled_from(["\n", "\r\n", "\r"]),
)
HEADED = st.builds(lambda body: "mode,stretch,stress_mpa\n" + body, TABLES)


@given(TABLES | HEADED | st.text(max_size=200))
@settings(max_examples=300, deadline=1000)
def test_any_text_is_measurements_or_one_sentence(text: str) -> None:
    try:
        data = parse_measurements(text, "it")
    except DesignError as error:
        assert len(error.sentences) == 1 and "\n" not in str(error) and len(str(error)) < 400
    else:
        assert np.isfinite(data.stress).all() and (data.stretch > 0).all()


@given(st.binary(max_size=300))
@settings(
    max_examples=100, deadline=1000, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_any_bytes_are_measurements_or_one_sentence(tmp_path: Path, content: bytes) -> None:
    path = written(tmp_path, content)
    try:
        load_measurements(path)
    except DesignError as error:
        assert "\n" not in str(error)
