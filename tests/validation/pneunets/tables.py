"""Further tables of the actuators: changes one at a time, forces, stiffness, effort."""

from __future__ import annotations

from record import Results, Table

from pneunets.comparison import (
    DATA,
    FORCES,
    LEVELS,
    SLOPES,
    blocked,
    fitted_factor,
    free,
    knee_of,
    softer,
)
from pneunets.features import measured_curve, measured_knee
from pneunets.setups import BODIES, PLATES, VARIANTS


def variants(results: Results) -> Table:
    """One change at a time of c5-w7."""
    low, high = SLOPES["c5-w7"]
    names = {"as posed, Ogden": "c5-w7, Ogden", "as posed, Yeoh": "c5-w7, Yeoh"}
    names |= {name: f"c5-w7, {name}" for name in VARIANTS}
    names |= {"finer mesh, Ogden": "c5-w7, Ogden, finer mesh"}
    curves = {label: free(results, name) for label, name in names.items()}
    curves["Ogden 15 % softer, by scaling"] = softer(results["c5-w7, Ogden"], 0.85)
    lines = []
    for label, curve in curves.items():
        values = (curve.slope(low, high), curve.at(30.0), knee_of(curve), curve.at(40.0))
        cells = [f"{values[0]:.3f}", f"{values[1]:.2f}", f"{values[2]:.1f}", f"{values[3]:.1f}"]
        lines.append((label, *(cell.replace("nan", "–") for cell in cells)))
    table = DATA["angle"]["c5-w7"]
    known = measured_curve(table, "bending_angle_deg")
    lines.append(
        (
            "measured",
            f"{known.slope(low, high):.3f}",
            f"{known.at(30.0):.2f}",
            f"{measured_knee(table):.1f}",
            f"{known.at(40.0):.1f}",
        )
    )
    heading = (
        "c5-w7",
        f"slope, {low:g} to {high:g} kPa, °/kPa",
        "angle at 30 kPa, °",
        "knee at, kPa",
        "angle at 40 kPa, °",
    )
    return Table("One change at a time.", heading, tuple(lines))


def wrinkled(results: Results) -> Table:
    """What a film that bears no compression changes, of all bodies with Ogden's law."""
    lines = []
    for body in BODIES:
        (low, high), known = SLOPES[body], DATA["angle"][body]
        curves = [measured_curve(known, "bending_angle_deg")]
        curves += [free(results, f"{body}, {name}") for name in ("Ogden", "film that wrinkles")]
        slopes = (f"{curve.slope(low, high):.3f}" for curve in curves)
        angles = (f"{curve.at(30.0):.2f}" for curve in curves)
        lines.append((body, " / ".join(slopes), " / ".join(angles)))
    heading = (
        "measured / as posed, Ogden / film that wrinkles, Ogden",
        "slope before the knee, °/kPa",
        "angle at 30 kPa, °",
    )
    return Table("A film that wrinkles instead of bearing compression.", heading, tuple(lines))


def fitted_stiffness(results: Results) -> Table:
    """What Ogden's law scaled to the measured knee has, of all bodies."""
    lines = []
    for body in BODIES:
        factor = fitted_factor(results, body)
        ours = softer(results[f"{body}, Ogden"], factor)
        known = measured_curve(DATA["angle"][body], "bending_angle_deg")
        (low, high), level = SLOPES[body], LEVELS[body][0]
        lines.append(
            (
                body,
                f"{factor:.2f}",
                f"{known.slope(low, high):.3f} / {ours.slope(low, high):.3f}",
                f"{level:g} kPa: {known.at(level):.1f} / {ours.at(level):.1f}".replace("nan", "–"),
            )
        )
    heading = ("Ogden", "factor", "slope, °/kPa, measured / ours", "angle, °, measured / ours")
    return Table("One factor on the stiffness, fitted to the knee.", heading, tuple(lines))


def force_table(results: Results) -> Table:
    """Force of c5-w7 by what is in the clamp and how the plate lies."""
    names = {f"{missing} missing": f"force c5-w7, Ogden, {missing} missing" for missing in (0, 1)}
    names |= {name: f"force c5-w7, {name}" for name in PLATES}
    places = FORCES["c5-w7"]
    curves = {label: blocked(results, name) for label, name in names.items() if name in results}
    curves["measured"] = measured_curve(DATA["force"]["c5-w7"], "blocked_force_n")
    lines = [
        (label, *(f"{curve.at(at):.3f}".replace("nan", "–") for at in places))
        for label, curve in curves.items()
    ]
    heading = ("c5-w7, Ogden", *(f"force at {at:g} kPa, N" for at in places))
    return Table("The plate, and the chamber at the clamp.", heading, tuple(lines))


def effort(results: Results) -> Table:
    """Meshes and seconds."""
    lines = tuple(
        (
            name,
            str(found.tetrahedra),
            str(found.unknowns),
            str(len(found.readings["pressure_kpa"])),
            f"{found.readings['pressure_kpa'][-1]:.1f}",
            f"{found.seconds:.0f}",
        )
        for name, found in results.items()
    )
    heading = ("computation", "tetrahedra", "unknowns", "equilibria", "up to, kPa", "s")
    return Table("Effort.", heading, lines)
