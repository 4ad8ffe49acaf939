"""Newton's method with the load as an unknown and one additional equation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from solver.arrays import Reals
from solver.assembly.assembly import Equilibrium
from solver.assembly.state import State
from solver.linear.interface import SingularMatrix
from solver.nonlinear.newton import DIVERGED, Newton, pressure_bound

Row: TypeAlias = Callable[[State, Equilibrium, Reals, Reals], float]
"""The linearised extra equation: (state, equilibrium there, r, d) -> change of the load.

r (m,) is Newton's correction at the present load, d (m,) the derivative of the equilibrium with
respect to the load; the whole correction is r + change * d.
"""


@dataclass(frozen=True)
class EquilibriumPoint:
    """An equilibrium on a path, stable or not.

    ``direction`` (m,): its derivative with respect to the load. ``force`` (m,): that of the
    residual with respect to the applied pressure, mm^2. ``unstable_modes``: their number at
    constant load, None where the linear solver cannot tell. ``failure``: why this is no
    equilibrium.
    """

    state: State
    load: float
    iterations: int = 0
    direction: Reals | None = None
    force: Reals | None = None
    unstable_modes: int | None = None
    failure: str = ""

    @property
    def stable(self) -> bool | None:
        """Whether it is stable at constant load; None if unknown."""
        return None if self.unstable_modes is None else self.unstable_modes == 0


def corrected(newton: Newton, guess: State, load: float, row: Row) -> EquilibriumPoint:
    """Equilibrium near ``guess`` and ``load`` that satisfies ``row``.

    Block elimination: two right-hand sides for each factorization, which need not be that of a
    stable state.
    """
    state, size = guess, newton.problem.mesh.size
    for iteration in range(1, newton.patience + 1):
        if reason := newton.exhausted():
            return EquilibriumPoint(guess, load, iteration, failure=reason)
        equilibrium, failure = _linearised(newton, state, load)
        if failure:
            return EquilibriumPoint(guess, load, iteration, failure=failure)
        r = newton.system.solve(-equilibrium.residual)
        d = newton.system.solve(-newton.rate(state, load, equilibrium))
        change = float(row(state, equilibrium, r, d))
        increment = newton.system.expanded(r + change * d)
        correction = newton.kinematics.longest(state, increment)
        if not correction < DIVERGED * size:
            return EquilibriumPoint(
                guess, load, iteration, failure="the corrections grew without bound"
            )
        before, load = load, load + change
        moved = newton.kinematics.advanced(state, increment)
        there = newton.kinematics.with_motions(moved, load)
        newton.effort.iterations += 1
        newton.notify("iteration", load, there, iteration, correction)
        tolerance = newton.options.tolerance
        small = newton.pressure_size(increment, there) <= pressure_bound(tolerance)
        if small and correction <= tolerance * size:
            return equilibrium_point(newton, there, load, iteration)
        state = newton.extrapolation.led_on(state, before, increment, moved, load)
    return EquilibriumPoint(
        guess, load, iteration, failure=f"no convergence in {iteration} iterations"
    )


def equilibrium_point(
    newton: Newton, state: State, load: float, iterations: int = 0
) -> EquilibriumPoint:
    """An equilibrium with the direction of the path and its stability, from the tangent there."""
    equilibrium, failure = _linearised(newton, state, load)
    if failure:
        return EquilibriumPoint(state, load, iterations, failure=failure)
    direction = newton.system.solve(-newton.rate(state, load, equilibrium))
    return EquilibriumPoint(
        state, load, iterations, direction, equilibrium.force, newton.system.unstable_modes
    )


def _linearised(newton: Newton, state: State, load: float) -> tuple[Equilibrium, str]:
    """Residual and tangent at a state, the tangent factorized; or why there is none."""
    equilibrium = newton.evaluate(state, load)
    if not equilibrium.admissible:
        return equilibrium, "an element would turn inside out"
    try:
        newton.factorize(equilibrium)
    except SingularMatrix as error:
        return equilibrium, f"the tangent is singular ({error})"
    return equilibrium, ""
