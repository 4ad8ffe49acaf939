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
from bellows_design.force.chain.contact.forces import ContactHistory, Pressing
from bellows_design.force.chain.finger.kinematics import Configuration
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
LARGEST_OVERLAP = 0.02
"""Of points that come to touch in one iteration, mm."""
HOLDING = 0.1
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


@dataclass(frozen=True)
class Drag:
    """Resistance against motion since a moment before: so many times the pieces' own stiffness.

    Attributes:
        motions: at that moment (n, 3).
        rate: the factor, the inverse of the time since then.
    """

    motions: Reals
    rate: float


def solve(
    loaded: LoadedChain,
    load: LoadPoint,
    start: Unknowns,
    history: ContactHistory,
    drag: Drag | None = None,
) -> Equilibrium:
    """The equilibrium under ``load`` that Newton's method finds from ``start``.

    With ``drag`` it is that of a moment of a slow motion.

    Raises:
        NoEquilibriumError: It does not arrive.
        BellowsError: A law does not reach so far.
    """
    at, first = start, start
    for iteration in range(1, MOST_ITERATIONS + 1):
        balance = Balance.of(loaded, load, at, history)
        missing, holding = _hold(loaded, load, balance, at)
        goal = _newton_goal(balance, at, missing, holding, drag)
        part = min(_until_turned(at, goal), _until_touched(loaded, load, balance, goal))
        before, at = at, _towards(at, goal, part, holding)
        first = at if iteration == 1 else first
        if _near(before, goal):
            final = Balance.of(loaded, load, at, history)
            return Equilibrium(at, final, first, holding, iteration)
    raise NoEquilibriumError(f"no equilibrium was found in {MOST_ITERATIONS} iterations")


def beside(
    loaded: LoadedChain, load: LoadPoint, start: Unknowns, history: ContactHistory
) -> Equilibrium:
    """Where the tangent at ``start`` leads: the equilibrium beside it, to first order.

    For a chain that differs by little from the one that ``start`` is an equilibrium of.

    Raises:
        NoEquilibriumError: The tangent is singular.
    """
    balance = Balance.of(loaded, load, start, history)
    missing, holding = _hold(loaded, load, balance, start)
    goal = _newton_goal(balance, start, missing, holding, None)
    return Equilibrium(goal, Balance.of(loaded, load, goal, history), goal, holding, 1)


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


def _newton_goal(
    balance: Balance,
    at: Unknowns,
    missing: Reals,
    holding: NDArray[np.bool_],
    drag: Drag | None,
) -> Unknowns:
    """Where the tangent at ``at`` leads."""
    size = at.motions.size
    held = np.where(holding, at.held, 0.0)
    rows = balance.tip_jacobian[holding]
    lack = balance.force + (held - at.held) @ balance.tip_jacobian - at.loads.ravel()
    motion_gap = (balance.response.motion - at.motions).ravel()
    matrix = np.zeros((size + len(rows), size + len(rows)))
    matrix[:size, :size] = balance.operator
    if drag:
        motion_gap -= drag.rate * (at.motions - drag.motions).ravel()
        matrix[:size, :size] += drag.rate * np.eye(size)
    matrix[:size, size:] = -balance.flexed(rows.T)
    matrix[size:, :size] = rows
    right = np.concatenate([motion_gap + balance.flexed(lack[:, None])[:, 0], missing[holding]])
    solution = _solution(matrix, right)
    motions, pulls = solution[:size], solution[size:]
    held[holding] += pulls
    loads = lack - balance.stiffness @ motions + pulls @ rows
    return Unknowns(
        at.motions + motions.reshape(-1, 3),
        at.loads + loads.reshape(-1, 3),
        held,
        balance.contact.pressing(at.pressing.normal.shape, balance.touching @ motions),
    )


def _solution(matrix: Reals, right: Reals) -> Reals:
    """Of linear equations."""
    try:
        solution = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError as error:
        raise NoEquilibriumError("the tangent is singular") from error
    if not np.isfinite(solution).all():
        raise NoEquilibriumError("the tangent is singular")
    return solution


def _until_turned(at: Unknowns, goal: Unknowns) -> float:
    """Part of the way to ``goal`` on which no piece turns too far."""
    turn = float(np.abs(goal.motions[:, 0] - at.motions[:, 0]).max())
    return LARGEST_TURN / turn if turn > LARGEST_TURN else 1.0


def _until_touched(loaded: LoadedChain, load: LoadPoint, balance: Balance, goal: Unknowns) -> float:
    """Part of the way to ``goal`` after which the first new points touch.

    So not all those touch at once that the goal lies behind, most of which would soon let go.
    """
    objects = loaded.surroundings.objects
    if not objects:
        return 1.0
    frames = Configuration.of(loaded.chain, goal.motions).frames
    positions = loaded.contacts.positions(frames) - load.object_shift
    before = np.array([each.gap(balance.positions) for each in objects])
    after = np.array([each.gap(positions) for each in objects])
    before[balance.contact.objects, balance.contact.points] = -1.0
    new = (before >= 0) & (after < -LARGEST_OVERLAP)
    parts = (before[new] + LARGEST_OVERLAP) / (before[new] - after[new])
    return float(parts.min(initial=1.0))


def _towards(at: Unknowns, goal: Unknowns, part: float, holding: NDArray[np.bool_]) -> Unknowns:
    """The part of the way to ``goal``."""
    if part == 1:
        return goal

    def between(start: Reals, end: Reals) -> Reals:
        return start + part * (end - start)

    pressing = Pressing(
        between(at.pressing.normal, goal.pressing.normal),
        between(at.pressing.friction, goal.pressing.friction),
    )
    return Unknowns(
        between(at.motions, goal.motions),
        between(at.loads, goal.loads),
        np.where(holding, between(at.held, goal.held), 0.0),
        pressing,
    )


def _near(at: Unknowns, goal: Unknowns) -> bool:
    """Whether nothing that counts lies between."""
    load = SMALL_LOAD * max(1.0, float(np.abs(goal.loads).max()))
    forces = np.abs(goal.pressing.normal - at.pressing.normal)
    return bool(
        np.abs(goal.motions - at.motions).max() < SMALL_MOTION
        and np.abs(goal.loads - at.loads).max() < load
        and forces.max(initial=0.0) < load
    )
