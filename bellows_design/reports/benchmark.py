"""A benchmark as tables for people: work and precision of every mesh of every model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import JustifyMethod, RenderableType
from rich.table import Table

if TYPE_CHECKING:
    from bellows_design.benchmark.neighbours import Row
    from bellows_design.benchmark.reference import Reference
    from bellows_design.benchmark.series import Level, Series, Work
    from bellows_design.benchmark.study import Study
    from bellows_design.machine import Machine

WORK = (
    "model",
    "tetra-\nhedra",
    "un-\nknowns",
    "itera-\ntions",
    "factor-\nized",
    "geom.,\ns",
    "mesh,\ns",
    "solve,\ns",
    "so far,\ns",
    "peak,\nMiB",
)
PRECISION = (
    "model",
    "tetra-\nhedra",
    "so far,\ns",
    "angle,\n°",
    "error,\n%",
    "esti-\nmate",
    "ratio",
    "stress,\nMPa",
    "error,\n%",
    "esti-\nmate",
    "ratio",
)


def benchmark_tables(study: Study) -> Sequence[RenderableType]:
    """Work and precision of every mesh of every model, then orders, growth and the machine."""
    work = _numbers(f"{study.design.name}: work", WORK)
    precision = _numbers("precision", PRECISION)
    for series in study.series:
        for level in series.levels:
            last = level is series.levels[-1]
            work.add_row(series.model, *_work(level), end_section=last)
            precision.add_row(series.model, *_precision(series, level), end_section=last)
    texts = [text for series in study.series for text in _findings(series)]
    legend = "estimate: the product's own, %; ratio: estimate over error"
    near = [_neighbours(study.neighbours)] if study.neighbours else []
    return [work, precision, legend, *near, *texts, _machine(study.machine)]


NEIGHBOURS = (
    "lengths\nby",
    "steps",
    "itera-\ntions",
    "factor-\nized",
    "time,\ns",
    "ordinary,\ns",
    "angle,\n°",
    "error,\n%",
    "esti-\nmate",
    "stress,\nMPa",
    "error,\n%",
    "esti-\nmate",
)


def _neighbours(rows: Sequence[Row]) -> Table:
    """The design from neighbours, over the distance to them."""
    table = _numbers("from a neighbour", NEIGHBOURS)
    for row in rows:
        table.add_row(
            f"{100 * row.share:g} %",
            *(str(n) for n in (row.steps, row.newton_iterations, row.factorizations)),
            f"{row.seconds:.2f}",
            f"{row.ordinary_seconds:.2f}",
            f"{row.bending_angle_deg:.2f}",
            _known(row.errors.bending_angle_percent, ".2f"),
            _known(row.estimate.bending_angle_percent, ".2f"),
            f"{row.max_von_mises_mpa:.3f}",
            _known(row.errors.max_von_mises_percent, ".2f"),
            _known(row.estimate.max_von_mises_percent, ".2f"),
        )
    return table


def _numbers(title: str, headings: Sequence[str]) -> Table:
    """An empty table of numbers that keeps its digits together."""
    table = Table(title=title, title_justify="left", box=SIMPLE, padding=0)
    for heading in headings:
        justify: JustifyMethod = "left" if heading == "model" else "right"
        table.add_column(heading, justify=justify, no_wrap=True)
    return table


def _work(level: Level) -> tuple[str, ...]:
    work, stages = level.work, level.stages
    counts = (work.elements, work.unknowns, work.newton_iterations, work.factorizations)
    seconds = (stages.geometry, stages.mesh, stages.solve, level.so_far.total)
    return (
        *(str(count) for count in counts),
        *(f"{each:.2f}" for each in seconds),
        _known(level.peak_memory_mib, ".0f"),
    )


def _precision(series: Series, level: Level) -> tuple[str, ...]:
    errors, estimate = level.errors(series.model, series.reference), level.estimate
    ratios = level.ratios(errors)
    return (
        str(level.work.elements),
        f"{level.so_far.total:.2f}",
        f"{level.bending_angle_deg:.2f}",
        _known(errors.bending_angle_percent, ".2f"),
        _known(estimate.bending_angle_percent, ".2f"),
        _known(ratios.bending_angle, ".2g"),
        f"{level.max_von_mises_mpa:.3f}",
        _known(errors.max_von_mises_percent, ".2f"),
        _known(estimate.max_von_mises_percent, ".2f"),
        _known(ratios.max_von_mises, ".2g"),
    )


def _findings(series: Series) -> list[str]:
    """What a model's rows say together, and what they are measured against."""
    name = series.model
    lines = [f"{name}: errors are against {series.reference.recipe}."]
    if series.ends is not None:
        lines.append(f"{name}: {_ends(series.ends)}")
    if series.reference.finest_half is not None:
        lines.append(f"{name}: {_against(series, series.reference.finest_half)}")
    if len(series.levels) > 1:
        lines.append(f"{name}: {_orders(series)}")
    lines += [f"{name}: {text}" for text in _growth(series)]
    if series.note:
        label = "no finer mesh" if series.converged else "NOT CONVERGED"
        lines.append(f"{name}: {label}: {series.note}")
    return lines


def _ends(work: Work) -> str:
    return (
        f"the first mesh's seconds include the ends: {work.elements} tetrahedra, "
        f"{work.factorizations} factorizations, {work.solver_seconds:.2f} s of solving."
    )


def _against(series: Series, other: Reference) -> str:
    errors = series.errors_against(other)
    angle = _listed([error.bending_angle_percent for error in errors])
    stress = _listed([error.max_von_mises_percent for error in errors])
    return f"against {other.recipe}: angle {angle} %; stress {stress} %."


def _orders(series: Series) -> str:
    orders = series.orders
    angle, stress = _listed(orders.bending_angle), _listed(orders.max_von_mises)
    return f"observed orders in 1/tetrahedra: angle {angle}; stress {stress}."


def _growth(series: Series) -> list[str]:
    powers = {
        "the seconds per factorization": series.exponent,
        "all seconds of solving up to a mesh": series.solve_exponent,
    }
    return [
        f"{what} grow as unknowns^{power:.2f}."
        for what, power in powers.items()
        if power is not None
    ]


def _machine(machine: Machine) -> str:
    memory, load = machine.memory_gib, machine.load_average
    return (
        f"{machine.processor}, {machine.cores} cores"
        + ("" if memory is None else f", {memory:.1f} GiB")
        + ("" if load is None else f"; load average before the start {load:.1f}")
    )


def _listed(values: Sequence[float | None]) -> str:
    return ", ".join(_known(value, ".2f") for value in values)


def _known(value: float | None, form: str) -> str:
    return "–" if value is None else format(value, form)
