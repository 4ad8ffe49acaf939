"""Angle and highest stress along the load path, with their estimated errors and limits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.page.curves.chart import Chart, from_zero
from bellows_design.web.charts import Limit, Line, Mark

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.analysis.whole_actuator import Reading

Read = Callable[["Reading"], float]


def angle_chart(found: Evaluation) -> Chart:
    """Bending angle against pressure."""
    percent = found.error_estimate.bending_angle_percent
    line = _line("bending angle", found, lambda each: each.bending_angle_deg, percent)
    mark = Mark(found.pressure_mpa, found.bending_angle_deg, f"{found.bending_angle_deg:.1f}°")
    return Chart(
        "Bending angle against pressure",
        "pressure, MPa",
        "bending angle, °",
        (line,),
        tuple(_events(found)),
        (mark,),
    )


def stress_chart(found: Evaluation) -> Chart:
    """Highest von Mises stress against pressure, and its limit."""
    percent = found.error_estimate.max_von_mises_percent
    line = _line("highest stress", found, lambda each: each.max_von_mises_mpa, percent)
    limits = tuple(_stress_limits(found))
    highest = from_zero(*line.y, *line.high, *(each.value for each in limits))
    return Chart(
        "Highest von Mises stress against pressure",
        "pressure, MPa",
        "highest von Mises stress, MPa",
        (line,),
        (*limits, *_events(found)),
        y_bounds=highest,
    )


def coarseness(found: Evaluation, read: Read) -> float | None:
    """By how much the coarsest mesh, which the path is on, is off from the finest, percent."""
    first, last = found.meshes[0].reading, found.meshes[-1].reading
    if first.pressure_mpa != last.pressure_mpa or not read(last):
        return None
    return 100 * abs(read(first) - read(last)) / abs(read(last))


def _line(name: str, found: Evaluation, read: Read, percent: float | None) -> Line:
    """The path, with a band where an error is estimated."""
    x, y = [each.pressure_mpa for each in found.path], [read(each) for each in found.path]
    off = coarseness(found, read)
    if percent is None or off is None:
        return Line(name, x, y, points=True)
    share = [*([percent + off] * (len(x) - 1)), percent]
    errors = [abs(value) * each / 100 for value, each in zip(y, share, strict=True)]
    low = [value - error for value, error in zip(y, errors, strict=True)]
    high = [value + error for value, error in zip(y, errors, strict=True)]
    return Line(name, x, y, low, high, points=True)


def _stress_limits(found: Evaluation) -> Iterator[Limit]:
    design = found.design
    given, strength = design.max_von_mises, design.material.yield_strength
    if given == strength:
        yield Limit(given, f"limit, yield strength {strength:g} MPa")
        return
    yield Limit(given, f"limit {given:g} MPa")
    yield Limit(strength, f"yield strength {strength:g} MPa")


def _events(found: Evaluation) -> Iterator[Limit]:
    """What ends the path, or is asked for beyond it."""
    if found.touch_pressure_mpa is not None:
        yield Limit(found.touch_pressure_mpa, "walls first touch", "x")
    if found.limit_pressure_mpa is not None:
        yield Limit(found.limit_pressure_mpa, "limit point", "x")
    asked = found.design.load.pressure
    if not found.pressure_mpa / asked >= 1 - 1e-9:
        yield Limit(asked, "design pressure", "x")
