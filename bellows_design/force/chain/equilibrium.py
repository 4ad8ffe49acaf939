"""Equilibrium of a loaded chain by Newton's method in motions, section loads and held forces.

With the complementary energy G of the pieces and the potential P of loads and contacts, motions d
and section loads s obey d = dG/ds and s = -dP/dd. Both are unknown, so that stiff contacts and soft
pieces stand beside each other, and a piece may be rigid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError
from bellows_design.force.chain.balance import Balance, Unknowns
from bellows_design.force.chain.contact.forces import SlipHistory
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.surroundings import LoadPoint
from solver.arrays import Reals

MOST_ITERATIONS = 25
SMALL_MOTION = 1e-9
"""Last correction of a motion, rad or mm; quadratic convergence leaves much less."""
SMALL_LOAD = 1e-8
"""Last correction of a section load, as part of the largest one, or in N mm and N."""
LARGEST_TURN = 0.5
"""Of a piece in one iteration, rad."""
HOLDING = 1.0
"""N/mm: which of a load cell's force and its distance decides whether it is touched; any positive
value leads to the same result."""


class NoEquilibriumError(BellowsError):
    """Newton's method did not arrive."""


@dataclass(frozen=True)
class Equilibrium:
    """A solution.

    Attributes:
        at: the unknowns.
        balance: at them.
        first: the unknowns after one iteration: the start moved along the tangent.
        holding: which of the tip's components are held (3,).
        iterations: that were needed.
    """

    at: Unknowns
    balance: Balance
    first: Unknowns
    holding: NDArray[np.bool_]
    iterations: int


def solve(
    loaded: LoadedChain, load: LoadPoint, start: Unknowns, history: SlipHistory
) -> Equilibrium:
    """The equilibrium under ``load`` that Newton's method finds from ``start``.

    Raises:
        NoEquilibriumError: It does not arrive.
        BellowsError: A law does not reach so far.
    """
    at, first = start, start
    for iteration in range(1, MOST_ITERATIONS + 1):
        balance = Balance.of(loaded, load, at, history)
        missing, holding = _hold(loaded, load, balance, at)
        step = _newton_step(balance, at, missing, holding)
        at = _moved(at, step, holding)
        first = at if iteration == 1 else first
        if _small(step, at):
            final = Balance.of(loaded, load, at, history)
            return Equilibrium(at, final, first, holding, iteration)
    raise NoEquilibriumError(f"no equilibrium was found in {MOST_ITERATIONS} iterations")


def _hold(
    loaded: LoadedChain, load: LoadPoint, balance: Balance, at: Unknowns
) -> tuple[Reals, NDArray[np.bool_]]:
    """What the tip lacks to its held values (3,), and which of them act."""
    hold = loaded.surroundings.hold
    given = np.array([np.nan if value is None else value for value in hold.values])
    missing = given + load.hold_shift - balance.tip
    holding = np.isfinite(missing)
    if hold.pushes_only:
        holding &= at.held + HOLDING * np.nan_to_num(missing) > 0
    return missing, holding


def _newton_step(
    balance: Balance, at: Unknowns, missing: Reals, holding: NDArray[np.bool_]
) -> Unknowns:
    """Corrections; those of the held forces count where they act."""
    size = at.motions.size
    released = np.where(holding, 0.0, -at.held)
    rows = balance.tip_jacobian[holding]
    force = balance.force + released @ balance.tip_jacobian
    lack = force - at.loads.ravel()
    motion_gap = (balance.response.motion - at.motions).ravel()
    matrix = np.zeros((size + len(rows), size + len(rows)))
    matrix[:size, :size] = balance.operator
    matrix[:size, size:] = -balance.flexed(rows.T)
    matrix[size:, :size] = rows
    right = np.concatenate([motion_gap + balance.flexed(lack[:, None])[:, 0], missing[holding]])
    try:
        solution = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError as error:
        raise NoEquilibriumError("the tangent is singular") from error
    if not np.isfinite(solution).all():
        raise NoEquilibriumError("the tangent is singular")
    motions, held = solution[:size], released
    held[holding] = solution[size:]
    loads = lack - balance.stiffness @ motions + solution[size:] @ rows
    return Unknowns(motions.reshape(-1, 3), loads.reshape(-1, 3), held)


def _moved(at: Unknowns, step: Unknowns, holding: NDArray[np.bool_]) -> Unknowns:
    """The unknowns after a step, or the part of it that turns no piece too far."""
    turn = np.abs(step.motions[:, 0]).max()
    part = min(1.0, LARGEST_TURN / turn) if turn else 1.0
    held = np.where(holding, at.held + part * step.held, 0.0)
    return Unknowns(at.motions + part * step.motions, at.loads + part * step.loads, held)


def _small(step: Unknowns, at: Unknowns) -> bool:
    """Whether a step changed nothing that counts."""
    load = max(1.0, float(np.abs(at.loads).max()))
    return bool(
        np.abs(step.motions).max() < SMALL_MOTION and np.abs(step.loads).max() < SMALL_LOAD * load
    )
