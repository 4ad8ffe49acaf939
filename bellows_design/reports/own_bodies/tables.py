"""The evaluation of an own body as tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from bellows_design.reports.evaluation import (
    contact_text,
    effort_rows,
    error_text,
    place_text,
    strains_text,
)
from bellows_design.reports.evaluation import not_reached as why_not_reached

if TYPE_CHECKING:
    from bellows_design.own_body.analysis.evaluation import BodyEvaluation, PartState
    from bellows_design.own_body.analysis.readings import BodyReading


def body_tables(found: BodyEvaluation) -> Sequence[RenderableType]:
    """The numbers asked for first, stress by part, the curve, warnings, why a load is missing."""
    table = Table(title=found.body.name, title_justify="left", box=SIMPLE, show_header=False)
    rows = _results(found) | effort_rows(found.computation.model.name, found.reason, found)
    for name, value in rows.items():
        table.add_row(name, Text(value))
    parts = [_parts(found.parts)] if len(found.parts) > 1 else []
    curve = [_curve(found.curve)] if len(found.curve) > 1 else []
    notes = [Text(f"warning: {text}", style="yellow") for text in found.warnings]
    ending = [] if found.converged else [why_not_reached(found.message)]
    return [table, *parts, *curve, *notes, *ending]


def _results(found: BodyEvaluation) -> dict[str, str]:
    """What there is a value for."""
    end, error, part = found.end, found.error_estimate, found.most_stressed
    pressure = f"{end.pressure_mpa:.4g} MPa"
    if found.body.load.by_volume:
        pressure += error_text(error.pressure_percent)
    rows = {
        "pressure": pressure,
        "bending angle": _degrees(end.bending_angle_deg, error.bending_angle_percent),
        "angle of the chord": _degrees(end.chord_angle_deg, error.chord_angle_percent),
        "tip's displacement": _displacement(end, error.tip_displacement_percent),
        "force on obstacles": _force(end.contact_force_n, error.contact_force_percent),
        "highest von Mises stress": f"{part.max_von_mises_mpa:.4g} MPa"
        + error_text(error.max_von_mises_percent),
        "at (x, y, z)": place_text(part.max_von_mises_position_mm),
        "cavity volume": _volume(end),
        "principal strains": strains_text(part.strain) if len(found.parts) == 1 else "",
        "contact": contact_text(found.contact),
    }
    return {name: text for name, text in rows.items() if text}


def _degrees(angle: float | None, error: float | None) -> str:
    return "" if angle is None else f"{angle:.4g}°{error_text(error)}"


def _displacement(end: BodyReading, error: float | None) -> str:
    moved = end.tip_displacement_mm
    return "" if moved is None else f"{place_text(moved)}{error_text(error)}"


def _force(force: float | None, error: float | None) -> str:
    return "" if force is None else f"{force:.4g} N{error_text(error)}"


def _volume(end: BodyReading) -> str:
    return "" if end.cavity_volume_mm3 is None else f"{end.cavity_volume_mm3:.4g} mm³"


def _parts(parts: Sequence[PartState]) -> Table:
    """Stress and strain of each part."""
    table = Table(box=SIMPLE)
    for heading in ("part", "material", "stress, MPa", "bears, MPa", "principal strains"):
        table.add_column(heading)
    for part in parts:
        table.add_row(
            part.name,
            part.material,
            f"{part.max_von_mises_mpa:.4g}",
            f"{part.yield_strength_mpa:g}",
            strains_text(part.strain),
        )
    return table


def _curve(readings: Sequence[BodyReading]) -> Table:
    """What there is of angle, tip, force, stress and volume, over the pressure."""
    columns = {
        "pressure, MPa": [f"{each.pressure_mpa:.4g}" for each in readings],
        "angle, °": [_number(each.bending_angle_deg, 2) for each in readings],
        "chord, °": [_number(each.chord_angle_deg, 2) for each in readings],
        "tip (x, y, z), mm": [_coordinates(each.tip_displacement_mm) for each in readings],
        "force, N": [_number(each.contact_force_n, 3) for each in readings],
        "stress, MPa": [_number(each.max_von_mises_mpa, 3) for each in readings],
        "cavity, mm³": [_number(each.cavity_volume_mm3, 0) for each in readings],
    }
    shown = {heading: texts for heading, texts in columns.items() if any(texts)}
    table = Table(box=SIMPLE)
    for heading in shown:
        table.add_column(heading, justify="right")
    for row in zip(*shown.values(), strict=True):
        table.add_row(*row)
    return table


def _number(value: float | None, digits: int) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def _coordinates(place: tuple[float, float, float] | None) -> str:
    return "" if place is None else ", ".join(f"{each:.2f}" for each in place)
