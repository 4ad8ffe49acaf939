"""The cases of this folder and their stored results."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import cache
from importlib import import_module
from pathlib import Path

from record import Case, Computed, Results, Stored

HERE = Path(__file__).parent
DOCUMENT = HERE.parents[1] / "docs" / "validation.md"


@cache
def all_cases() -> Mapping[str, Case]:
    """Name -> case, from the modules ``case_NAME.py``, in the order of their titles."""
    names = [path.stem.removeprefix("case_") for path in HERE.glob("case_*.py")]
    cases = {name: import_module(f"case_{name}").CASE for name in names}
    return dict(sorted(cases.items(), key=lambda item: item[1].title))


def results_of(name: str) -> Results:
    """The stored computations of a case; none if it has no file."""
    path = _path(name)
    if not path.exists():
        return {}
    table = json.loads(path.read_text(encoding="utf-8"))
    return {key: Stored(**values) for key, values in table.items()}


def store(name: str, results: Results) -> None:
    """Write a case's results, whole or not at all, in the order of its computations."""
    order = [key for key in all_cases()[name].computations if key in results]
    table = {key: asdict(results[key]) for key in order}
    beside = _path(name).with_suffix(".part")
    beside.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    beside.replace(_path(name))


def timed(computation: Callable[[], Computed]) -> Stored:
    """Run it; seconds are those of the processor."""
    start = time.process_time()
    found = computation()
    seconds = round(time.process_time() - start, 2)
    return Stored(found.readings, found.tetrahedra, found.unknowns, seconds)


def _path(name: str) -> Path:
    return HERE / f"case_{name}.json"
