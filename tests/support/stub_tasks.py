"""Tasks for the studio's processes that compute nothing: for tests of who is given what when.

What they do is chosen by the value ``stub`` of a change.
"""

from __future__ import annotations

import os
import time
from typing import Any

import numpy as np

STEP = 0.02


def tasks() -> dict[str, Any]:
    return {
        "open": _open,
        "change": _change,
        "toml": _toml,
        "cell": _slow_cell,
        "anchor": _anchor,
        "warm": _nothing,
        "preview": _work("preview"),
        "part": _nothing,
        "refine": _work("refined"),
        "sensitivities": lambda values, _, report: report("sensitivities", sensitivities=[]),
        "scene": lambda values, _, report: report("scene", keys=values["keys"]),
        "run": _nothing,
    }


def _open(values: dict[str, Any], _: Any, report: Any) -> None:
    if values["name"] == "unknown":
        raise ValueError("there is none")
    report("start", name="stub", toml="text")


def _change(values: dict[str, Any], _: Any, report: Any) -> None:
    kind = values["values"].get("stub")
    invalid = kind == "invalid"
    report("problems", problems=[{"parameter": "stub", "message": "no"}] * invalid)
    if kind == "follows":
        report("shape_follows", why="")
    elif not invalid:
        report("shape", {"payload": np.arange(3, dtype=np.uint8)}, source="morph")


def _toml(values: dict[str, Any], _: Any, report: Any) -> None:
    report("toml", name="stub", text=f"values = {sorted(values['values'])}", digest="")


def _send_cell(report: Any) -> None:
    report("cell", base="", values={}, surfaces=[])


def _anchor(_: Any, __: Any, report: Any) -> None:
    time.sleep(STEP)
    _send_cell(report)


def _slow_cell(values: dict[str, Any], _: Any, __: Any) -> None:
    time.sleep(values["values"].get("seconds", STEP))


def _nothing(_: Any, __: Any, ___: Any) -> None:
    pass


def _work(state: str) -> Any:
    def work(values: dict[str, Any], _: Any, report: Any) -> None:
        kind = values["values"].get("stub", "")
        if kind == "crash":
            os._exit(7)
        if kind == "deaf":
            report.stage("stub")
        if kind in ("hang", "deaf"):
            time.sleep(600)
        if kind == "fail":
            raise ValueError("it cannot be")
        for _ in range(500 if kind == "slow" else 1):
            report.stage("stub")
            time.sleep(STEP)
        report("answer", state=state, process=os.getpid(), values=values["values"])
        if kind == "follows":
            _send_cell(report)
            if state == "refined":
                report("evaluated", record={})

    return work
