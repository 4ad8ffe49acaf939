"""The results file: nothing is doubled, only its own study goes on, and rows are designs again."""

from __future__ import annotations

import csv
import re
import sqlite3
import time
from contextlib import ExitStack, closing
from dataclasses import fields, replace
from pathlib import Path

import pytest

from bellows_design.batch.answer import Answer, failed
from bellows_design.batch.export import write_csv, write_parquet
from bellows_design.batch.question import Question
from bellows_design.batch.results import Study, opened, reading
from bellows_design.batch.schema import COLUMNS, VERSION, Row
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.design.variation import varied
from bellows_design.errors import DesignError
from bellows_design.files.errors import CannotWrite

FINGER = load_design("finger")
STUDY = Study("sweep", FINGER, {"seed": 1})
NEAR = varied(FINGER, {"bubble_width": 19.7})
QUESTION = Question(NEAR)


def done(angle: float = 400.0) -> Answer:
    return Answer(
        key=QUESTION.key,
        digest=NEAR.digest,
        bending_angle_deg=angle,
        warnings=("thin, “very”", "curled"),
        origin="neighbour",
        derivatives={"bending_angle_deg": {"bubble_width": -1.5}},
    )


@pytest.fixture
def file(tmp_path):
    return tmp_path / "sweep ü#?%.sqlite"


def test_a_row_comes_back_as_it_was(file):
    row = Row(done(), NEAR, {"bubble_width": 19.7}, 3)
    with opened(file, STUDY) as results:
        results.keep(row)
    with reading(file) as results:
        assert list(results.rows()) == [row]
        assert results.row(QUESTION.key) == row
        assert results.row("none") is None
        assert results.study.options == STUDY.options


def test_answers_are_read_without_their_designs(file, monkeypatch):
    rows = [Row(done(), NEAR), Row(replace(failed(QUESTION, "no"), key="x"), NEAR, {}, 1)]
    with opened(file, STUDY) as results:
        results.keep(*rows)
        monkeypatch.setattr(Design, "of", lambda _: pytest.fail("a design is made"))
        assert list(results.answers()) == [row.answer for row in rows]


@pytest.mark.parametrize("name", shipped_designs())
def test_every_shipped_design_comes_back_as_toml(file, name):
    design = varied(load_design(name), {"load.pressure": 0.04})
    with opened(file, STUDY) as results:
        results.keep(Row(replace(done(), digest=design.digest), design))
        (row,) = results.rows()
    assert row.design.to_toml() == design.to_toml()
    assert row.design.digest == row.answer.digest


def test_an_answer_stays_and_a_failure_gives_way(file):
    with opened(file, STUDY) as results:
        results.keep(Row(failed(QUESTION, "no mesh"), NEAR))
        assert results.statuses() == {QUESTION.key: "failed"}
        results.keep(Row(done(400.0), NEAR))
        results.keep(Row(done(300.0), NEAR), Row(failed(QUESTION, "no mesh"), NEAR))
        (row,) = results.rows()
    assert row.answer == done(400.0)


def test_after_a_run_there_is_one_file_that_is_intact(file):
    with opened(file, STUDY) as results:
        results.keep(Row(done(), NEAR))
    assert list(file.parent.iterdir()) == [file]
    with closing(sqlite3.connect(file)) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        assert connection.execute("PRAGMA user_version").fetchone() == (VERSION,)


def test_a_reader_sees_answers_while_they_are_written_and_cannot_write(file):
    with opened(file, STUDY) as results:
        results.keep(Row(done(), NEAR))
        with reading(file) as other:
            assert list(other.statuses()) == [QUESTION.key]
            with pytest.raises(CannotWrite):
                other.keep(Row(done(), NEAR))


def test_the_end_does_not_wait_for_a_reader_and_loses_nothing(file):
    """A write waits a minute for one; the end would take as long without a bound of its own."""
    with ExitStack() as readers:
        with opened(file, STUDY) as results:
            results.keep(Row(done(), NEAR))
            reader = readers.enter_context(closing(sqlite3.connect(file, isolation_level=None)))
            reader.execute("BEGIN")
            reader.execute("SELECT * FROM answer").fetchall()
            results.keep(Row(replace(done(), key="x"), NEAR))
            waits = results._connection.execute("PRAGMA busy_timeout").fetchone()[0]
            began = time.monotonic()
        assert time.monotonic() - began < waits / 1000 / 4
        with reading(file) as other:
            assert set(other.statuses()) == {QUESTION.key, "x"}
    with opened(file, STUDY):
        pass
    assert list(file.parent.iterdir()) == [file]


@pytest.mark.parametrize(
    ("study", "difference"),
    [
        (Study("sweep", NEAR, {"seed": 1}), "design"),
        (Study("sweep", FINGER, {"seed": 2}), "seed"),
        (Study("sweep", FINGER, {"seed": 1, "more": [1]}), "more"),
        (Study("optimum", FINGER, {"seed": 1}), "kind"),
    ],
)
def test_another_study_does_not_go_on_with_a_file(file, study, difference):
    with opened(file, STUDY):
        pass
    before = file.read_bytes()
    with pytest.raises(DesignError, match=f"differs in {difference};"), opened(file, study):
        pass
    assert file.read_bytes() == before
    assert list(file.parent.iterdir()) == [file]


def test_another_process_cannot_write_at_the_same_time(file):
    refused = pytest.raises(DesignError, match="another process")
    with opened(file, STUDY), refused, opened(file, STUDY):
        pass
    with opened(file, STUDY):  # but afterwards
        pass


@pytest.mark.parametrize("content", [b"hello " * 200, b"SQLite format 3\x00" + b"?" * 2000])
def test_what_is_no_database_is_refused_in_a_sentence_and_stays(file, content):
    file.write_bytes(content)
    with pytest.raises(DesignError, match="no results file, or damaged"), opened(file, STUDY):
        pass
    assert file.read_bytes() == content


def test_a_database_of_another_program_is_refused_and_stays(file):
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("CREATE TABLE mine (x)")
    before = file.read_bytes()
    for use in (lambda: opened(file, STUDY), lambda: reading(file)):
        with pytest.raises(DesignError, match="another program"), use():
            pass
    assert file.read_bytes() == before


def test_tables_of_a_later_version_are_refused(file):
    with opened(file, STUDY):
        pass
    with closing(sqlite3.connect(file)) as connection:
        connection.execute(f"PRAGMA user_version = {VERSION + 1}")
    with pytest.raises(DesignError, match=f"version {VERSION + 1}"), opened(file, STUDY):
        pass


def test_a_damaged_file_is_refused_in_a_sentence(file):
    with opened(file, STUDY) as results:
        designs = [varied(FINGER, {"bubble_width": 19 + 1e-3 * step}) for step in range(300)]
        results.keep(
            *(
                Row(failed(Question(each), "no"), each, position=at)
                for at, each in enumerate(designs)
            )
        )
    content = bytearray(file.read_bytes())
    content[8192:16384] = b"\xa5" * 8192
    file.write_bytes(content)
    with pytest.raises(DesignError, match="damaged"), opened(file, STUDY):
        pass


def test_a_file_without_a_study_is_begun_but_not_read(file):
    file.touch()  # as a process leaves it that is killed at once
    with pytest.raises(DesignError, match="no study yet"), reading(file):
        pass
    with opened(file, STUDY) as results:
        assert results.statuses() == {}


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    with pytest.raises(CannotWrite), opened(tmp_path / "no" / "x.sqlite", STUDY):
        pass
    with pytest.raises((CannotWrite, DesignError)), opened(tmp_path, STUDY):
        pass


def test_every_column_is_described():
    page = (Path(__file__).parents[3] / "docs/scale.md").read_text("utf-8")
    described = set(re.findall(r"`(\w+)`", page))
    study = {"kind", "base", "options", "created", "versions"}
    assert {field.name for field in fields(Answer)} < set(COLUMNS)
    assert {*COLUMNS, *study} <= described


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_a_table_has_every_answer_and_what_was_varied(file, tmp_path, form):
    if form == "parquet":
        pytest.importorskip("pyarrow")
    table = tmp_path / f"sweep.{form}"
    with opened(file, STUDY) as results:
        results.keep(Row(done(), NEAR, {"bubble_width": 19.7}, 0))
        results.keep(
            Row(replace(failed(QUESTION, "no, “design”"), key="x"), None, {"offset": 1.0}, 1)
        )
        (write_csv if form == "csv" else write_parquet)(results, table)
    first, second = read(table)
    assert float(first["bubble_width"]) == 19.7 and float(first["bending_angle_deg"]) == 400.0
    assert (second["status"], second["reason"]) == ("failed", "no, “design”")
    assert second["bending_angle_deg"] in ("", None) and float(second["offset"]) == 1.0
    assert {path.name for path in tmp_path.iterdir()} == {file.name, table.name}


def read(table):
    if table.suffix == ".csv":
        with table.open(encoding="utf-8", newline="") as lines:
            return list(csv.DictReader(lines))
    from pyarrow import parquet

    return parquet.read_table(table).to_pylist()
