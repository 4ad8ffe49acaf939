"""The branch of equilibria that a real finger follows as loads grow from nothing.

Every step starts from the state before; Newton's first iteration is the tangent at that state, and
a step counts only if the equilibrium found is stable, near where the tangent pointed, and reached
without passing through objects. Otherwise the step is halved, down to a part of the way that
decides nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.integrate import trapezoid

from bellows_design.errors import BellowsError
from bellows_design.force.chain.balance import Unknowns
from bellows_design.force.chain.contact.forces import ContactHistory, Pressing
from bellows_design.force.chain.equilibrium import Equilibrium, NoEquilibriumError, solve
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.finger.kinematics import Configuration
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.readings import state_of, unknowns_of
from bellows_design.force.chain.settling import settled
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import LoadPoint, Surroundings
from bellows_design.force.chain.sweep import Moment, passed_through

SMALLEST_STEP = 1 / 2048
"""Part of the way between two wanted loads."""
LARGEST_CORRECTION = 0.1
"""Of a section's angle after the first iteration, rad: more is a jump, until a smaller step shows
that it is none."""
FEW_ITERATIONS = 8
"""After so many or fewer the next step is twice as long."""
MOST_JUMPS = 20
"""On one path."""
NEAR_LIMIT = 0.1
"""Margin of stability below which a lack of equilibria is ascribed to a limit point."""

Cause = Literal["instability", "limit point", "jump", "law", "no equilibrium"]


@dataclass(frozen=True)
class Ending:
    """Why a branch ended before the path's last load.

    Attributes:
        cause: ``instability``: equilibria go on, but are unstable; ``limit point``: there is none
            near, and the last one is about to lose its stability; ``jump``: the next one found is
            stable, but far away; ``law``: that of a piece does not reach so far, or is
            unstable there by itself; ``no equilibrium``: Newton's method found none.
        sentence: the same for users.
        load: where no more equilibrium was found.
        beyond: the stable equilibrium at ``load`` in which the finger comes to rest, if found.
    """

    cause: Cause
    sentence: str
    load: LoadPoint
    beyond: ChainState | None = None


@dataclass(frozen=True)
class Path:
    """Stable equilibria, of one branch where no jumps are told of.

    Attributes:
        states: at the wanted loads, as far as they were reached.
        steps: all of the way, from the first to the last good one.
        ending: why not all wanted loads were reached; None if they were.
        jumps: ends of branches from which the finger was followed to another one, as was asked.
    """

    states: tuple[ChainState, ...]
    steps: tuple[ChainState, ...]
    ending: Ending | None
    jumps: tuple[Ending, ...] = ()

    @property
    def last(self) -> ChainState:
        """The last good state."""
        return self.steps[-1]

    @property
    def work_of_pressure(self) -> float:
        """Of the air on the pieces from the first step to the last, N mm, by the trapezoid rule.

        Its error falls with the square of the steps; where the finger jumps it does not count what
        is lost in motion.
        """
        pressures = [state.pressure for state in self.steps]
        return float(trapezoid(pressures, [state.volume for state in self.steps]))


def follow(
    chain: Chain, surroundings: Surroundings, pressures: Sequence[float], *, jumps: bool = False
) -> Path:
    """States at ``pressures`` (MPa), after dead forces, weights and holds without pressure.

    The path ends where its branch does, or goes on where the finger comes to rest if ``jumps``.

    Raises:
        BellowsError: A dead force is not on the finger, or an object reaches into the undeformed
            finger.
    """
    loaded = LoadedChain.of(chain, surroundings)
    first = follow_loads(loaded, rest(loaded), [LoadPoint()], jumps=jumps)
    if first.ending:
        return Path((), first.steps, first.ending, first.jumps)
    wanted = [LoadPoint(float(each)) for each in pressures]
    path = follow_loads(loaded, first.last, wanted, jumps=jumps)
    steps = (*first.steps, *path.steps[1:])
    return Path(path.states, steps, path.ending, first.jumps + path.jumps)


def follow_loads(
    loaded: LoadedChain,
    start: ChainState,
    wanted: Sequence[LoadPoint],
    *,
    jumps: bool = False,
) -> Path:
    """The branch from ``start``, an equilibrium of ``loaded``, straight to each of ``wanted``.

    It ends where the branch does, or goes on where the finger comes to rest if ``jumps``.
    """
    steps, states = [start], list[ChainState]()
    left: list[Ending] = []
    for target in wanted:
        while ending := _go(loaded, steps, target):
            if not jumps or ending.beyond is None or len(left) == MOST_JUMPS:
                return Path(tuple(states), tuple(steps), ending, tuple(left))
            left.append(ending)
            steps.append(ending.beyond)
        states.append(steps[-1])
    return Path(tuple(states), tuple(steps), None, tuple(left))


def rest(loaded: LoadedChain) -> ChainState:
    """The undeformed finger without loads, its tip held where it is."""
    frames = loaded.at_rest.frames
    edge = np.append(loaded.edge.positions(frames)[0], frames[-1, 2])
    hold = loaded.surroundings.hold
    shift = [
        0.0 if value is None else float(at - value)
        for at, value in zip(edge, hold.values, strict=True)
    ]
    if hold.pushes_only:
        shift = [min(each, 0.0) for each in shift]
    load = LoadPoint(forces=0.0, gravity=0.0, hold_shift=(shift[0], shift[1], shift[2]))
    none = np.zeros((len(loaded.chain.pieces), 3))
    pressing = Pressing.none(*loaded.pairs)
    history = ContactHistory(loaded.contacts.positions(frames), pressing.normal, pressing)
    found = solve(loaded, load, Unknowns(none, none, np.zeros(3), pressing), history)
    return state_of(loaded, load, found)


def _go(loaded: LoadedChain, steps: list[ChainState], target: LoadPoint) -> Ending | None:
    """Append the states from the last of ``steps`` to ``target``, as far as there are any."""
    start, done, step = steps[-1].load, 0.0, 1.0
    if start == target:
        return None
    while done < 1:
        fraction = min(1.0, done + step)
        outcome = _attempt(loaded, steps[-1], start.towards(target, fraction))
        if isinstance(outcome, ChainState):
            steps.append(outcome)
            done = fraction
            step *= 2 if outcome.iterations <= FEW_ITERATIONS else 1
        elif step <= SMALLEST_STEP:
            return _with_rest(loaded, steps[-1], outcome)
        else:
            step = min(step, 1 - done) / 2
    return None


def _with_rest(loaded: LoadedChain, last: ChainState, ending: Ending) -> Ending:
    """The ending, with the state in which the finger comes to rest."""
    if ending.cause == "law":
        return ending
    return replace(ending, beyond=settled(loaded, last, ending.load))


def _attempt(loaded: LoadedChain, last: ChainState, load: LoadPoint) -> ChainState | Ending:
    """The next state, or why there is none."""
    try:
        found = solve(loaded, load, unknowns_of(last), last.history)
    except NoEquilibriumError:
        near = last.margin < NEAR_LIMIT
        return _ending("limit point" if near else "no equilibrium", load)
    except BellowsError as error:
        return Ending("law", str(error), load)
    state = state_of(loaded, load, found)
    if not state.stable:
        return _ending("instability" if np.isfinite(state.margin) else "law", load)
    if _corrected(loaded, found) > LARGEST_CORRECTION or _passed(loaded, last, state):
        return _ending("jump", load)
    return state


def _passed(loaded: LoadedChain, before: ChainState, after: ChainState) -> bool:
    """Whether a step leads through an object."""
    first, last = (
        Moment(each.motions, each.load.object_shift, each.history.positions)
        for each in (before, after)
    )
    return passed_through(loaded, first, last)


def _corrected(loaded: LoadedChain, found: Equilibrium) -> float:
    """How far the angles of the sections are from where the tangent pointed, rad."""
    pointed = Configuration.of(loaded.chain, found.first.motions).frames
    return float(np.abs(found.balance.configuration.frames - pointed)[:, 2].max())


SENTENCES: dict[str, str] = {
    "law": "a piece of the finger is unstable by itself under its section loads",
    "instability": "the finger becomes unstable: it snaps away",
    "limit point": "the finger finds no equilibrium near the last one: it snaps away",
    "jump": "the finger jumps to another equilibrium",
    "no equilibrium": "no equilibrium was found near the last one",
}


def _ending(cause: Cause, load: LoadPoint) -> Ending:
    return Ending(cause, f"at {load.pressure:.4g} MPa {SENTENCES[cause]}", load)
