"""What the document says of the actuators."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from pneunets.features import Curve, computed_curve, measured_curve, measured_knee
from pneunets.setups import BODIES, GAPS, MATERIALS, VARIANTS
from record import Interval, Report, Results, Row, Table

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "data" / "pneunets.json").read_text(encoding="utf-8")
)
SECOND = DATA["second_run_of_c7-w7"]
ANGLE, FORCE = "angle_deg", "force_n"

SLOPES = {"c5-w7": (15.0, 25.0), "c7-w7": (15.0, 25.0), "c5-w10": (15.0, 30.0)}
LEVELS = {"c5-w7": (40.0, 44.9), "c7-w7": (40.0, 44.9), "c5-w10": (50.0, 60.0)}
FORCES = {"c5-w7": (30.0, 45.0, 53.9), "c7-w7": (30.0, 45.0, 53.9), "c5-w10": (30.0, 50.0, 60.0)}
"""Pressures that are compared, kPa."""

PART = (
    "Three bending actuators of Ecoflex 00-30: chambers of 8 × 8 × 2 mm in a row, joined by a tunnel "
    "of 2 × 2 mm along the bottom, with walls of 7 or 10 mm all around; a silk film closes the "
    "chambers from below. P. Moseley et al., *Advanced Engineering Materials* 18 (2016), 978; data "
    "and scripts: repository HARSHAL-IITB/spa-design-tool, MIT licence. c5-w7 has five chambers and "
    "walls of 7 mm, and so on."
)

POSED = (
    "Half of the body by symmetry; x from the clamp to the tip, z up. The end face at the inlet is "
    "fixed, the inlet closed. The authors' fits as published: Ogden of three terms, Yeoh, ν 0.48; "
    "the rows give both as an interval. They take the film as a membrane of 4100 MPa and 0.5 mm. "
    "Here it is a solid of 0.2 mm and 200 MPa with nodes in common with the silicone, which closes "
    "the chambers itself: it stretches by half a percent and bends by less than a hundredth of the "
    "body's stiffness. A membrane without bending stiffness is a variant below; under pressure from "
    "its sides it folds on the mesh, and from a fiftieth of the published stiffness on Newton's "
    "method loses the path. The volume is prescribed and the pressure found (`inflate`), so that no "
    "knee stops the path. The angle is that of the chord from the clamp to the bottom centre of the "
    "tip, less its value at 10 kPa. For the force the body is 5 mm longer at the inlet and clamped "
    "there all around; a frictionless rigid plate lies under its last 5 mm, touching from the start. "
    "A slope is the mean between two pressures, the knee where the curve is steepest. *Mesh error* "
    "is the change on a finer mesh of c5-w7."
)

KNEE_REPEATS = 0.015
"""Both runs of c7-w7 are steepest within 0.5 kPa of each other."""

Feature = Callable[[Curve], float]


def free(results: Results, name: str) -> Curve:
    """Angle over pressure of a computation."""
    return computed_curve(results[name].readings, ANGLE)


def blocked(results: Results, name: str) -> Curve:
    """Force over pressure of a computation."""
    return computed_curve(results[name].readings, FORCE)


def repeatability() -> float:
    """Half of what both runs of c7-w7 differ by, from 20 to 40 kPa, as a share of their mean."""
    runs = DATA["angle"]["c7-w7"], SECOND
    rises = [measured_curve(run, "bending_angle_deg").slope(20.0, 40.0) for run in runs]
    return abs(rises[0] - rises[1]) / sum(rises)


def interval(values: Sequence[float]) -> Interval:
    """Of those that are known; NaN without any."""
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else (math.nan, math.nan)


def row(
    quantity: str, unit: str, measured: Interval, ours: Interval, allowed: float, error: float
) -> Row:
    """One that says itself whether it agrees."""
    found = Row(quantity, measured, ours, unit, None if math.isnan(error) else error, allowed)
    return Row(quantity, measured, ours, unit, found.error, allowed, agrees=found.inside)


def mesh_share(results: Results, feature: Feature) -> float:
    """Change of a feature of c5-w7 on the finer mesh, as a share."""
    coarse, fine = (feature(free(results, f"c5-w7, {name}")) for name in ("Ogden", "finer mesh"))
    return abs(fine / coarse - 1)


def angle_rows(results: Results, body: str) -> list[Row]:
    """Slope, knee and levels of one body, over both materials."""
    table = DATA["angle"][body]
    measured = measured_curve(table, "bending_angle_deg")
    curves = [free(results, f"{body}, {material}") for material in MATERIALS]
    low, high = SLOPES[body]

    def slope(curve: Curve) -> float:
        return curve.slope(low, high)

    def made(what: str, unit: str, feature: Feature, known: float, allowed: float) -> Row:
        ours = interval([feature(curve) for curve in curves])
        error = mesh_share(results, feature) * sum(ours) / 2
        return row(f"{body}: {what}", unit, (known, known), ours, allowed, error)

    again = repeatability()
    rows = [made(f"slope, {low:g} to {high:g} kPa", "°/kPa", slope, slope(measured), again)]
    rows.append(
        made("steepest at", "kPa", lambda curve: curve.knee, measured_knee(table), KNEE_REPEATS)
    )
    for level in LEVELS[body]:
        rows.append(
            made(
                f"angle at {level:g} kPa",
                "°",
                lambda curve, at=level: curve.at(at),  # type: ignore[misc]
                measured.at(level),
                again,
            )
        )
    return rows


def force_rows(results: Results, body: str) -> list[Row]:
    """Forces of one body, over both materials and both readings of the clamp."""
    table = DATA["force"][body]
    measured, spread = (measured_curve(table, key) for key in ("blocked_force_n", "spread_n"))
    names = [
        f"force {body}, {material}, {missing} missing"
        for material in MATERIALS
        for missing in (0, 1)
    ]
    curves = [blocked(results, name) for name in names if name in results]
    rows = []
    for at in FORCES[body]:
        ours = interval([curve.at(at) for curve in curves])
        if not math.isnan(ours[0]):
            known = measured.at(at) - spread.at(at), measured.at(at) + spread.at(at)
            rows.append(row(f"{body}: force at {at:g} kPa", "N", known, ours, 0.0, math.nan))
    return rows


def variants(results: Results) -> Table:
    """One change at a time of c5-w7."""
    low, high = SLOPES["c5-w7"]
    names = {"as posed, Ogden": "c5-w7, Ogden", "Yeoh": "c5-w7, Yeoh", "finer mesh": "c5-w7, finer mesh"}
    names |= {name: f"c5-w7, {name}" for name in VARIANTS}
    lines = []
    for label, name in names.items():
        if name not in results:
            continue
        curve = free(results, name)
        values = (curve.slope(low, high), curve.at(30.0), curve.knee, curve.at(40.0))
        # a path that ends before its steepest place has no knee
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
        "steepest at, kPa",
        "angle at 40 kPa, °",
    )
    return Table("One change at a time.", heading, tuple(lines))


def gaps(results: Results) -> Table:
    """Force of c5-w7 by how the plate lies and what is in the clamp."""
    names = {f"{missing} missing": f"force c5-w7, Ogden, {missing} missing" for missing in (0, 1)}
    names |= {f"plate at {gap:g}°": f"force c5-w7, plate at {gap:g}°" for gap in GAPS}
    places = FORCES["c5-w7"]
    lines = [
        (label, *(f"{blocked(results, name).at(at):.3f}".replace("nan", "–") for at in places))
        for label, name in names.items()
        if name in results
    ]
    known = measured_curve(DATA["force"]["c5-w7"], "blocked_force_n")
    lines.append(("measured", *(f"{known.at(at):.3f}" for at in places)))
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


def measured_text() -> str:
    """What was measured, with the repeatability."""
    return (
        "The angle by a camera during a ramp of 1 kPa in 6 s, the force on a load cell at pressures "
        "held for 3 s; medians in bins, the spread of the force is that within a bin. c7-w7 was "
        "measured a second time, in steps and without a zero: from 20 to 40 kPa it bends by "
        f"{100 * repeatability():.0f} % less and more than the mean of both runs, which is what "
        "slopes and angles are allowed; both runs are steepest within 0.5 kPa."
    )


def report(results: Results) -> Report:
    """The section."""
    rows = [row for body in BODIES for row in angle_rows(results, body)]
    rows += [row for body in BODIES for row in force_rows(results, body)]
    return Report(
        PART, measured_text(), POSED, tuple(rows), unknown(), verdict(results),
        (variants(results), gaps(results), effort(results)), "validation_pneunets.png",
    )  # fmt: skip
