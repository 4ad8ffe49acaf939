"""An optimum as text for people."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.study.optimize.point import Point
    from bellows_design.study.optimize.run import Optimum
    from bellows_design.study.optimize.verification import Verification


def optimum_tables(
    optimum: Optimum, designs: Mapping[str, Point], folder: Path
) -> Sequence[RenderableType]:
    """The front, what the best is and what its verification says, and what it took."""
    lines = [*_best(optimum), *_effort(optimum), f"designs, summary and results: {folder}"]
    return [_front(optimum, designs), *(Text(line) for line in lines)]


def _front(optimum: Optimum, designs: Mapping[str, Point]) -> Table:
    table = Table(
        title="no design beats these in angle and stress together",
        title_justify="left",
        box=SIMPLE,
    )
    for heading in ("design", "angle", "stress", "with error", "bubbles", "lines", "indent"):
        table.add_column(heading, justify="left" if heading == "design" else "right")
    goal = optimum.optimization.goal
    for name, point in designs.items():
        choice = point.choice
        total = point.stress_with_error
        table.add_row(
            name,
            f"{point.values['angle']:.1f}°",
            f"{point.values['stress']:.3f} MPa",
            Text(f"{total:.2f}", style="" if total <= goal.most_stress_mpa else "yellow"),
            str(choice.bubbles),
            f"{choice.bubble_lines}, {choice.tendon_lines}",
            f"{choice.indent_layers} layers" if choice.indent_layers else "none",
        )
    return table


def _best(optimum: Optimum) -> Iterator[str]:
    if optimum.best is None:
        yield "none of the designs that were evaluated keeps the limits"
        return
    if optimum.filling_seconds is not None:
        yield f"air fills the best in about {1000 * optimum.filling_seconds:.0f} ms"
    if optimum.failure:
        yield f"the best could not be verified: {optimum.failure}"
    if optimum.verification is not None:
        yield from _verification(optimum.verification)


def _verification(found: Verification) -> Iterator[str]:
    yield f"finer cell: {_numbers(found.cell)}"
    if found.half is not None:
        yield f"half actuator: {_numbers(found.half)}"
    if found.failure:
        yield f"half actuator: {found.failure}"
    if found.goal.least_force_n is not None:
        yield f"blocked force: at least {found.least_force_n:.3g} N with its error"
    if found.holds:
        yield "the best holds: printable, and within its limits with the errors stated"
    for reason in found.verdict.reasons:
        yield f"the best does not hold: {reason.rule}: {reason.message}"
    if found.verdict.approved and not found.holds:
        most = f"{found.stress_with_error_mpa:.2f} MPa with its error"
        yield f"the best does not hold: up to {most}, or another limit is not kept"


def _numbers(found: Evaluation) -> str:
    errors = found.error_estimate
    return (
        f"{found.bending_angle_deg:.1f}° (± {_percent(errors.bending_angle_percent)}), "
        f"{found.max_von_mises_mpa:.3f} MPa (± {_percent(errors.max_von_mises_percent)}), "
        f"{found.mesh.elements} tetrahedra"
    )


def _percent(value: float | None) -> str:
    return "unknown" if value is None else f"{value:.1f} %"


def _effort(optimum: Optimum) -> Iterator[str]:
    neighbours = sum(not point.ordinary for point in optimum.points)
    known = f", {optimum.known} known before" if optimum.known else ""
    failed = f", {optimum.failed} failed" if optimum.failed else ""
    yield (
        f"{optimum.asked} designs evaluated{known}{failed}, {neighbours} from neighbours, in "
        f"{optimum.seconds / 60:.1f} min"
    )
    if not optimum.in_time:
        yield "the time was over before all stages were through; the same command goes on"
