"""Equilibria of the unit cell, each from that of a neighbour."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from bellows_design.force.law.interpolation.points import HALVES, SectionPoint

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from solver import Mesh, Problem, Solution
    from solver.nonlinear.newton import Newton

HALVINGS = 4
"""Of a step that leads nowhere."""


@dataclass(frozen=True)
class Solved:
    """An equilibrium with its state."""

    point: SectionPoint
    solution: Solution


@dataclass
class Continuation:
    """Solves the cell of a design on one mesh.

    Attributes:
        problem: the cell without a couple.
        refusal: why a state does not hold, as text, empty if it does.
        factorizations: so far.
        attempts: solves from a neighbour so far, failed ones included.
    """

    problem: Problem
    refusal: Callable[[Solution], str] = lambda _: ""
    factorizations: int = 0
    attempts: int = 0
    _newton: Newton | None = field(default=None, repr=False)
    _last: Solution | None = field(default=None, repr=False)

    @staticmethod
    def of(design: Design, mesh: Mesh) -> Continuation:
        """That of a design's unit cell."""
        from bellows_design.analysis.models import UNIT_CELL
        from bellows_design.analysis.wall_contact import touch_guard

        problem = UNIT_CELL.problem(design, mesh)
        guard = touch_guard(design.bellows, problem)
        return Continuation(problem, lambda solution: guard(solution.state))

    def anew(self) -> Continuation:
        """One for the same cell that knows nothing yet."""
        return Continuation(self.problem, self.refusal)

    def from_zero(self, pressures: tuple[float, ...]) -> tuple[list[Solved], str]:
        """Without a couple, at pressures (MPa) of one sign from the smallest to the largest one.

        As many as were reached, and why no more.
        """
        from solver import solve

        left: list[Newton] = []
        ordered = sorted(pressures, key=abs)
        found = solve(self.problem, ordered[-1], stops=ordered[:-1], keep=left.append)
        self.factorizations += found.factorizations
        self._newton, self._last = left[0], found
        reached = [*found.at_stops, *([found] if found.converged else [])]
        return [self._solved(each, 0.0, None) for each in reached], found.message

    def known(self, solution: Solution) -> Solved:
        """An equilibrium on this mesh without a couple that is at hand."""
        return self._solved(solution, 0.0, None)

    def beside(self, near: Solved, pressure: float, moment: float) -> Solved | str:
        """The equilibrium at a pressure (MPa) and moment (N mm), full width, or why there is none.

        Where it is not found from ``near`` at once, by halved steps.
        """
        found = self._step(near, pressure, moment)
        for halving in range(1, HALVINGS + 1):
            if not isinstance(found, str):
                return found
            found = self._in_steps(near, pressure, moment, 2**halving)
        return found

    def shear_compliance(self, free: Solved) -> float:
        """Slip by shear force of the full width, mm per N; 0 where it cannot be told.

        Where bending between the gaps makes it negative it is left out: a chain of such pieces
        would be unstable without any load.
        """
        from solver import shear_compliance
        from solver.errors import SolverError

        try:
            return max(0.0, shear_compliance(free.solution) / HALVES)
        except SolverError:  # inner walls touch at the bubble's middle
            return 0.0

    def _in_steps(self, near: Solved, pressure: float, moment: float, steps: int) -> Solved | str:
        start, at = near.point, near
        for number in range(1, steps + 1):
            share = number / steps
            between = start.pressure + share * (pressure - start.pressure)
            found = self._step(at, between, start.moment + share * (moment - start.moment))
            if isinstance(found, str):
                return found
            at = found
        return at

    def _step(self, near: Solved, pressure: float, moment: float) -> Solved | str:
        from solver import Couple, neighbouring

        couple = moment / HALVES
        problem = replace(self.problem, loads=(Couple(couple),))
        if near.solution is not self._last and self._newton is not None:
            self._newton.system.forget()
        found = neighbouring(problem, pressure, near.solution, former=self._newton)
        self.attempts += 1
        self._newton, self._last = found.newton, found.solution
        self.factorizations += found.newton.effort.factorizations
        if found.solution is None:
            return found.failure
        if reason := self.refusal(found.solution):
            return reason
        if found.solution.stable is False:
            return "the equilibrium would be unstable"
        return self._solved(found.solution, couple, found.newton)

    def _solved(self, solution: Solution, couple: float, newton: Newton | None) -> Solved:
        from bellows_design.analysis.wall_contact import image_gap
        from bellows_design.geometry.face_names import OUTSIDE
        from solver import peak_von_mises, section_response

        section = section_response(solution, newton)
        self.factorizations += section.factorizations
        (gap,) = image_gap(solution, OUTSIDE)
        effort = solution.factorizations + section.factorizations
        point = SectionPoint.of(
            couple, section, peak_von_mises(solution), gap, solution.stable, effort
        )
        return Solved(point, solution)
