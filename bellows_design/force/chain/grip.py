"""What a finger holds: it closes on an object that stands still, which is then pulled away.

One finger and its mirror images stand around the object, so that their forces across the pull
cancel; what is left is a force along the pull, the same for every finger.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import Ending, Path, follow, follow_loads
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import Surroundings

LET_GO = 0.5
"""Part of the largest force at which the pull ends."""
CLOSE = 1e-3
"""To a force that is looked for, as part of it."""
FINER = 8
"""Steps that take the place of two where the force is largest."""
MOST_TRIALS = 40


@dataclass(frozen=True)
class Pull:
    """How an object is pulled out of a grip.

    Attributes:
        direction: x and z, a unit vector: that of gravity.
        step: of the curve, mm.
        longest: way, mm.
    """

    direction: tuple[float, float] = (1.0, 0.0)
    step: float = 0.25
    longest: float = 20.0

    def way(self, state: ChainState) -> float:
        """How far the objects are along the pull, mm."""
        return float(np.dot(state.load.object_shift, self.direction))

    def force(self, state: ChainState) -> float:
        """What a finger holds the objects back with, N; negative where it pushes them away."""
        return float(np.dot(state.contact_force, self.direction))


@dataclass(frozen=True)
class Grip:
    """A finger's grip.

    Attributes:
        loaded: the finger, and the object.
        closing: the path to the pressure; no grip without its last state.
        pull: how the object is pulled.
        pulled: states along the pull, from the closed finger on.
        ending: why the pull ended before the finger let go, if by its equilibrium.
        jumps: where the finger jumped while the object was pulled.
        let_go: whether the force fell to half of its largest value; otherwise a longer pull may
            find a larger one.
    """

    loaded: LoadedChain
    closing: Path
    pull: Pull
    pulled: tuple[ChainState, ...]
    ending: Ending | None
    let_go: bool
    jumps: tuple[Ending, ...] = ()

    @property
    def curve(self) -> tuple[tuple[float, float], ...]:
        """Way of the object (mm) and force per finger (N), along the pull."""
        return tuple((self.pull.way(state), self.pull.force(state)) for state in self.pulled)

    @property
    def strongest(self) -> ChainState | None:
        """Where the force is largest; None where the finger did not close."""
        return max(self.pulled, key=self.pull.force, default=None)

    @property
    def largest_force(self) -> float:
        """What one finger holds, N; zero where it does not reach the object or only pushes it."""
        return max(0.0, max((self.pull.force(state) for state in self.pulled), default=0.0))

    def under(self, force: float) -> ChainState | None:
        """Equilibrium of the object with ``force`` (N) per finger along the pull.

        On the rising branch, or before it where the closing finger draws the object in. None where
        the force is more than the largest one: the object slips; or where none is found.
        """
        if not self.pulled or force > self.largest_force:
            return None
        start = self.pulled[0]
        if self.pull.force(start) > force:
            return self._drawn_in(force)
        after = next(n for n, state in enumerate(self.pulled) if self.pull.force(state) >= force)
        return self._between(self.pulled[max(after - 1, 0)], self.pulled[after], force)

    def _drawn_in(self, force: float) -> ChainState | None:
        """The equilibrium against the pull's direction."""
        last = self.pulled[0]
        for number in range(1, round(self.pull.longest / self.pull.step) + 1):
            path = _moved(self.loaded, last, self.pull, -number * self.pull.step)
            if path.ending:
                return None
            if self.pull.force(path.last) <= force:
                return self._between(last, path.last, force)
            last = path.last
        return None

    def _between(self, start: ChainState, end: ChainState, force: float) -> ChainState | None:
        """The state with ``force`` between two neighbouring ones, by bisection."""
        near = CLOSE * max(force, CLOSE * self.largest_force, 1e-12)
        first, last = self.pull.way(start), self.pull.way(end)
        rises = self.pull.force(end) > self.pull.force(start)
        found = end
        for _ in range(MOST_TRIALS):
            if abs(self.pull.force(found) - force) <= near:
                return found
            middle = (first + last) / 2
            path = _moved(self.loaded, start, self.pull, middle)
            if path.ending:
                return None
            found = path.last
            below = (self.pull.force(found) < force) == rises
            first, last = (middle, last) if below else (first, middle)
        return None


def grip(
    chain: Chain, surroundings: Surroundings, pressures: Sequence[float], pull: Pull | None = None
) -> Grip:
    """Close a finger on the objects of ``surroundings`` along ``pressures`` (MPa), then pull them.

    Objects are where the gripper's axis is, at rest while it closes.

    Raises:
        BellowsError: An object reaches into the undeformed finger.
    """
    closing = follow(chain, surroundings, pressures, jumps=True)
    return pulled(LoadedChain.of(chain, surroundings), closing, pull or Pull())


def pulled(loaded: LoadedChain, closing: Path, pull: Pull) -> Grip:
    """Pull the objects of ``loaded`` out of the grip that ``closing`` has ended with."""
    if closing.ending:
        return Grip(loaded, closing, pull, (), None, False)
    states, ending = [closing.last], None
    jumps: list[Ending] = []
    longest = pull.longest + 1e-9
    while not _let_go(states, pull) and ending is None:
        way = pull.way(states[-1]) + pull.step
        if way > longest:
            break
        path = _moved(loaded, states[-1], pull, way)
        states.extend(path.steps[1:])
        jumps.extend(path.jumps)
        ending = path.ending
    released = _let_go(states, pull)
    states = _with_peak(loaded, states, pull)
    return Grip(loaded, closing, pull, tuple(states), ending, released, tuple(jumps))


def _with_peak(loaded: LoadedChain, states: list[ChainState], pull: Pull) -> list[ChainState]:
    """The states, with finer steps about the one where the force is largest."""
    top = max(range(len(states)), key=lambda number: pull.force(states[number]))
    first, last = max(top - 1, 0), min(top + 1, len(states) - 1)
    if first == last:
        return states
    ways = np.linspace(pull.way(states[first]), pull.way(states[last]), FINER + 1)[1:]
    fine = [states[first]]
    for way in ways:
        path = _moved(loaded, fine[-1], pull, float(way))
        if path.ending or path.jumps:
            break
        fine.append(path.last)
    reached = pull.way(fine[-1])
    return states[:first] + fine + [each for each in states[top:] if pull.way(each) > reached]


def _moved(loaded: LoadedChain, start: ChainState, pull: Pull, way: float) -> Path:
    """The path from ``start`` until the objects are ``way`` mm along the pull."""
    shift = pull.direction[0] * way, pull.direction[1] * way
    return follow_loads(loaded, start, [start.load.shifted(shift)], jumps=True)


def _let_go(states: Sequence[ChainState], pull: Pull) -> bool:
    """Whether the finger no longer holds the object."""
    if not states[-1].contacts:
        return True
    largest = max(pull.force(state) for state in states)
    return largest > 0 and pull.force(states[-1]) < LET_GO * largest
