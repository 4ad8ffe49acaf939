"""One processor and fixed addresses, where the system can."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from printers.slicing.running import run
from printers.slicing.steadiness import UNSTEADY, steadiness


def test_a_steady_program_has_one_processor_and_the_same_addresses_each_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    steady = steadiness(tmp_path)
    if not steady.prefix:
        pytest.skip("this system cannot fix a program's addresses")
    code = "import os; print(len(os.sched_getaffinity(0)), id(object()), id([]), os.environ)"
    command = [*steady.prefix, sys.executable, "-I", "-c", code]
    first = run(command, tmp_path, 60, steady.environment)
    monkeypatch.setenv("MORE", "more" * 1000)
    second = run(command, tmp_path, 60, steady.environment)
    assert first.status == 0 and first.output == second.output
    assert first.output.startswith("1 ")


def test_where_the_system_cannot_nothing_stands_before_the_command(
    program: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert steadiness(tmp_path) == UNSTEADY
    for name in ("taskset", "setarch", "true"):
        program("exit 1", "").rename(tmp_path / name)
    assert steadiness(tmp_path) == UNSTEADY
    for name in ("taskset", "setarch", "true"):
        program("exit 0", "").rename(tmp_path / name)
    assert steadiness(tmp_path).prefix[0] == str(tmp_path / "taskset")
