"""A hard case: what could go wrong, what is done about it, and a run that shows it.

What a run finds is text that every machine prints the same: counts, bounds, few digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rounding import next_step

NOISE = 1e-3


@dataclass(frozen=True)
class Finding:
    """One measured thing as ``text``, whether it is ``good``, and the bare number for a failure."""

    text: str
    good: bool
    detail: str = ""


@dataclass(frozen=True)
class HardCase:
    """One row of ``docs/hard-cases.md``.

    ``slow`` cases run with ``pytest -m slow``; those that need ``inertia`` are not for SuperLU.
    ``missing``: the good behaviour that is not there yet; the test is then expected to fail,
    strictly.
    """

    name: str
    risk: str
    behaviour: str
    run: Callable[[], tuple[Finding, ...]]
    slow: bool = False
    inertia: bool = False
    missing: str = ""


def row(case: HardCase, findings: tuple[Finding, ...]) -> str:
    """The line of a case in Markdown."""
    measured = "; ".join(finding.text for finding in findings)
    if case.missing:
        measured = f"**open:** {case.missing}"
    return f"| {case.name} | {case.risk} | {case.behaviour} | {measured} |"


def below(what: str, value: float, limit: float, unit: str = "") -> Finding:
    """A number that may be anything under its limit, such as rounding: the limit is printed."""
    return Finding(f"{what} < {_plain(limit, unit)}", value < limit, f"{value:.4g}")


def at_most(what: str, value: float, limit: float, unit: str = "") -> Finding:
    """A number that every machine finds alike, printed as the next of 1, 2, 5, 10, ... above it.

    Nothing below a thousandth of the limit is told apart: that much may be rounding.
    """
    bound = next_step(max(abs(value), NOISE * limit)) if math.isfinite(value) else math.inf
    return Finding(f"{what} ≤ {_plain(bound, unit)}", abs(value) <= limit, f"{value:.4g}")


def within(what: str, value: float, low: float, high: float, unit: str = "") -> Finding:
    """A number between two bounds; the bounds are printed."""
    text = f"{what} between {_plain(low)} and {_plain(high, unit)}"
    return Finding(text, low <= value <= high, f"{value:.6g}")


def exactly(what: str, value: int | str | bool, expected: int | str | bool) -> Finding:
    """A count or a word."""
    return Finding(f"{what}: {value}", value == expected, f"{value!r}, not {expected!r}")


def true(what: str, holds: bool, detail: object = "") -> Finding:
    """A plain statement."""
    return Finding(what, bool(holds), str(detail))


def refused(what: str, calls: dict[str, tuple[Callable[[], object], str]]) -> Finding:
    """How many calls, by label, raise a ``ValueError`` of one sentence that has the given words."""
    wrong = [f"{label}: {_answer(call, words)}" for label, (call, words) in calls.items()]
    wrong = [text for text in wrong if not text.endswith(": ok")]
    good = len(calls) - len(wrong)
    return Finding(f"{what}: {good} of {len(calls)} refused by name", not wrong, "; ".join(wrong))


def _answer(call: Callable[[], object], words: str) -> str:
    try:
        call()
    except ValueError as error:
        text = str(error)
        return "ok" if words in text and text.endswith(".") else f"said {text!r}"
    except Exception as error:  # any other kind is not the refusal that was asked for
        return f"raised {error!r}"
    return "was taken"


def _plain(value: float, unit: str = "") -> str:
    return f"{value:.4g} {unit}".strip().replace("e-0", "e-").replace("e+0", "e")
