"""Whether a finger passed through an object between two states, which neither of them shows."""

from __future__ import annotations

import numpy as np

from bellows_design.force.chain.finger.kinematics import Configuration
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.state import ChainState
from solver.arrays import Reals

LONGEST_WAY = 1.0
"""Of a point from one look to the next, mm."""
DEEPEST = 0.5
"""Penetration that motions between two states in contact may show, mm."""


def passed_through(loaded: LoadedChain, before: ChainState, after: ChainState) -> bool:
    """Whether motions in proportion lead points of the finger through an object."""
    if not loaded.surroundings.objects:
        return False
    ways = after.history.positions - before.history.positions
    deepest = DEEPEST + max(0.0, *(_penetration(loaded, each) for each in (before, after)))
    looks = int(np.hypot(ways[:, 0], ways[:, 1]).max() / LONGEST_WAY)
    fractions = np.arange(1, looks + 1) / (looks + 1)
    return any(_depth(loaded, before, after, each) > deepest for each in fractions)


def _penetration(loaded: LoadedChain, state: ChainState) -> float:
    """Deepest penetration in a state, mm; negative where nothing touches."""
    positions = state.history.positions
    return -min(float(each.gap(positions).min()) for each in loaded.surroundings.objects)


def _depth(loaded: LoadedChain, before: ChainState, after: ChainState, part: float) -> float:
    """Deepest penetration at part of the way, mm."""

    def between(start: Reals, end: Reals) -> Reals:
        return start + part * (end - start)

    motions = between(before.motions, after.motions)
    frames = Configuration.of(loaded.chain, motions).frames
    shift = between(np.array(before.load.object_shift), np.array(after.load.object_shift))
    positions = loaded.contacts.positions(frames) - shift
    return -min(float(each.gap(positions).min()) for each in loaded.surroundings.objects)
