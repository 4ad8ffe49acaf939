"""Cases of validation as text."""

from __future__ import annotations

import math
from collections.abc import Sequence

from record import Case, Interval, Report, Row, Table
from stored import all_cases, results_of

INTRODUCTION = """# Validation

What solver and pipeline compute, against parts that others made, loaded and filmed. Each case is
posed from the published figures alone; nothing is fitted but where that is said. Written by
`python tests/validation/document.py` from the results that lie beside the cases in
`tests/validation`; `python tests/validation/compute.py NAME` computes a case anew. Tests hold what
this document says against the stored results, and repeat one computation of each case.

*Measured* is an interval: over runs that were repeated, or the spread that the source states.
*Ours* is one too where the experiment leaves something open: over that, or over the materials that
were published. *Mesh error* is the estimated error of ours by the mesh. A row *agrees* if both
intervals meet, the measured one widened by what is *allowed*; where they do not, it says how far
ours lies beyond it. Seconds are those of one processor.
"""


def document() -> str:
    """The whole document."""
    sections = [section(case, report(name)) for name, case in all_cases().items()]
    lines = [summary(case, report(name)) for name, case in all_cases().items()]
    overview = _table(("case", "quantities that agree", "how well the model does"), lines)
    return "\n".join([INTRODUCTION, overview + "\n", *sections])


def report(name: str) -> Report:
    """What a case says of its stored results."""
    return all_cases()[name].report(results_of(name))


def section(case: Case, found: Report) -> str:
    """The section of a case in Markdown."""
    parts = [
        f"## {case.title}",
        f"**The part.** {found.part}",
        f"**Measured.** {found.measured}",
        f"**Posed.** {found.posed}",
        _rows(found.rows),
        f"![{case.title}]({found.figure})" if found.figure else "",
        *(_further(table) for table in found.tables),
        f"**Unknown.** {found.unknown}",
        f"**Verdict.** {found.verdict}",
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def summary(case: Case, found: Report) -> tuple[str, ...]:
    """The line of a case in the table of all."""
    anchor = "".join(c for c in case.title.lower() if c.isalnum() or c in " -_").replace(" ", "-")
    agreeing = sum(row.inside for row in found.rows)
    count = f"{agreeing} of {len(found.rows)}" if found.rows else "–"
    return f"[{case.title}](#{anchor})", count, found.verdict


def _rows(rows: Sequence[Row]) -> str:
    heading = ("quantity", "measured", "allowed", "ours", "mesh error", "agrees")
    lines = [
        (
            row.quantity,
            interval(row.measured, row.unit),
            f"± {100 * row.allowed:.3g} %" if row.allowed else "–",
            interval(row.ours, row.unit),
            "–" if row.error is None else f"{row.error:.1g} {row.unit}".rstrip(),
            "yes" if row.inside else f"{100 * row.beyond:+.0f} %",
        )
        for row in rows
    ]
    return _table(heading, lines) if rows else ""


def _further(table: Table) -> str:
    title = f"{table.title}\n\n" if table.title else ""
    return title + _table(table.heading, table.lines)


def _table(heading: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    ruler = "|" + "---|" * len(heading)
    return "\n".join(["| " + " | ".join(heading) + " |", ruler, *map(_line, lines)])


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def interval(values: Interval, unit: str = "") -> str:
    """Two numbers, or one, with three significant digits of the larger one."""
    low, high = values
    if math.isinf(high):
        return f"from {interval((low, low), unit)} on"
    scale = max(abs(low), abs(high))
    decimals = max(0, 2 - math.floor(math.log10(scale))) if scale else 0
    first, second = (f"{value:.{decimals}f}".replace("-", "−") for value in values)
    return f"{first if first == second else f'{first} … {second}'} {unit}".rstrip()
