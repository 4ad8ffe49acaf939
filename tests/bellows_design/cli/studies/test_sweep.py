"""``bellows study sweep``: a file that is continued, and sentences for what is no sweep."""

from __future__ import annotations

import csv
import json
import sqlite3
from contextlib import closing

import pytest
from answering_stub import Stub

from bellows_design.batch.results import reading

SWEEP = ("study", "sweep", "finger", "--workers", "0")
GRID = ("--vary", "bubble_width=19:20:4", "--vary", "tendon_width=5:6:3")


class Asked(Stub):
    """A stub that fails for one width, and counts."""

    asked = 0

    def answer(self, question):
        from bellows_design.batch.answer import failed

        type(self).asked += 1
        if question.design.bellows.bubble_width == 19.0:
            return failed(question, "no mesh")
        return super().answer(question)


@pytest.fixture
def asked(monkeypatch):
    """In the place of evaluations."""
    kind = type("Asked", (Asked,), {})
    monkeypatch.setattr("bellows_design.batch.session.Session", kind)
    return kind


def test_a_sweep_answers_every_design_once_and_goes_on_by_the_same_command(
    bellows, asked, tmp_path
):
    file = tmp_path / "a.sqlite"
    command = (*SWEEP, *GRID, "--file", str(file), "--json")
    status, out, _ = bellows(*command)
    found = json.loads(out)
    assert (status, found["designs"], found["done"], found["failed"]) == (0, 12, 9, 3)
    assert asked.asked == found["asked"] == 12
    with closing(sqlite3.connect(file)) as connection, connection:
        connection.execute("DELETE FROM answer WHERE position IN (2, 5)")
    status, out, _ = bellows(*command)
    again = json.loads(out)
    assert (status, again["asked"], again["done"], again["failed"]) == (0, 2, 9, 3)
    assert json.loads(bellows(*command)[1])["asked"] == 0
    assert asked.asked == 14


def test_what_failed_is_asked_again_if_that_is_wished(bellows, asked, tmp_path):
    command = (*SWEEP, *GRID, "--file", str(tmp_path / "a.sqlite"), "--json")
    bellows(*command)
    again = json.loads(bellows(*command, "--retry-failed")[1])
    assert (again["asked"], again["failed"]) == (3, 3)


def test_what_is_no_design_is_recorded_and_never_asked(bellows, asked, tmp_path):
    file = tmp_path / "a.sqlite"
    status, out, _ = bellows(
        *SWEEP, "--vary", "tendon_width=5:50:4", "--file", str(file), "--json", "--retry-failed"
    )
    found = json.loads(out)
    assert status == 0 and found["asked"] == asked.asked == found["done"] < 4
    assert found["impossible"] == 4 - found["done"]
    with reading(file) as results:
        reasons = [row.answer.reason for row in results.rows() if not row.answer.done]
    assert len(reasons) == found["impossible"] and all("tendon_width" in text for text in reasons)


def test_the_answer_for_people_counts_and_the_tables_are_written(bellows, asked, tmp_path):
    table = tmp_path / "a.csv"
    status, out, err = bellows(
        *SWEEP, *GRID, "--file", str(tmp_path / "a.sqlite"), "--csv", str(table)
    )
    assert status == 0 and "9, 0 of them from a neighbour" in out and "3 failed: no mesh" in out
    assert "12 of 12 designs (3 failed)" in err and "0 s left" in err
    with table.open(encoding="utf-8") as lines:
        assert len(list(csv.DictReader(lines))) == 12
    assert {path.name for path in tmp_path.iterdir()} == {"a.sqlite", "a.csv"}


def test_a_sweep_without_any_result_says_so_by_its_status(bellows, asked, tmp_path):
    fixed = ("--vary", "bubble_width=19:19.0000001:2")
    status, out, _ = bellows(*SWEEP, *fixed, "--file", str(tmp_path / "a.sqlite"), "--json")
    assert (status, json.loads(out)["done"]) == (0, 1)
    impossible = ("--vary", "tendon_width=50:60:3")
    status, out, _ = bellows(*SWEEP, *impossible, "--file", str(tmp_path / "b.sqlite"), "--json")
    assert (status, json.loads(out)["done"]) == (3, 0)


BAD = {
    "unknown parameter": (["--vary", "bubble_with=16:20:3"], "did you mean bubble_width"),
    "reversed": (["--vary", "bubble_width=20:16:3"], "from 20 to 16"),
    "no number": (["--vary", "bubble_width=16:20"], "no number of values"),
    "number 0": (["--vary", "bubble_width=16:20", "--sample", "lhs", "-n", "0"], "has 0 designs"),
    "nothing": ([], "nothing is varied"),
    "suffix": ([*GRID, "--file", "a.db"], "must end in .sqlite"),
    "folder": ([*GRID, "--file", "folder.sqlite"], "is a folder"),
    "no folder": ([*GRID, "--file", "none/a.sqlite"], "no folder"),
    "foreign": ([*GRID, "--file", "foreign.sqlite"], "another program"),
    "csv": ([*GRID, "--csv", "a.txt"], "must end in .csv"),
    "accuracy": ([*GRID, "--accuracy", "1"], "--accuracy needs --ordinary"),
    "accuracy bound": ([*GRID, "--ordinary", "--accuracy", "0"], "between 0.01 and 100 %"),
    "seed": ([*GRID, "--seed", "-1"], "--seed is -1"),
    "workers": ([*GRID, "--workers", "-2"], "--workers is -2"),
    "both": ([*GRID, "--scheduler", "tcp://127.0.0.1:1"], "has its own"),
    "design": ([*GRID, "--set", "bubble_width=900"], "bubble_width is 900"),
}


@pytest.mark.parametrize("case", BAD)
def test_what_is_no_sweep_is_refused_in_a_sentence_and_nothing_is_written(
    bellows, tmp_path, monkeypatch, case
):
    options, sentence = BAD[case]
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.sqlite").mkdir()
    with closing(sqlite3.connect("foreign.sqlite")) as connection:
        connection.execute("CREATE TABLE mine (x)")
    before = (tmp_path / "foreign.sqlite").read_bytes()
    status, out, err = bellows(*SWEEP, *options, "--json")
    assert status == 2 and sentence in json.loads(out)["error"], (out, err)
    assert {path.name for path in tmp_path.iterdir()} == {"folder.sqlite", "foreign.sqlite"}
    assert (tmp_path / "foreign.sqlite").read_bytes() == before


@pytest.mark.parametrize(
    "address",
    [
        "nonsense",
        "tcp://host",
        "http://host:80",
        "tcp://host:eighty",
        "tcp://a..b:8786",
        f"tcp://{70 * 'a'}:8786",
        "tcp://[::1:8786",
    ],
)
def test_what_is_no_address_of_a_scheduler_is_refused(bellows, tmp_path, monkeypatch, address):
    monkeypatch.chdir(tmp_path)
    status, _, err = bellows("study", "sweep", "finger", *GRID, "--scheduler", address)
    assert status == 2 and "such as tcp://host:8786" in err and not list(tmp_path.iterdir())


def test_a_scheduler_that_does_not_listen_has_a_status_of_its_own(bellows, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, _, err = bellows("study", "sweep", "finger", *GRID, "--scheduler", "tcp://127.0.0.1:1")
    assert status == 3 and "no scheduler listens" in err and not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("module", "options", "extra"),
    [
        ("places", ["--workers", "1"], "studies"),
        ("places", ["--scheduler", "tcp://127.0.0.1:1"], "studies"),
        ("export", ["--workers", "0", "--parquet", "a.parquet"], "parquet"),
    ],
)
def test_a_library_that_is_not_installed_is_named_with_its_extra(
    bellows, tmp_path, monkeypatch, module, options, extra
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(f"bellows_design.batch.{module}.find_spec", lambda _: None)
    status, _, err = bellows("study", "sweep", "finger", *GRID, *options)
    assert status == 2 and f"the extra “{extra}”" in err and not list(tmp_path.iterdir())


def test_a_file_that_another_process_writes_is_refused(bellows, asked, tmp_path):
    from bellows_design.batch.results import opened
    from bellows_design.design.shipped import load_design
    from bellows_design.study.sweep.plan import Space, planned
    from bellows_design.study.sweep.space import axes

    finger, file = load_design("finger"), tmp_path / "a.sqlite"
    plan = planned(Space(finger, axes(GRID[1::2], finger)))
    with opened(file, plan.study):
        status, _, err = bellows(*SWEEP, *GRID, "--file", str(file))
    assert status == 2 and "another process is writing" in err and asked.asked == 0


def test_a_table_that_cannot_be_written_at_last_leaves_the_results(
    bellows, asked, tmp_path, monkeypatch
):
    def full(*_):
        from bellows_design.files.errors import CannotWrite

        raise CannotWrite("a.csv", OSError(28, "No space left on device"))

    monkeypatch.setattr("bellows_design.batch.export.write_csv", full)
    file = tmp_path / "a.sqlite"
    status, out, err = bellows(
        *SWEEP, *GRID, "--file", str(file), "--csv", str(tmp_path / "a.csv"), "--json"
    )
    assert status == 2 and "No space left" in err and json.loads(out)["done"] == 9
    with reading(file) as results:
        assert len(results.statuses()) == 12
