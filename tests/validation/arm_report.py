"""What the document says of the arm."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from record import Interval, Report, Results, Row, Table

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "arm.json").read_text(encoding="utf-8")
)
FREE, CHAMBER, SKIN, HOLLOW = (
    "no thread",
    "thread around the chamber",
    "thread around the arm",
    "thread around the chamber, hollow core",
)
READINGS = {
    FREE: ("", True),
    CHAMBER: ("pressed", True),
    SKIN: ("skin", True),
    HOLLOW: ("pressed", False),
}
"""Surface with a thread, and whether the core is solid."""
COARSE = (6.0, 12)
"""Edges of the section's triangles, mm, and windings of the thread."""
QUANTITIES = {"tip_mm": ("tip", "mm", 1), "tilt_deg": ("tilt", "°", 2)}
"""Reading -> its name, unit, and column in the table of measurements."""

SAMPLE = f"{FREE} up to 10 kPa, 9 mm"


def on_mesh(name: str, mesh: tuple[float, int]) -> str:
    """Name of a computation."""
    return f"{name}, {mesh[0]:g} mm"


def measured(pressure: float, column: int) -> Interval:
    """Least and largest while the pressure was held."""
    row = next(row for row in DATA["measured"]["rows"] if row[0] == pressure)
    return row[column][0], row[column][1]


def computed(results: Results, name: str, quantity: str) -> dict[float, float]:
    """Pressure (kPa) -> reading, of the pressures that were reached."""
    readings = results[on_mesh(name, COARSE)].readings
    pressures = [round(pressure, 6) for pressure in readings["pressure_kpa"]]
    return dict(zip(pressures, readings[quantity], strict=True))


def rows(results: Results) -> tuple[Row, ...]:
    """At all pressures that both ends of the unknown reach: without a thread, and with one."""
    found = []
    for quantity, (label, unit, column) in QUANTITIES.items():
        curves = [computed(results, name, quantity) for name in READINGS]
        for pressure, *_ in DATA["measured"]["rows"]:
            ours = [curve[pressure] for curve in curves if pressure in curve]
            if ours:
                # Beyond its limit an arm without a thread bends as far as it can.
                top = max(ours) if pressure in curves[0] else math.inf
                name = f"{pressure} kPa, {label}"
                band = measured(pressure, column), (min(ours), top)
                found.append(Row(name, *band, unit, agrees=name not in APART))
    return tuple(found)


APART: frozenset[str] = frozenset()
"""Rows in which the measurement lies outside of all readings."""


def curves_table(results: Results, quantity: str) -> Table:
    """Each reading of the experiment, and the measurement."""
    label, unit, column = QUANTITIES[quantity]
    pressures = [row[0] for row in DATA["measured"]["rows"]]
    lines = []
    for name in READINGS:
        curve = computed(results, name, quantity)
        cells = [f"{curve[p]:.1f}" if p in curve else "–" for p in pressures]
        lines.append((name, *cells, ending(results, name)))
    known = [measured(pressure, column) for pressure in pressures]
    lines.append(("measured", *(f"{low:.1f} … {high:.1f}" for low, high in known), ""))
    heading = (f"{label}, {unit}", *(f"{pressure} kPa" for pressure in pressures), "ends")
    return Table(f"Each reading of the experiment, {label}:", heading, tuple(lines))


def ending(results: Results, name: str) -> str:
    """Where a path ends."""
    readings = results[on_mesh(name, COARSE)].readings
    if readings["limit_kpa"]:
        return f"limit at {readings['limit_kpa']:.1f} kPa"
    return f"at {readings['last_kpa']:.1f} kPa"


def report(results: Results) -> Report:
    """The section."""
    return Report("", "", "", rows(results), "", "")


def draw(results: Results, path: str) -> None:
    """Tilt over the pressure."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6.4, 4.0), layout="constrained")
    known = DATA["measured"]["rows"]
    at, low, high = ([*each] for each in zip(*((r[0], *r[2]) for r in known), strict=True))
    axes.fill_between(at, low, high, color="0.7", label="measured, while the pressure is held")
    for name in READINGS:
        curve = computed(results, name, "tilt_deg")
        axes.plot([0, *curve], [0, *curve.values()], "o-", label=name)
    axes.set(xlabel="pressure, kPa", ylabel="tilt of the tip, degrees")
    axes.legend()
    figure.savefig(path, dpi=110)
    pyplot.close(figure)
