"""What the document says of the actuators."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from record import Interval, Report, Results, Row

from pneunets.comparison import (
    DATA,
    FORCES,
    LEVELS,
    SECOND,
    SLOPES,
    Feature,
    beam_stiffness,
    blocked,
    film_share,
    fitted_factor,
    free,
    interval,
    knee_of,
    repeatability,
    softer,
    tip_stiffness,
)
from pneunets.features import Curve, measured_curve, measured_knee
from pneunets.setups import AWAY, BODIES, MATERIALS, VARIANTS
from pneunets.tables import effort, fitted_stiffness, force_table, variants, wrinkled

PART = (
    "Three bending actuators of Ecoflex 00-30: chambers of 8 × 8 × 2 mm in a row, joined by a "
    "tunnel of 2 × 2 mm along the bottom, with walls of 7 or 10 mm all around; a silk film closes "
    "the chambers from below. P. Moseley et al., *Advanced Engineering Materials* 18 (2016), 978; "
    "data and scripts: repository HARSHAL-IITB/spa-design-tool, MIT licence. c5-w7 has five "
    "chambers and walls of 7 mm, and so on."
)

POSED = (
    "Half of the body by symmetry; x from the clamp to the tip, z up. The end face at the inlet is "
    "fixed, the inlet closed. The authors' fits as published: Ogden of three terms, Yeoh, ν 0.48; "
    "the rows give both as an interval. The authors' scripts take the film as a membrane of 4100 "
    "MPa and 0.5 mm, ν 0.49, without bending stiffness. Here it is a solid of the same stretching "
    "stiffness, 20500 MPa and 0.1 mm, with nodes in common with the silicone, which closes the "
    f"chambers itself; its bending stiffness is {100 * film_share():.1f} % of that of the body's "
    "full section about the film. A membrane without any buckles as short as the mesh allows where "
    "it is pressed together, see [Films](solver.md#films); one that wrinkles, under 0.5 mm of "
    "silicone, is a change below. The volume is prescribed and the "
    "pressure found (`inflate`), so that no knee stops the path. The angle is that of the chord "
    "from the clamp to the bottom centre of the tip, less its value at 10 kPa. For the force the "
    "body is 5 mm longer at the inlet and clamped there all around; a frictionless rigid plate "
    "lies under its last 5 mm and touches from the start, as by default in the authors' scripts. A "
    "slope is the mean between two pressures, the knee where the curve has its "
    "limit point or is steepest; with Ogden's law that of c5-w7 rises by 7 to 8 °/kPa all the way "
    "from 38.4 to 41.7 kPa. *Mesh error* is the change on a finer mesh of c5-w7 with Ogden's law."
)

KNEE_REPEATS = 0.015
"""Both runs of c7-w7 are steepest within 0.5 kPa of each other."""


def row(
    quantity: str, unit: str, measured: Interval, ours: Interval, allowed: float, error: float
) -> Row:
    """One that says itself whether it agrees."""
    found = Row(quantity, measured, ours, unit, None if math.isnan(error) else error, allowed)
    return Row(quantity, measured, ours, unit, found.error, allowed, agrees=found.inside)


def mesh_share(results: Results, feature: Feature) -> float:
    """Change of a feature of c5-w7 on the finer mesh, as a share; NaN beyond its end."""
    coarse, fine = (feature(free(results, f"c5-w7, {name}")) for name in ON_TWO_MESHES)
    return abs(fine / coarse - 1)


ON_TWO_MESHES = ("Ogden", "Ogden, finer mesh")

NEAR_THE_KNEE = 16.0
"""Angle whose pressure tells the mesh error of the knee, degrees."""


def pressure_near_the_knee(curve: Curve) -> float:
    """Pressure of that angle, kPa."""
    return Curve(curve.value, curve.pressure).at(NEAR_THE_KNEE)


def angle_rows(results: Results, body: str) -> list[Row]:
    """Slope, knee and levels of one body, over both materials."""
    table = DATA["angle"][body]
    measured = measured_curve(table, "bending_angle_deg")
    names = {material: f"{body}, {material}" for material in MATERIALS}
    curves = {fit: free(results, name) for fit, name in names.items() if name in results}
    low, high = SLOPES[body]

    def slope(curve: Curve) -> float:
        return curve.slope(low, high)

    def made(
        what: str, unit: str, feature: Feature, known: float, allowed: float, share: float
    ) -> list[Row]:
        values = {fit: feature(curve) for fit, curve in curves.items()}
        reached = {fit: value for fit, value in values.items() if math.isfinite(value)}
        ours = interval(list(reached.values()))
        alone = f" ({next(iter(reached))} alone)" if len(reached) == 1 else ""
        error = share * sum(ours) / 2
        return [row(f"{body}: {what}{alone}", unit, (known, known), ours, allowed, error)]

    again, near = repeatability(), mesh_share(results, pressure_near_the_knee)
    rows = made(
        f"slope, {low:g} to {high:g} kPa",
        "°/kPa",
        slope,
        slope(measured),
        again,
        mesh_share(results, slope),
    )
    knee = measured_knee(table)
    rows += made("knee at", "kPa", knee_of, knee, KNEE_REPEATS, near)
    for level in LEVELS[body]:
        known = measured.at(level)
        rows += made(
            f"angle at {level:g} kPa",
            "°",
            lambda curve, at=level: curve.at(at),  # type: ignore[misc]
            known,
            again,
            mesh_share(results, lambda curve, at=level: curve.at(at)),  # type: ignore[misc]
        )
    return [each for each in rows if not math.isnan(each.ours[0])]


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


def measured_text() -> str:
    """What was measured, with the repeatability."""
    first, second = both_runs()
    return (
        "The angle by a camera during a ramp of 1 kPa in 6 s, the force on a load cell at "
        "pressures held for 3 s; medians in bins, the spread of the force is that within a bin. "
        "c7-w7 was measured a second time, in steps and without a zero: from 20 to 40 kPa it bends "
        f"by {second[2] - second[0]:.0f}° instead of {first[2] - first[0]:.0f}°, which is ± "
        f"{100 * repeatability():.1f} % of the mean and what slopes and angles are allowed. From "
        f"20 to 30 kPa alone it is {second[1] - second[0]:.1f}° instead of "
        f"{first[1] - first[0]:.1f}°: slopes before the knee repeat less well than that. Both runs "
        "are steepest within 0.5 kPa. The record of c5-w7 jumps by 0.9° right after its zero. The "
        "force of c5-w7 is 0.02 N at 10 kPa and 0.06 N at 30 kPa; those of the others are below "
        "0.001 N until 25 kPa."
    )


RUNS = (20.0, 30.0, 40.0)
"""Pressures at which both runs of c7-w7 are told, kPa."""


def both_runs() -> list[list[float]]:
    """Angles of both runs of c7-w7 at these pressures, degrees."""
    runs = DATA["angle"]["c7-w7"], SECOND
    return [
        [float(np.interp(at, run["pressure_kpa"], run["bending_angle_deg"])) for at in RUNS]
        for run in runs
    ]


def unknown(results: Results) -> str:
    """What the experiment leaves open, and what that may change."""
    least, most = interval(spread_of_variants(results))
    return (
        "*Material*: the raw tension data lie 12 to 17 % below the Ogden fit up to 100 %. If film "
        "and silicone are scaled by a factor, so is the pressure of every equilibrium; the row "
        "of a softer material below is that. *Film*: its stiffness as "
        "glued. *Gravity*: its direction is not stated. *Zero*: angles are relative to 10 kPa, "
        "below which nothing was recorded. Film, weight and ν, changed as below, change the angle "
        f"at 30 kPa by {least:+.0f} to {most:+.0f} %. *Force*: a "
        'sketch beside the data says of a body of six chambers "chamber 1 not present '
        'physically", the data\'s heading says five chambers "with extra wall length at one end '
        'to clamp the sample"; both are computed. The sketch has the clamp on a slider; a plate '
        "without friction exerts nothing along it. The scripts can lean the plate away "
        "(`dist_to_force`, 0 by default). Whether cup and load cell yield is not stated. *Not "
        "computed*: forces with Yeoh's law, or with a film that wrinkles. Paths end where Newton's "
        "method found no equilibrium or where they were stopped, see *Effort*."
    )


def spread_of_variants(results: Results) -> list[float]:
    """Change of the angle at 30 kPa by each of them, %."""
    posed = free(results, "c5-w7, Ogden").at(30.0)
    return [100 * (free(results, f"c5-w7, {name}").at(30.0) / posed - 1) for name in VARIANTS]


def off(ours: Sequence[float], known: float) -> str:
    """By how many per cent ours differs from the measured number."""
    low, high = (100 * (value / known - 1) for value in interval(ours))
    found = f"{low:+.0f} to {high:+.0f} %" if high - low > 0.5 else f"{low:+.0f} %"
    return found.replace("-", "−")


def verdict(results: Results) -> str:
    """How well the model does, in a few sentences."""
    parts = (verdict_on_angles, verdict_on_wrinkles, verdict_on_forces)
    return " ".join(part(results) for part in parts)


def verdict_on_angles(results: Results) -> str:
    """Slope, knee and level of c5-w7."""
    curves = [free(results, f"c5-w7, {material}") for material in MATERIALS]
    measured = measured_curve(DATA["angle"]["c5-w7"], "bending_angle_deg")
    knee, slopes = measured_knee(DATA["angle"]["c5-w7"]), SLOPES["c5-w7"]
    scaled = softer(results["c5-w7, Ogden"], 0.85)
    least, most = interval([curve.at(40.0) for curve in curves])
    first, second = (run[1] - run[0] for run in both_runs())
    factors = interval([fitted_factor(results, body) for body in BODIES])
    return (
        "Of c5-w7, over both fits: the slope before the knee is off by "
        f"{off([curve.slope(*slopes) for curve in curves], measured.slope(*slopes))}, more than "
        f"allowed, if no more than both runs of c7-w7 differ by there ({second:.1f} and "
        f"{first:.1f}°); the knee by {off([knee_of(curve) for curve in curves], knee)}, and by "
        f"{off([knee_of(scaled)], knee)} with the Ogden fit scaled to the tension data. The knees "
        f"of all three bodies fit with {factors[0]:.2f} to {factors[1]:.2f} of the Ogden fit's "
        f"stiffness, which are between both. At 40 kPa the published fits have {least:.0f} and "
        f"{most:.0f}°, where {measured.at(40.0):.0f}° were measured: behind the knee they differ "
        "too much to judge the model."
    )


def verdict_on_wrinkles(results: Results) -> str:
    """The slopes with a film that bears no compression."""
    changes = []
    for body in BODIES:
        ours = free(results, f"{body}, film that wrinkles").slope(*SLOPES[body])
        known = measured_curve(DATA["angle"][body], "bending_angle_deg").slope(*SLOPES[body])
        changes.append(off([ours], known))
    return (
        "A film that wrinkles instead of bearing compression, as a real one does, was computed "
        "once the rest was known: with it and Ogden's law the slopes of the three bodies are off "
        f"by {changes[0]}, {changes[1]} and {changes[2]}: before the knee, most of what is off as "
        "posed is the compression that the film bears there."
    )


def verdict_on_forces(results: Results) -> str:
    """The blocked force of c5-w7."""
    touching, away = (
        [blocked(results, f"force c5-w7, {which}".format(missing)) for missing in (1, 0)]
        for which in ("Ogden, {} missing", "{} missing, " + f"plate {AWAY:g}° away")
    )
    force = measured_curve(DATA["force"]["c5-w7"], "blocked_force_n")
    early = [curve.at(30.0) / force.at(30.0) for curve in touching]
    late, far = (
        [curve.at(40.0) / force.at(40.0) for curve in curves] for curves in (touching, away)
    )
    ours = tip_stiffness("c5-w7", touching[1], free(results, "c5-w7, Ogden"))
    return (
        "The blocked force does not agree: on a plate that touches from the start it is "
        f"{early[0]:.1f} times the measured one at 30 kPa and {late[0]:.1f} times at 40 kPa with "
        f"one chamber missing, {early[1]:.1f} and {late[1]:.1f} times with none. Ours is near "
        f"what a beam bears: {ours:.3f} N/mm over the free deflection from 10 to 30 kPa, where 3 "
        f"E I / L³ of the solid section is {beam_stiffness('c5-w7'):.3f}, and up to a third "
        f"more as the film holds it across. On a plate {AWAY:g}° away, a hypothesis, it is "
        f"{far[0]:.1f} and {far[1]:.1f} times the measured one at 40 kPa with one missing and with "
        "none."
    )


def report(results: Results) -> Report:
    """The section."""
    rows = [row for body in BODIES for row in angle_rows(results, body)]
    rows += [row for body in BODIES for row in force_rows(results, body)]
    tables = (fitted_stiffness, wrinkled, variants, force_table, effort)
    return Report(
        PART,
        measured_text(),
        POSED,
        tuple(rows),
        unknown(results),
        verdict(results),
        tuple(table(results) for table in tables),
        "validation_pneunets.png",
    )
