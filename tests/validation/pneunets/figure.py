"""The figure: angle and force over the pressure, measured and computed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from record import Results

from pneunets.comparison import DATA, SECOND, blocked, free
from pneunets.features import Curve
from pneunets.setups import AWAY, BODIES, MATERIALS

OURS, MEASURED, AGAIN, WRINKLING = "#1f5f99", "black", "#b0563c", "#3f8f4f"
READINGS = {0: ("#1f5f99", "all chambers"), 1: ("#8a5fa8", "none at the clamp")}


def draw(results: Results, path: str) -> None:
    """Both quantities of all bodies."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 6.6), layout="constrained")
    axes = figure.subplots(2, len(BODIES))
    for column, body in enumerate(BODIES):
        draw_angles(axes[0, column], results, body)
        draw_forces(axes[1, column], results, body)
    figure.savefig(path, dpi=110)


def draw_angles(axes: Any, results: Results, body: str) -> None:
    """Medians, the second run, the band of both materials and the finer mesh."""
    table = DATA["angle"][body]
    axes.plot(table["pressure_kpa"], table["bending_angle_deg"], ".", color=MEASURED, ms=3)
    axes.lines[-1].set_label("measured")
    if body == "c7-w7":
        first = np.interp(20.0, table["pressure_kpa"], table["bending_angle_deg"])
        again = np.array(SECOND["bending_angle_deg"]) - SECOND["bending_angle_deg"][0] + first
        axes.plot(SECOND["pressure_kpa"], again, "x", color=AGAIN, ms=5)
        axes.lines[-1].set_label("measured again, as at 20 kPa")
    names = [f"{body}, {material}" for material in MATERIALS]
    band(axes, [free(results, name) for name in names if name in results], OURS)
    both = all(name in results for name in names)
    axes.lines[-1].set_label("between Yeoh and Ogden" if both else "Ogden")
    if body == "c5-w7":
        finer = free(results, "c5-w7, Ogden, finer mesh")
        axes.plot(finer.pressure, finer.value, "--", color=OURS, lw=1.0, label="Ogden, finer mesh")
    wrinkling = free(results, f"{body}, film that wrinkles")
    axes.plot(wrinkling.pressure, wrinkling.value, "-", color=WRINKLING, lw=1.0)
    axes.lines[-1].set_label("Ogden, film that wrinkles")
    highest = 1.35 * max(table["bending_angle_deg"])
    finish(axes, body, "bending angle, degrees", table["pressure_kpa"], highest)


def draw_forces(axes: Any, results: Results, body: str) -> None:
    """Medians with their spread, and bands of both materials for both readings."""
    table = DATA["force"][body]
    axes.errorbar(
        table["pressure_kpa"],
        table["blocked_force_n"],
        table["spread_n"],
        fmt=".",
        color=MEASURED,
        ms=3,
        lw=0.6,
        label="measured",
    )
    for missing, (colour, label) in READINGS.items():
        names = [f"force {body}, {material}, {missing} missing" for material in MATERIALS]
        curves = [blocked(results, name) for name in names if name in results]
        if curves:
            band(axes, curves, colour)
            axes.lines[-1].set_label(label)
    if body == "c5-w7":
        for missing, (colour, _) in READINGS.items():
            away = blocked(results, f"force c5-w7, {missing} missing, plate {AWAY:g}° away")
            axes.plot(away.pressure, away.value, "--", color=colour, lw=1.0)
        axes.lines[-1].set_label(f"dashed: plate {AWAY:g}° away")
    highest = 1.35 * max(table["blocked_force_n"])
    finish(axes, "", "blocked force, N", table["pressure_kpa"], highest)


def band(axes: Any, curves: Sequence[Curve], colour: str) -> None:
    """Curves, and what lies between the first two at the same value."""
    for curve in curves:
        axes.plot(curve.pressure, curve.value, color=colour, lw=1.0)
    if len(curves) > 1:
        top = min(float(curve.value.max()) for curve in curves)
        values = np.linspace(0.0, top, 200)
        sides = [at_values(curve, values) for curve in curves[:2]]
        axes.fill_betweenx(values, *sides, color=colour, alpha=0.25, lw=0)


def at_values(curve: Curve, values: Any) -> Any:
    """Pressures at values, which rise along the path but for ripples."""
    return np.interp(values, np.maximum.accumulate(curve.value), curve.pressure)


def finish(axes: Any, title: str, label: str, pressures: Sequence[float], highest: float) -> None:
    """Labels and limits."""
    axes.set(xlabel="pressure, kPa", ylabel=label, title=title)
    axes.set(xlim=(0, 1.05 * max(pressures)), ylim=(-0.05 * highest, highest))
    axes.legend(fontsize=7, loc="upper left", frameon=False)
