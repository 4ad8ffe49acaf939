"""Force against pressure, and against the distance of the support."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from bellows_design.reports.page.curves.chart import Chart, from_zero
from bellows_design.web.charts import Line, Mark

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve, ForceReading


def force_chart(found: ForceCurve) -> Chart:
    """Force against pressure; a mark where neighbouring bubbles first touch."""
    touching = next((each for each in found.curve if each.contact), None)
    marks = (
        ()
        if touching is None
        else (Mark(touching.pressure_mpa, touching.force_n, "bubbles touch from here on"),)
    )
    line = _line(found.curve, lambda each: each.pressure_mpa)
    title = f"Force in the scene {found.scene}"
    bounds = from_zero(*line.high)
    return Chart(title, "pressure, MPa", "force, N", (line,), marks=marks, y_bounds=bounds)


def by_distance_chart(found: ForceCurve) -> Chart:
    """Force against the distance of the support at the last pressure."""
    line = _line(found.by_distance, lambda each: each.distance_mm or 0.0)
    title = f"Force in the scene {found.scene} over the distance of its support"
    bounds = from_zero(*line.high)
    return Chart(title, "distance of the support, mm", "force, N", (line,), y_bounds=bounds)


def _line(readings: Sequence[ForceReading], across: Callable[[ForceReading], float]) -> Line:
    """The curve and its band; where a tip snaps away the error grows without bound."""
    forces = [each.force_n for each in readings]
    shares = [0.0 if each.error is None else min(1.0, each.error.total / 100) for each in readings]
    low = [force * (1 - share) for force, share in zip(forces, shares, strict=True)]
    high = [force * (1 + share) for force, share in zip(forces, shares, strict=True)]
    return Line("force", [across(each) for each in readings], forces, low, high, points=True)
