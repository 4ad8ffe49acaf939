"""Run all verification cases and write docs/verification.md.

    python tests/verification/document.py [name ...]

With names, runs the cases whose names start so and prints their sections instead.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from case import Case, Order, Outcome, Row
from catalogue import DOCUMENT, all_cases, families
from sections import NOISE, section, summary

INTRODUCTION = """# Verification

What the solver computes against closed forms and published values. Written by
`python tests/verification/document.py`; the tests in `tests/verification` run the same cases and
fail when a number leaves its tolerance, an order of convergence falls short, or this document
differs from what they print. Errors are rounded up to 1, 2 or 5 times a power of ten; what is below
a thousandth of the tolerance, or 1e-13, is not told apart. Units: mm, N, MPa.

| case | numbers | worst error | its tolerance | observed orders (theory) |
|---|---|---|---|---|
"""


def run(case: Case) -> Outcome:
    """Run a case; report seconds and what is wrong on the terminal."""
    start = time.perf_counter()
    outcome = case.run()
    print(f"{case.name}: {time.perf_counter() - start:.1f} s", flush=True)
    for row in outcome.rows:
        if not row.error <= row.tolerance:
            print("  out of tolerance:", row, f"error {row.error:.3g}", flush=True)
    for order in outcome.orders:
        if not order.observed >= order.least:
            print("  order too low:", order, flush=True)
    for part in shaky(case, outcome):
        print("  may print differently elsewhere:", part, flush=True)
    return outcome


def shaky(case: Case, outcome: Outcome) -> list[Row | Order]:
    """What prints differently after a change that another machine's rounding may make."""

    def texts(part: Row | Order) -> set[str]:
        if isinstance(part, Row):
            share = min(SHAKE, 0.1 * NOISE * part.tolerance)
            rows = [replace(part, ours=part.ours * (1 + s * share)) for s in (-1, 0, 1)]
            return {section(case, Outcome((row,))) for row in rows}
        orders = [replace(part, observed=part.observed * (1 + s * SHAKE)) for s in (-1, 0, 1)]
        return {section(case, Outcome((), (order,))) for order in orders}

    return [part for part in (*outcome.rows, *outcome.orders) if len(texts(part)) > 1]


SHAKE = 1e-6
"""A share by which results of Newton's method may differ between machines, generously."""


def document() -> str:
    """The whole document."""
    outcomes = {case.name: run(case) for case in all_cases()}
    lines = "\n".join(summary(case, outcomes[case.name]) for case in all_cases())
    text = INTRODUCTION + lines + "\n"
    for family in families():
        text += f"\n## {family.title}\n\n"
        text += "\n".join(section(case, outcomes[case.name]) for case in family.cases)
    return text


def main(names: list[str]) -> None:
    """Write the document, or print the sections of the cases whose names start as asked."""
    if not names:
        DOCUMENT.write_text(document(), encoding="utf-8")
    for case in all_cases():
        if names and case.name.startswith(tuple(names)):
            outcome = run(case)
            print(section(case, outcome), summary(case, outcome), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
