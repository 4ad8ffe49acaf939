"""Verification cases as text that every machine prints the same.

Ours is printed to few digits and an error as the next of 1, 2, 5, 10, ... above it. Errors below
a thousandth of their tolerance, or near the rounding of double precision, are not told apart.
"""

from __future__ import annotations

import math

from case import Case, Order, Outcome, Row
from rounding import next_step

NOISE = 1e-3
ROUNDING = 1e-13
LONG = 20
HEADING = "| quantity | reference | ours | error | tolerance |\n|---|---|---|---|---|"


def section(case: Case, outcome: Outcome) -> str:
    """The section of a case in Markdown."""
    table = "\n".join([HEADING, *(_row(row) for row in outcome.rows)])
    if len(outcome.rows) > LONG:
        title = f"{len(outcome.rows)} numbers"
        table = f"<details><summary>{title}</summary>\n\n{table}\n\n</details>"
    orders = "\n".join(_order(order) for order in outcome.orders)
    origin = f"Source: {case.source}" + (f" Mesh: {outcome.mesh}." if outcome.mesh else "")
    parts = (f"### {case.name}", case.claim, table, orders, origin)
    return "\n\n".join(part for part in parts if part) + "\n"


def summary(case: Case, outcome: Outcome) -> str:
    """The line of a case in the table of all cases."""
    worst = max(outcome.rows, key=lambda row: row.error / row.tolerance)
    orders = ", ".join(f"{order.observed:.1f} ({order.theory})" for order in outcome.orders)
    anchor = "".join(c for c in case.name.lower() if c.isalnum() or c in " -_").replace(" ", "-")
    return (
        f"| [{case.name}](#{anchor}) | {len(outcome.rows)} | {_error(worst)} "
        f"| {_amount(worst.tolerance, worst)} | {orders or '–'} |"
    )


def bound(error: float, tolerance: float) -> float:
    """The next of 1, 2, 5, 10, ... at or above an error, or above what may be rounding."""
    return next_step(max(error, NOISE * tolerance, ROUNDING))


def _row(row: Row) -> str:
    unit = f" {row.unit}" if row.unit else ""
    return (
        f"| {row.quantity} | {row.reference:.6g}{unit} | {_ours(row)}{unit} "
        f"| {_error(row)} | {_amount(row.tolerance, row)} |"
    )


def _ours(row: Row) -> str:
    """Our value; of one with an absolute tolerance, a tenth of that is the last digit."""
    if not row.absolute:
        return f"{row.ours:.{row.digits}g}"
    decimals = max(0, 1 - math.floor(math.log10(row.tolerance)))
    return f"{round(row.ours, decimals) + 0.0:.{decimals}f}"


def _error(row: Row) -> str:
    return f"≤ {_amount(bound(row.error, row.tolerance), row)}"


def _amount(value: float, row: Row) -> str:
    """An error or a tolerance: in the row's unit, in per cent, or as a power of ten."""
    if row.absolute:
        return f"{_plain(value)} {row.unit}".rstrip()
    return f"{100 * value:.6g} %" if value >= 1e-5 else _plain(value)


def _plain(value: float) -> str:
    return f"{value:.3g}".replace("e-0", "e-")


def _order(order: Order) -> str:
    return (
        f"- Observed order of {order.quantity}: {order.observed:.1f} "
        f"(theory {order.theory}, at least {order.least:g})."
    )
