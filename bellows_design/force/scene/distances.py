"""Force against distance: load cell or wall moves away from the finger at one pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.force.chain.path import follow_loads
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import LoadPoint
from bellows_design.force.result import ForceReading
from bellows_design.force.scene.readings import Readings, force_of

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
    if not supported or not force_of(scene, state) > 0:
        return Distances()
    states, warnings = _states(readings, state)
    found = tuple(readings.of(each) for each in states)
    forces = np.array([-each.components_n[1] for each in found])
    places = np.array([each.distance_mm for each in found], dtype=float)
    return Distances(found, float(np.trapezoid(forces, places)), warnings)


def _states(readings: Readings, start: ChainState) -> tuple[list[ChainState], tuple[str, ...]]:
    """Equilibria from ``start`` to where the finger leaves its support, or finds none."""
    states, step = [start], _step(readings, start)
    for _ in range(MOST_STEPS):
        path = follow_loads(readings.loaded, states[-1], [_away(states[-1].load, step)])
        if path.ending is not None:
            where = readings.distance(path.last)
            more = path.steps[-1:] if len(path.steps) > 1 else ()
            return [*states, *more], (
                f"from a distance of {where:.3g} mm on the tip snaps off its support.",
            )
        if not force_of(readings.scene, path.last) > 0:
            return [*states, _just_left(readings, path.last)], ()
        states.append(path.last)
    return states, ()


def _step(readings: Readings, state: ChainState) -> float:
    """Of the support, mm."""
    length = readings.design.bellows.length
    stiffness = readings.tip_stiffness(state) or math.nan
    wanted = force_of(readings.scene, state) / stiffness / INTERVALS
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
    further = readings.distance(state) + readings.lowest(state)
    return replace(state, load=_away(state.load, -further))
