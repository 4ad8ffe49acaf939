"""How far off a force may be: what the law does not know, times how the force depends on it.

Whatever the law is wrong by is taken as a rotation of every piece, or of the ends, that it does not
know of. Each is given to the chain once, and the equilibrium beside it is found to first order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.force.chain.equilibrium import beside
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.readings import state_of, unknowns_of
from bellows_design.force.chain.state import ChainState
from bellows_design.force.finger_law import Uncertainty
from bellows_design.force.result import ForceError
from bellows_design.force.section_law import SectionLaw, SectionResponse
from solver.arrays import Reals

SMALL_TURN, SMALL_SHEAR = 1e-5, 1e-4
"""rad, of one piece, and fraction of shear's compliance: by which the force's dependence is found.
Objects are so stiff that larger ones would show the curvature of the chain's motion instead."""


LEAST_FORCE = 1e-9
"""N: what rounding leaves where there is no force."""


@dataclass(frozen=True)
class ShiftedLaw:
    """A law whose piece turns by ``rotation`` (rad) more, and shears by ``shear`` times as much."""

    law: SectionLaw
    rotation: float = 0.0
    shear: float = 1.0

    @property
    def length(self) -> float:
        """Distance of the two sections at rest, mm."""
        return self.law.length

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and section loads (k, 3)."""
        own = self.law.response(pressure, loads)
        softer = (self.shear - 1) * own.compliance[:, 2, 2]
        slip = softer * loads[:, 2]
        compliance = own.compliance.copy()
        compliance[:, 2, 2] += softer
        motion = own.motion + np.stack(
            [np.full(len(loads), self.rotation), np.zeros(len(loads)), slip], axis=1
        )
        energy = own.energy + self.rotation * loads[:, 0] + slip * loads[:, 2] / 2
        return SectionResponse(energy, motion, compliance, own.volume, own.motion_by_pressure)


Force = Callable[[ChainState], float]


def force_error(
    loaded: LoadedChain, state: ChainState, force: Force, unknown: Uncertainty
) -> ForceError:
    """Estimated errors of ``force`` in an equilibrium, percent of it; zeros where it is none."""
    value = float(force(state))
    if abs(value) < LEAST_FORCE or unknown == Uncertainty():
        return ForceError()
    everywhere, root, tip, shear = _dependences(loaded, state, force)
    percent = 100 / abs(value)
    return ForceError(
        interpolation=percent * abs(everywhere * unknown.interpolation),
        mesh=percent * abs(everywhere * unknown.mesh),
        ends=percent * (abs(root * unknown.root) + abs(tip * unknown.tip)),
        shear=percent * abs(shear * unknown.shear),
        neighbours=percent * abs(everywhere * unknown.neighbours),
    )


def _dependences(
    loaded: LoadedChain, state: ChainState, force: Force
) -> tuple[float, float, float, float]:
    """Derivatives of the force by rotations (N/rad) of all pieces, the first and the last one, and
    by the shear compliance, relative to itself (N)."""
    count, value = len(loaded.chain.pieces), force(state)
    every = np.ones(count)
    first, last = np.eye(count)[0], np.eye(count)[-1]
    by_turn = [
        (force(_again(loaded, state, turns * SMALL_TURN)) - value) / SMALL_TURN
        for turns in (every, first, last)
    ]
    stiffer = force(_again(loaded, state, 0 * every, shear=1 - SMALL_SHEAR)) - value
    return float(by_turn[0]), float(by_turn[1]), float(by_turn[2]), float(stiffer / SMALL_SHEAR)


def _again(loaded: LoadedChain, state: ChainState, turns: Reals, shear: float = 1.0) -> ChainState:
    """To first order, the state whose pieces turn by ``turns`` (n,) more than in ``state``, rad."""
    laws: dict[tuple[int, float], ShiftedLaw] = {}
    pieces = tuple(
        replace(
            piece,
            law=laws.setdefault((id(piece.law), turn), ShiftedLaw(piece.law, turn, shear)),
        )
        for piece, turn in zip(loaded.chain.pieces, turns.tolist(), strict=True)
    )
    other = replace(loaded, chain=replace(loaded.chain, pieces=pieces))
    found = beside(other, state.load, unknowns_of(state), state.history)
    return state_of(other, state.load, found)
