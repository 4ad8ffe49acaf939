"""Force against distance: load cell or wall moves away from the finger at one pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import trapezoid

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.force.chain.path import Ending, Path, follow_loads
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import LoadPoint
from bellows_design.force.result import ForceReading
from bellows_design.force.scene.exerted import force_of
from bellows_design.force.scene.readings import Readings
from bellows_design.force.scene.support import presses

INTERVALS = 10
"""From the support's place to where the finger would leave it by its first stiffness."""

MOST_STEPS = 60
SHORTEST, LONGEST = 1 / 500, 1 / 25
"""Of the finger's length: bounds of a step."""


@dataclass(frozen=True)
class Distances:
    """Readings while the support moves away, the work on it (mJ), and what is to be said."""

    readings: tuple[ForceReading, ...] = ()
    work: float | None = None
    warnings: tuple[str, ...] = ()


def moved_away(readings: Readings, state: ChainState) -> Distances:
    """Move the support of a blocked finger from ``state`` to where the finger leaves it.

    Empty in other scenes, of a tip that is held, and where nothing is pressed upon.
    """
    scene = readings.scene
    supported = isinstance(scene, Blocked) and scene.support != "held"
    if not supported or not presses(scene, state):
        return Distances()
    states, warnings = _states(readings, state)
    found = tuple(readings.of(each) for each in states)
    forces = np.array([-each.components_n[1] for each in found])
    places = np.array([each.distance_mm for each in found], dtype=float)
    return Distances(found, float(trapezoid(forces, places)), warnings)


def _states(readings: Readings, start: ChainState) -> tuple[list[ChainState], tuple[str, ...]]:
    """Equilibria from ``start`` to where the finger leaves its support, or finds none."""
    states, said, step = [start], list[str](), _step(readings, start)
    for _ in range(MOST_STEPS):
        away = _away(states[-1].load, step)
        path = follow_loads(readings.loaded, states[-1], [away], jumps=True)
        said += _jumps(readings, path)
        pressing = [each for each in path.steps[1:] if presses(readings.scene, each)]
        if path.ending is None and pressing and pressing[-1] is path.last:
            states.append(path.last)
        elif path.ending or path.jumps:
            return [*states, *pressing[-1:]], tuple(said)
        else:
            return [*states, _just_left(readings, path.last)], tuple(said)
    return states, tuple(said)


def _jumps(readings: Readings, path: Path) -> list[str]:
    """A sentence for each branch that ended."""
    said = []
    for each in (*path.jumps, *filter(None, [path.ending])):
        where = f"{readings.distance(each.load):.3g} mm"
        what = _ended(readings, each)
        said.append(f"as its support moves away, at a distance of {where}, {what}.")
    return said


def _ended(readings: Readings, each: Ending) -> str:
    """What the finger does where a branch ends, or why it is not known."""
    if each.beyond is not None:
        stays = presses(readings.scene, each.beyond)
        what = "jumps to another equilibrium on its support" if stays else "snaps off it"
        return f"the finger {what}"
    if each.cause in {"law", "no equilibrium"}:
        return f"the curve ends: {each.sentence.rstrip('.')}"
    return "the finger snaps away, and it is not known to where"


def _step(readings: Readings, state: ChainState) -> float:
    """Of the support, mm."""
    length = readings.design.finger_length
    stiffness = readings.tip_stiffness(state) or math.nan
    wanted = abs(force_of(readings.scene, state) / stiffness) / INTERVALS
    if not math.isfinite(wanted):
        return length * LONGEST
    return float(np.clip(wanted, SHORTEST * length, LONGEST * length))


def _away(load: LoadPoint, step: float) -> LoadPoint:
    """The load with the support ``step`` mm further down."""
    hold, objects = load.hold_shift, load.object_shift
    return replace(
        load,
        hold_shift=(hold[0], hold[1] - step, hold[2]),
        object_shift=(objects[0], objects[1] - step),
    )


def _just_left(readings: Readings, state: ChainState) -> ChainState:
    """The free finger with its support where it would just touch it."""
    further = readings.distance(state.load) + readings.lowest(state)
    return replace(state, load=_away(state.load, -further))
