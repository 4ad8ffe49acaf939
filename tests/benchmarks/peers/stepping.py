"""One load path for every code that leaves it to its user: adaptive steps with extrapolation.

Plain Newton from the extrapolation of the last two states; steps grow after a success and are cut
back after a failure. Tolerances are those of our solver: 1e-5 of the body's diagonal at the load
asked for, 5e-3 on the way there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from case import FULL_PRESSURE, Progress, Reals

FIRST_STEP, SMALLEST_STEP = 0.05, 1e-3
"""Fractions of 0.1 MPa. Of ten pairs of first step and growth tried, these needed the fewest
iterations (44; the others up to 71)."""

GROWTH = 1.25
CUT = 0.5
MAXIMUM_ITERATIONS = 12
TOLERANCE = 1e-5
LOOSE_TOLERANCE = 5e-3
DIVERGED = 1.0
"""In units of the body's diagonal, as the tolerances."""


class Model(Protocol):
    """A code under the load driver.

    ``correct`` takes all unknowns and a pressure (MPa), and returns one Newton correction of the
    unknowns; ``displacement`` extracts (n, 3), mm, from them. ``correct`` raises
    ``ArithmeticError`` where the code breaks down.
    """

    def correct(self, unknowns: Reals, pressure: float) -> Reals: ...
    def displacement(self, unknowns: Reals) -> Reals: ...


class Refused(ArithmeticError):
    """Newton did not converge at a load."""


@dataclass(frozen=True)
class Point:
    """An equilibrium at ``pressure`` (MPa), or a guess of one."""

    pressure: float
    unknowns: Reals


def walk(model: Model, origin: Reals, pressure: float, progress: Progress) -> str:
    """Go from ``origin`` at zero load to ``pressure`` (MPa); says how it ended."""
    before = now = Point(0.0, origin)
    step = min(FIRST_STEP * FULL_PRESSURE, pressure)
    while now.pressure < pressure:
        target = min(now.pressure + step, pressure)
        tolerance = TOLERANCE if target == pressure else LOOSE_TOLERANCE
        try:
            found = newton(model, extrapolated(before, now, target), tolerance, progress)
        except ArithmeticError as failure:
            step = CUT * (target - now.pressure)
            if step < SMALLEST_STEP * FULL_PRESSURE:
                return f"stopped at {now.pressure:.4g} MPa: {failure}"
            continue
        before, now, step = now, found, GROWTH * step
        progress.reached(now.pressure, model.displacement(now.unknowns))
    return f"reached {now.pressure:.4g} MPa"


def extrapolated(before: Point, now: Point, target: float) -> Point:
    """Guess at the ``target`` pressure on the line through two equilibria."""
    if before.pressure == now.pressure:
        return Point(target, now.unknowns)
    ratio = (target - now.pressure) / (now.pressure - before.pressure)
    return Point(target, now.unknowns + ratio * (now.unknowns - before.unknowns))


def newton(model: Model, guess: Point, tolerance: float, progress: Progress) -> Point:
    """Correct a guess until a correction of the displacement is small; ``Refused`` if never.

    A loose tolerance counts only while corrections shrink.
    """
    unknowns, previous, size = guess.unknowns, 0.0, progress.case.size
    for _ in range(MAXIMUM_ITERATIONS):
        correction = model.correct(unknowns, guess.pressure)
        progress.iterations += 1
        largest = float(np.abs(model.displacement(correction)).max())
        if not largest < DIVERGED * size:
            raise Refused("the Newton corrections grew without bound")
        unknowns = unknowns + correction
        if largest <= (tolerance if largest < previous else TOLERANCE) * size:
            return Point(guess.pressure, unknowns)
        previous = largest
    raise Refused(f"Newton did not converge in {MAXIMUM_ITERATIONS} iterations")
