"""What is held against each other: quantities of measured and computed curves, and of beams."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from record import Interval, Results, Stored

from pneunets.features import Curve, computed_curve, measured_knee
from pneunets.paths import OGDEN_MU
from pneunets.setups import BODIES, FILM

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "data" / "pneunets.json").read_text(encoding="utf-8")
)

SECOND = DATA["second_run_of_c7-w7"]

ANGLE, FORCE = "angle_deg", "force_n"

SLOPES = {"c5-w7": (15.0, 25.0), "c7-w7": (15.0, 25.0), "c5-w10": (15.0, 30.0)}

LEVELS = {"c5-w7": (40.0, 43.5), "c7-w7": (40.0,), "c5-w10": (50.0,)}

FORCES = {"c5-w7": (20.0, 30.0, 40.0), "c7-w7": (30.0, 40.0), "c5-w10": (30.0, 45.0)}
"""Pressures that are compared, kPa."""

Feature = Callable[[Curve], float]

INITIAL_MODULUS = 3 * sum(OGDEN_MU)
"""Young's, of the silicone, incompressible, MPa."""


def free(results: Results, name: str) -> Curve:
    """Angle over pressure of a computation."""
    return computed_curve(results[name].readings, ANGLE)


def blocked(results: Results, name: str) -> Curve:
    """Force over pressure of a computation."""
    return computed_curve(results[name].readings, FORCE)


def repeatability() -> float:
    """Half of what both runs of c7-w7 differ by, from 20 to 40 kPa, as a share of their mean."""
    runs = DATA["angle"]["c7-w7"], SECOND
    angles = [
        np.interp((20.0, 40.0), run["pressure_kpa"], run["bending_angle_deg"]) for run in runs
    ]
    rises = [float(end - start) for start, end in angles]
    return abs(rises[0] - rises[1]) / sum(rises)


def interval(values: Sequence[float]) -> Interval:
    """Of those that are known; NaN without any."""
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else (math.nan, math.nan)


def softer(stored: Stored, factor: float) -> Curve:
    """The curve of a material of other stiffness: equilibria at pressures times the same factor.

    That is exact if the film's stiffness is scaled too.
    """
    pressures = [factor * each for each in stored.readings["pressure_kpa"]]
    return computed_curve({**stored.readings, "pressure_kpa": pressures}, ANGLE)


def fitted_factor(results: Results, body: str) -> float:
    """On the stiffness of Ogden's law, such that the knee is where it was measured."""
    return measured_knee(DATA["angle"][body]) / free(results, f"{body}, Ogden").knee


def knee_of(curve: Curve) -> float:
    """The knee; NaN if the path ends before it."""
    knee = curve.knee
    return knee if knee < 0.995 * curve.pressure.max() or curve.value[-1] > 30 else math.nan


BENDING = (10.0, 30.0)
"""Pressures between which force and angle are compared, kPa."""


def rise(curve: Curve) -> float:
    """Between both pressures."""
    return curve.at(BENDING[1]) - curve.at(BENDING[0])


def tip_stiffness(body: str, force: Curve, angle: Curve) -> float:
    """Blocked force over the free tip's deflection, both what they rise by, N/mm."""
    deflection = BODIES[body][0].free_length * math.tan(math.radians(rise(angle)))
    return rise(force) / deflection


def beam_stiffness(body: str) -> float:
    """3 E I / L^3 of the solid section about the film, N/mm."""
    found = BODIES[body][0]
    bending = INITIAL_MODULUS * 2 * found.half_width * found.height**3 / 3
    return 3 * bending / found.free_length**3


def film_share() -> float:
    """Bending stiffness of the film over that of the solid section of c5-w7 about the film."""
    height = BODIES["c5-w7"][0].height
    film = FILM.young_modulus * FILM.thickness**3 / 12 / (1 - FILM.poisson_ratio**2)
    return film / (INITIAL_MODULUS * height**3 / 3)
