"""A sample of the tests: its order and its end."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

SUPPORT = Path(__file__).parent / "support"


def _ran(folder: Path, *options: str) -> list[str]:
    """The lines of a run over six files of two tests each."""
    for number in range(6):
        text = "def test_one():\n    pass\n\n\ndef test_two():\n    pass\n"
        folder.joinpath(f"test_file_{number}.py").write_text(text)
    found = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-v", "-p", "sampled", "-c", os.devnull),
            *("--rootdir", str(folder), *options, str(folder)),
        ],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(SUPPORT)},
    )
    return [line for line in found.stdout.splitlines() if "::test_" in line]


def _files(lines: list[str]) -> list[str]:
    return [line.partition("::")[0] for line in lines]


@pytest.mark.thorough
def test_the_order_of_files_is_the_seeds_and_their_tests_stay_together(tmp_path: Path) -> None:
    orders = {seed: _files(_ran(tmp_path, "--sample-seed", seed)) for seed in ("a", "b", "c")}
    assert orders["a"] == _files(_ran(tmp_path, "--sample-seed", "a"))
    assert len({tuple(order) for order in orders.values()}) > 1
    for order in orders.values():
        assert len(order) == 12 and order[::2] == order[1::2] and len(set(order)) == 6


def test_what_is_not_begun_in_time_is_skipped(tmp_path: Path) -> None:
    lines = _ran(tmp_path, "--sample-minutes", "0")
    assert len(lines) == 12 and all("SKIPPED" in line for line in lines)
