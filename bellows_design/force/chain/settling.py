"""Where a finger comes to rest that has lost its stability.

It moves slowly, against a resistance in proportion to its own stiffness: motions d and section
loads s obey d' = dG/ds(s) - d with s = -dP/dd, implicitly in time. So it leaves what is unstable
and comes to rest where all eigenvalues of I + C P'' are positive.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.chain.balance import Unknowns
from bellows_design.force.chain.contact.forces import ContactHistory
from bellows_design.force.chain.equilibrium import Drag, Equilibrium, solve
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.readings import history_of, state_of, unknowns_of
from bellows_design.force.chain.stability import least_stable_motion
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import LoadPoint
from bellows_design.force.chain.sweep import Moment, passed_through

NUDGE = 0.02
"""Rotation of a piece by which it is moved off an unstable equilibrium, rad."""
FIRST_TIME, SHORTEST_TIME, LONGEST_TIME = 0.5, 1e-3, 1e3
"""Steps in time, in units of the motion's own."""
SLOW, FAST = 0.02, 0.2
"""Rotations of a piece in one step, rad: below the first the next one is longer, above the second
it is taken again, shorter."""
AT_REST = 1e-9
"""Rotation by time, rad."""
MOST_STEPS, MOST_RESTS = 300, 4


def settled(loaded: LoadedChain, last: ChainState, load: LoadPoint) -> ChainState | None:
    """The stable equilibrium under ``load`` to which the finger moves from ``last``, if any."""
    at, history = unknowns_of(last), last.history
    for _ in range(MOST_RESTS):
        try:
            found = solve(loaded, load, at, history)
        except BellowsError:
            moved = _at_rest(loaded, load, at, history)
        else:
            state = state_of(loaded, load, found)
            if state.stable:
                return state
            moved = _at_rest(loaded, load, _aside(found), history)
        if moved is None:
            return None
        at, history = moved
    return None


def _at_rest(
    loaded: LoadedChain, load: LoadPoint, at: Unknowns, history: ContactHistory
) -> tuple[Unknowns, ContactHistory] | None:
    """Where the motion ends that begins at ``at``; it may be unstable. None if it does not."""
    time = FIRST_TIME
    for _ in range(MOST_STEPS):
        found = _moment(loaded, load, at, history, time)
        turn = np.inf if found is None else _turn(at, found.at)
        if found is None or turn > FAST:
            time /= 4
            if time < SHORTEST_TIME:
                return None
            continue
        at, history = found.at, history_of(loaded, found)
        if turn < AT_REST * time:
            return at, history
        time = min(2 * time, LONGEST_TIME) if turn < SLOW else time
    return None


def _aside(found: Equilibrium) -> Unknowns:
    """Beside an unstable equilibrium, where it is least stable."""
    aside = NUDGE * least_stable_motion(found.balance, found.holding)
    return replace(found.at, motions=found.at.motions + aside)


def _moment(
    loaded: LoadedChain, load: LoadPoint, at: Unknowns, history: ContactHistory, time: float
) -> Equilibrium | None:
    """The motion's next moment; None if it is not found, or behind an object."""
    try:
        found = solve(loaded, load, at, history, Drag(at.motions, 1 / time))
    except BellowsError:
        return None
    before = Moment(at.motions, load.object_shift, history.positions)
    after = Moment(found.at.motions, load.object_shift, found.balance.positions)
    return None if passed_through(loaded, before, after) else found


def _turn(before: Unknowns, after: Unknowns) -> float:
    """Largest rotation of a piece between two moments, rad."""
    return float(np.abs(after.motions - before.motions)[:, 0].max())
