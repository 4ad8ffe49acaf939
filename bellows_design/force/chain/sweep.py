"""Whether a finger passed through an object between two moments, which neither of them shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.force.chain.finger.kinematics import Configuration
from bellows_design.force.chain.loaded_chain import LoadedChain
from solver.arrays import Reals

LONGEST_WAY = 1.0
"""Of a point from one look to the next, mm."""
DEEPEST = 0.5
"""Penetration, beyond that of both moments, that motions in proportion may show, mm."""


@dataclass(frozen=True)
class Moment:
    """Where a finger is.

    Attributes:
        motions: of the pieces (n, 3).
        shift: of the objects, x and z in mm.
        positions: of points that objects may touch, relative to the objects (m, 2), mm.
    """

    motions: Reals
    shift: tuple[float, float]
    positions: Reals


def passed_through(loaded: LoadedChain, before: Moment, after: Moment) -> bool:
    """Whether motions in proportion lead points of the finger through an object."""
    if not loaded.surroundings.objects:
        return False
    ends = [_depth(loaded, each.positions) for each in (before, after)]
    ways = after.positions - before.positions
    looks = int(np.hypot(ways[:, 0], ways[:, 1]).max() / LONGEST_WAY)
    parts = np.arange(1, looks + 1) / (looks + 1)
    between = (_depth(loaded, _between(loaded, before, after, part)) for part in parts)
    return any(depth > DEEPEST + max(0.0, *ends) for depth in between)


def _depth(loaded: LoadedChain, positions: Reals) -> float:
    """Deepest penetration, mm; negative where nothing touches."""
    return -min(float(each.gap(positions).min()) for each in loaded.surroundings.objects)


def _between(loaded: LoadedChain, before: Moment, after: Moment, part: float) -> Reals:
    """Positions at part of the way."""
    motions = before.motions + part * (after.motions - before.motions)
    frames = Configuration.of(loaded.chain, motions).frames
    shift = np.array(before.shift) + part * np.subtract(after.shift, before.shift)
    return loaded.contacts.positions(frames) - shift
