"""The same design gives the same bytes: of every file but that of times and machine."""

from __future__ import annotations

import time
import uuid
import zipfile
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pytest
from fakes import FakeEvaluation
from real_command import bellows

from bellows_design import load_design
from bellows_design.analysis.computation import Seconds
from bellows_design.export.formats import WRITERS, Part
from bellows_design.export.statements import rounded
from bellows_design.leak_test.record import LeakOutcome
from bellows_design.pipeline import run
from printers import RuleResult

SHORT = ["length=18", "number_of_bubbles=2", "load.pressure=0.05", "name=short"]
"""A short finger far below its limit, so that its first meshes decide."""


@pytest.mark.parametrize("suffix", WRITERS)
def test_bytes_depend_neither_on_the_time_nor_on_what_was_written_before(
    suffix: str, cube_part: Part, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = WRITERS[suffix](cube_part)
    WRITERS[suffix](replace(cube_part, name="other"))
    later = time.time() + 1e6
    monkeypatch.setattr(time, "time", lambda: later)
    assert WRITERS[suffix](cube_part) == first


def test_a_step_file_has_the_time_1970_and_a_product_without_a_count(cube_part: Part) -> None:
    text = WRITERS[".step"](cube_part).decode()
    assert "FILE_NAME('cube','1970-01-01T00:00:00'" in text and "PRODUCT('cube','cube'" in text


def test_identifiers_in_a_3mf_are_those_of_the_design(cube_part: Part) -> None:
    def identifiers(part: Part) -> set[str]:
        model = zipfile.ZipFile(BytesIO(WRITERS[".3mf"](part))).read("3D/3dmodel.model").decode()
        return {piece[:36] for piece in model.split('UUID="')[1:]}

    own, other = identifiers(cube_part), identifiers(replace(cube_part, digest="cd" * 32))
    assert len(own) == 3 and not own & other
    assert {uuid.UUID(each).version for each in own} == {5}


@pytest.mark.parametrize(
    ("value", "rounded_value"),
    [
        (102.0924016154624, 102.0924),
        (-0.2213009820644094, -0.22130098),
        (3, 3),
        (True, True),
        (None, None),
        ({"a": [1 / 3, "1.23456789012"]}, {"a": [0.33333333, "1.23456789012"]}),
    ],
)
def test_noise_of_the_linear_solver_stays_out_of_the_manifest(
    value: object, rounded_value: object
) -> None:
    assert rounded(value) == rounded_value


def test_figures_of_a_leak_test_and_times_are_in_no_file_but_that_of_the_run(
    tmp_path: Path, stub_stages: Callable[..., None]
) -> None:
    """Random seams change figures, sentences and seconds from run to run."""

    def written(number: float) -> dict[str, bytes]:
        rules = tuple(
            RuleResult(name, "warn", number, 0.95, "", f"({number}, 0, 0) mm", f"It is {number}.")
            for name in ("leak_path", "printed_depth")
        )
        test = LeakOutcome("Slicer", "1.0", "ab" * 32, rules, {"ratio": number}, 100 * number)
        seconds = Seconds(solve=number)
        stub_stages(FakeEvaluation(design=load_design("finger"), seconds=seconds))
        folder = run(load_design("finger"), tmp_path / str(number), leak_tester=lambda *_: test)
        assert folder.folder is not None
        return {file.name: file.read_bytes() for file in folder.folder.iterdir()}

    one, two = written(0.961), written(0.973)
    assert {name for name in one if one[name] != two[name]} == {"run.json"}
    assert one.keys() == two.keys()


@pytest.mark.slow
def test_two_runs_of_the_command_write_the_same_bytes(tmp_path: Path) -> None:
    """In processes of their own, by one thread or two, in other folders and time zones."""
    contents = []
    options = [word for setting in SHORT for word in ("--set", setting)]
    for threads in (1, 2):
        place = tmp_path / str(len(contents))
        place.mkdir()
        variables = {"BELLOWS_SLICER": "", "PYTHONHASHSEED": str(threads)}
        variables |= {
            "TZ": f"UTC+{threads}",
            "OMP_NUM_THREADS": str(threads),
            "NUMBA_NUM_THREADS": str(threads),
        }
        ended = bellows(
            "run", "finger", *options, "--output", "out", "--no-cache",
            variables=variables, folder=place, seconds=300,
        )  # fmt: skip
        assert ended.status == 0, ended.err
        files = {file.name: file.read_bytes() for file in (place / "out" / "short").iterdir()}
        del files["run.json"], files["short_report.html"]  # they show times
        contents.append(files)
    assert contents[0] == contents[1] and len(contents[0]) == 11
