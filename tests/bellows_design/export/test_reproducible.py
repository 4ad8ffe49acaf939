"""The same design gives the same bytes: of every file but that of times and machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
import uuid
import zipfile
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pytest
from real_command import ROOT, bellows

from bellows_design.export.formats import WRITERS, Part
from bellows_design.export.statements import rounded

OF_A_PART = """
import hashlib, json, sys
from bellows_design import load_design, with_overrides
from bellows_design.export.companions import settings_files
from bellows_design.export.contents import part_files
from bellows_design.pipeline import build_part
for length in (26, 18):  # the part in question is the second that the process writes
    design = with_overrides(load_design("finger"), [f"length={length}", "number_of_bubbles=2"])
    part = build_part(design)
    files = part_files(part) | settings_files(part)
print(json.dumps({name: hashlib.sha256(files[name]).hexdigest() for name in files}))
"""
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


def ended(code: str, threads: int, folder: Path) -> str:
    """What a process prints in a folder of its own, with so many threads and its own hashes."""
    names = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "PYTHONHASHSEED")
    variables = {**os.environ, "PYTHONPATH": str(ROOT), "TZ": f"UTC+{threads}"}
    variables |= dict.fromkeys(names, str(threads))
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=variables, capture_output=True, check=True
    )
    return done.stdout.decode()


@pytest.mark.slow
def test_two_processes_build_the_same_bytes(tmp_path: Path) -> None:
    places = [tmp_path / "one", tmp_path / "two"]
    for place in places:
        place.mkdir()
    one, two = (json.loads(ended(OF_A_PART, *each)) for each in zip((1, 2), places, strict=True))
    assert one == two and len(one) == 7


@pytest.mark.slow
def test_two_runs_of_the_command_write_the_same_bytes(tmp_path: Path, own_cache: Path) -> None:
    """Computed by one thread or two, or taken from the cache, in other folders."""
    contents = []
    options = [word for setting in SHORT for word in ("--set", setting)]
    for threads, how in ((1, "--no-cache"), (2, "--json"), (2, "--json")):
        place = tmp_path / str(len(contents))
        place.mkdir()
        variables = {"BELLOWS_SLICER": "", "PYTHONHASHSEED": str(threads)}
        variables |= {"OMP_NUM_THREADS": str(threads), "NUMBA_NUM_THREADS": str(threads)}
        run = bellows(
            "run", "finger", *options, "--output", "out", how,
            variables=variables, folder=place, seconds=300,
        )  # fmt: skip
        assert run.status == 0, run.err
        files = {file.name: file.read_bytes() for file in (place / "out" / "short").iterdir()}
        machine = json.loads(files.pop("run.json"))
        contents.append((files, machine["from_cache"] is not None))
    assert [cached for _, cached in contents] == [False, False, True]
    assert contents[0][0] == contents[1][0] == contents[2][0]
    assert len(contents[0][0]) == 11
