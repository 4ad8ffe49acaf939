"""Compilation is told of when it happens, and only then."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numba
import pytest
from numba import config

from solver.compilation import njit
from solver.numerics import first_run
from solver.numerics.first_run import told_of_compilation

ROOT = Path(__file__).parents[3]
SAYS = """
from solver.numerics.first_run import told_of_compilation
with told_of_compilation(print):
    import numpy as np
    from solver.mesh.connectivity import connected_parts
    connected_parts(np.zeros((1, 4), np.int32), 1)
"""


def doubled(x: float) -> float:
    return 2 * x


doubled.__module__ = "solver.somewhere"


def of_another_package(x: float) -> float:
    return 2 * x


def test_it_is_told_once_and_before_the_result() -> None:
    told: list[bool] = []
    first, second = (njit()(doubled) for _ in range(2))
    with told_of_compilation(told.append):
        assert first(1.0) == second(1.0) == 2.0
        assert first(1) == 2  # another type: compiled once more
    assert told == [False]


def test_what_is_compiled_already_or_by_others_is_not_told() -> None:
    told: list[bool] = []
    known = njit()(doubled)
    known(1.0)
    with told_of_compilation(told.append):
        known(1.0)
        njit()(of_another_package)(1.0)
    njit()(doubled)(1.0)
    assert told == []


def test_it_says_whether_what_is_compiled_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    told: list[bool] = []
    with told_of_compilation(told.append):
        njit(cache=True)(doubled)(1.0)
    assert told == [True]


def test_a_second_process_finds_what_the_first_one_compiled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    said = [
        subprocess.run(
            [sys.executable, "-c", SAYS], capture_output=True, check=True, encoding="utf-8"
        ).stdout
        for _ in range(2)
    ]
    assert said == ["True\n", ""]


def test_seconds_of_compilation_count_once(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter([0.0, 1.0, 4.0, 10.0, 10.5])
    monkeypatch.setattr(first_run.time, "perf_counter", lambda: next(times))
    clock = first_run.CompilationClock()
    clock.on_start(None)
    clock.on_start(None)  # a function that the first one calls
    clock.on_end(None)
    clock.on_end(None)
    assert clock.seconds == 3.0
    clock.on_start(None)
    clock.on_end(None)
    assert clock.seconds == 3.5


def test_a_clock_made_while_another_thread_compiles_counts_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Two solves side by side, the second begun within a compilation of the first one's."""
    times = iter([10.0, 12.0, 20.0, 23.0])
    monkeypatch.setattr(first_run.time, "perf_counter", lambda: next(times))
    clock = first_run.CompilationClock()
    clock.on_end(None)
    assert clock.seconds == 2.0
    clock.on_start(None)
    clock.on_end(None)
    assert clock.seconds == 5.0


def test_clock_sees_a_function_that_is_compiled() -> None:
    @numba.njit
    def twice(x: float) -> float:
        return 2 * x

    with first_run.compilation_clock() as clock:
        assert twice(1.5) == 3.0
        compiled = clock.seconds
        twice(2.5)
    assert clock.seconds == compiled > 0
