"""A study of sensitivities as tables for people, within 80 columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.neighbours.sensitivities import ANGLE, STRESS, VOLUME
from bellows_design.reports.sensitivities import elasticities_table

if TYPE_CHECKING:
    from bellows_design.study.sensitivity.indices import Index
    from bellows_design.study.sensitivity.spread import Global, Spread
    from bellows_design.study.sensitivity.study import Study
    from bellows_design.study.sensitivity.tolerance import Contribution, Tolerated

TITLES = {ANGLE: "bending angle", STRESS: "highest stress", VOLUME: "cavity volume"}
SHORT = {ANGLE: "angle", STRESS: "stress", VOLUME: "volume"}
UNITS = {ANGLE: "°", STRESS: " MPa"}
DIGITS = {ANGLE: 1, STRESS: 3}


def sensitivity_tables(study: Study) -> Sequence[RenderableType]:
    """Elasticities, Sobol' indices, tolerances, and at the end both results with margins."""
    tables = list(elasticities_table(study.sensitivities))
    if study.spread is not None:
        tables += _global(study.spread)
    return [*tables, *_tolerances(study.tolerated)]


def _global(spread: Global) -> Iterator[RenderableType]:
    table = _empty(f"Sobol' indices over ± {spread.sample.box.percent:.3g} %", "parameter")
    for short in SHORT.values():
        table.add_column(f"{short}\nfirst", justify="right", no_wrap=True)
        table.add_column("\ntotal", justify="right", no_wrap=True)
    for first in spread.spreads[ANGLE].indices:
        own = [_index(spread.spreads[response], first.parameter) for response in SHORT]
        shares = (share for index in own for share in (index.first, index.total))
        table.add_row(first.parameter, *(f"{share:.3f}" for share in shares))
    yield table
    yield _errors(spread)
    yield from map(Text, _global_notes(spread))


def _index(spread: Spread, parameter: str) -> Index:
    return next(index for index in spread.indices if index.parameter == parameter)


def _global_notes(spread: Global) -> Iterator[str]:
    sample = spread.sample
    count = len(spread.answers)
    yield f"By polynomials fitted to {count - spread.failed} of {count} designs and derivatives,"
    yield f"sampled to ± {_sampling(spread):.2g} (95 %)."
    if sample.box.percent < spread.asked_percent:
        yield (
            f"The box is ± {sample.box.percent:.3g} instead of {spread.asked_percent:g} %, where "
            "few designs had the same faces."
        )
    for number, what in (
        (sample.redrawn, "were no designs of the same faces and bubbles, and drawn anew"),
        (sample.drawn_in, "lay beyond the reach of neighbours, and were drawn in"),
        (spread.ordinary, "were evaluated by themselves, on meshes of their own"),
    ):
        if number:
            yield f"{number} points {what}."


def _sampling(spread: Global) -> float:
    """The widest of the intervals."""
    return max(
        max(index.first_confidence, index.total_confidence)
        for each in spread.spreads.values()
        for index in each.indices
    )


def _errors(spread: Global) -> Table:
    """How good the polynomials are."""
    table = _empty("polynomials, at designs held out", "response")
    for heading in ("terms", "R²", "off, root mean square", "largest"):
        table.add_column(heading, justify="right", no_wrap=True)
    for response, title in TITLES.items():
        surrogate = spread.spreads[response].surrogate
        error = surrogate.error
        table.add_row(
            title,
            f"{len(surrogate.coefficients)}",
            f"{error.r_squared:.4f}",
            f"{error.root_mean_square_percent:.2f} %",
            f"{error.largest_percent:.2f} %",
        )
    return table


def _tolerances(tolerated: Tolerated) -> Iterator[RenderableType]:
    table = _empty("tolerances: changes at the upper end, by derivatives", "cause")
    for response, unit in UNITS.items():
        table.add_column(f"{SHORT[response]}, {unit.strip()}", justify="right")
    for each in tolerated.contributions:
        label = ("  " if each.cause.part_of else "") + each.cause.label
        table.add_row(label, *(_change(each.changes, response) for response in UNITS))
    yield table
    checked = [each for each in tolerated.contributions if each.check is not None]
    if checked:
        yield _checks(checked)
    for each in tolerated.contributions:
        if each.unchecked:
            yield Text(f"{each.cause.label}: not evaluated at its ends: {each.unchecked}")
    for response in UNITS:
        yield from map(Text, _result(tolerated, response))


def _checks(contributions: Sequence[Contribution]) -> Table:
    """Evaluations at both ends, and how far the one farther off is from the derivative."""
    table = _empty("the largest, evaluated at both ends", "cause")
    for response, unit in UNITS.items():
        table.add_column(f"{SHORT[response]}, {unit.strip()}", justify="right", no_wrap=True)
        table.add_column("off", justify="right", no_wrap=True)
    for each in contributions:
        table.add_row(each.cause.label, *_check(each))
    return table


def _check(each: Contribution) -> Iterator[str]:
    assert each.check is not None
    for response in UNITS:
        ends = (each.check.lower, each.check.upper)
        yield " / ".join(_change(end, response) for end in ends)
        off = each.check.nonlinearity_percent.get(response)
        yield "" if off is None else f"{off:.1f} %"


def _change(changes: Mapping[str, float], response: str) -> str:
    return f"{changes[response]:+.{DIGITS[response]}f}"


def _result(tolerated: Tolerated, response: str) -> Iterator[str]:
    """The result with its margins, then their sums."""
    margins = tolerated.margins[response]
    of_each = [
        f"± {_value(margin.likely, response)} ({source})"
        for source, margin in margins.items()
        if margin is not None and source != "total"
    ]
    value = _value(tolerated.values[response], response)
    last = "" if response == ANGLE else UNITS[response]
    yield f"{TITLES[response]}: {' '.join([value, *of_each])}{last}"
    total = margins["total"]
    if total is not None:
        likely, worst = _value(total.likely, response), _value(total.worst, response)
        yield (
            f"  together ± {likely}{last} (root of the sum of squares), at worst ± {worst}{last}"
        )


def _value(value: float, response: str) -> str:
    return f"{value:.0f}°" if response == ANGLE else f"{value:.2f}"


def _empty(title: str, first: str) -> Table:
    table = Table(title=title, title_justify="left", box=SIMPLE, pad_edge=False)
    table.add_column(first, no_wrap=True)
    return table
