"""Run a sample of the tests: file by file in an order that the commit decides, until time is up.

    PYTHONPATH=tests/support pytest -p sampled -m slow --sample-minutes 15

The same commit gives the same order, another one another, so that over some commits all have their
turn. Tests that are not begun in time are skipped, and say so. Those of a file stay together, as
they share what is expensive to set up.
"""

from __future__ import annotations

import subprocess
import time
from hashlib import sha256
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--sample-minutes", type=float, default=15.0, help="Time to begin tests in.")
    parser.addoption("--sample-seed", default="", help="Decides the order; the commit without it.")


def pytest_configure(config: pytest.Config) -> None:
    config.stash[ENDS] = time.monotonic() + 60 * config.getoption("--sample-minutes")


ENDS = pytest.StashKey[float]()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    seed = config.getoption("--sample-seed") or _commit()
    items.sort(key=lambda item: sha256(f"{seed} {item.location[0]}".encode()).digest())


def pytest_runtest_setup(item: pytest.Item) -> None:
    if time.monotonic() > item.config.stash[ENDS]:
        pytest.skip("not in this sample: its time is up")


def _commit() -> str:
    """The commit that is tested; nothing outside of a clone."""
    command = ["git", "rev-parse", "HEAD"]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout.strip()
