"""The equilibrium path by arc length, through limit points of the load.

Each step is predicted along the unit tangent of the path and corrected at a right angle to it (Riks
1979, in Ramm's form with a linear constraint; lengths are measured in displacements alone). Where
the slope of the load changes its sign there is a limit point; where the inertia of the tangent
changes without that, a bifurcation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.assembly.assembly import Equilibrium
from solver.assembly.state import State
from solver.errors import SolverError
from solver.nonlinear.events import Listener
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.nonlinear.options import FIRST_STEP, SolverOptions
from solver.paths.bordering import EquilibriumPoint, corrected, equilibrium_point
from solver.problem.problem import Problem
from solver.results.solution import PathPoint, Solution

LONGEST_STEP = 0.05
"""Longest step, root mean square over the nodes, in units of the body's diagonal."""


@dataclass(frozen=True)
class Limit:
    """A limit point, where the load has an extremum along the path, or a bifurcation.

    Attributes:
        kind: of the load's extremum; ``bifurcation`` where the stability changes without one.
        point: the equilibrium there.
    """

    kind: Literal["maximum", "minimum", "bifurcation"]
    point: PathPoint

    def describe(self, pressure: float) -> str:
        """As text, for a whole load with that pressure (MPa)."""
        load = self.point.load
        at = f"p = {load * pressure:.4g} MPa" if pressure else f"{100 * load:.4g} % of the load"
        if self.kind == "bifurcation":
            return f"stability is lost at {at}, where the body buckles"
        return f"limit at {at}, beyond it there is no equilibrium nearby"


@dataclass(frozen=True)
class Trace:
    """An equilibrium path.

    Attributes:
        points: its equilibria, with those of ``limits``.
        states: fields of each of the points.
        limits: the limit points and bifurcations found on it.
        message: why it ends.
    """

    points: tuple[PathPoint, ...]
    states: tuple[State, ...]
    limits: tuple[Limit, ...]
    message: str


def trace(
    problem: Problem,
    pressure: float = 0.0,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    steps: int = 60,
    longest_step: float = LONGEST_STEP,
    until: Callable[[PathPoint], bool] | None = None,
    after: Solution | None = None,
) -> Trace:
    """Follow the equilibria of ``problem`` from zero load by arc length, stable or not.

    The path ends where the whole load is passed, where ``until`` holds, after ``steps`` steps, or
    where no step succeeds.

    Args:
        problem: body, supports and loads; its loads and prescribed motions belong to the whole
            load, 1.
        pressure: on the pressurised surfaces at the whole load, MPa.
        options: tolerances, and the ``first_step``: a fraction of the load, a tenth by default.
        listener: is called with an ``Event`` after each correction.
        steps: largest number of steps.
        longest_step: upper bound of the nodes' displacement in a step, root mean square, in units
            of the body's diagonal.
        until: condition on a point that ends the path there.
        after: an equilibrium of a stage before, to start from, as for ``solve``.

    Returns:
        The path.

    Raises:
        SolverError: a pressure that is not finite, no steps, or steps of no length.
    """
    if not np.isfinite(pressure):
        raise SolverError(f"pressure must be a finite number of MPa, got {pressure}.")
    if not (0 < longest_step < np.inf and steps >= 1):
        raise SolverError(
            f"trace: longest_step = {longest_step} must be a number above 0 and steps = {steps} "
            "at least 1."
        )
    loading = Loading.of(problem, float(pressure), after)
    newton = Newton(problem, loading, options or SolverOptions(), listener)
    follower = PathFollower.of(newton, longest_step)
    points: list[PathPoint] = []
    states: list[State] = []
    limits: list[Limit] = []
    message = ""
    first = follower.start(loading.start, 0.0, newton.options.first_step or FIRST_STEP)
    for number, (arc, limit) in enumerate(follower.along(first)):
        points.append(limit.point if limit else follower.point(arc))
        states.append(arc.equilibrium.state)
        limits += [limit] if limit else []
        message = _reason_to_end(arc, points[-1], until, number, steps)
        if message:
            break
    message = message or "no further step succeeds."
    return Trace(tuple(points), tuple(states), tuple(limits), message)


def _reason_to_end(
    arc: Arc,
    point: PathPoint,
    until: Callable[[PathPoint], bool] | None,
    number: int,
    steps: int,
) -> str:
    """Why a traced path ends at its point ``number``; empty if it continues."""
    if arc.equilibrium.load >= 1:
        return "the asked load is reached."
    if until is not None and until(point):
        return "it ends where it was asked to."
    return f"it ends after {steps} steps." if number >= steps else ""


def limit_ahead(
    newton: Newton, state: State, load: float, first_step: float, steps: int
) -> Limit | None:
    """The first limit after a state, if it is within so many steps; the first one is of the load.

    Ends without one where the solve's budget is spent.
    """
    follower = PathFollower.of(newton, LONGEST_STEP)
    arcs = follower.along(follower.start(state, load, first_step))
    return next((limit for _, limit in islice(arcs, steps + 1) if limit), None)


@dataclass(frozen=True)
class Arc:
    """An equilibrium, the path's unit ``tangent`` (m,) and the load's ``slope`` (1/mm) along it.

    ``length`` of the next step, ``arrived_by``: length of the step to here, mm.
    """

    equilibrium: EquilibriumPoint
    tangent: Reals
    slope: float
    length: float
    arrived_by: float = 0.0


@dataclass(frozen=True)
class PathFollower:
    """Steps along a path; lengths are root mean squares over the ``measured`` unknowns (m,)."""

    newton: Newton
    measured: NDArray[np.bool_]
    longest: float

    @staticmethod
    def of(newton: Newton, longest_step: float) -> PathFollower:
        """For a problem, with its longest step in body diagonals."""
        numbering = newton.assembly.numbering
        measured = np.ones(numbering.size, bool)
        measured[numbering.pressure] = False
        return PathFollower(newton, measured, longest_step * newton.problem.mesh.size)

    def start(self, state: State, load: float, first_step: float) -> Arc:
        """A state as the start, with a first increment of the load by ``first_step``."""
        return self._arc(equilibrium_point(self.newton, state, load), None, first_step)

    def along(self, arc: Arc) -> Iterator[tuple[Arc, Limit | None]]:
        """The path from ``arc``, with the limits on it; ends where no step succeeds."""
        yield arc, None
        while not arc.equilibrium.failure:
            follows = self._next(arc)
            if follows.equilibrium.failure:
                return
            between = self._limit_between(arc, follows)
            if between is not None:
                yield between
            yield follows, None
            arc = follows

    def point(self, arc: Arc) -> PathPoint:
        """Describe an equilibrium."""
        there = arc.equilibrium
        return self.newton.point(there.state, there.load, there.iterations, there.stable)

    def _next(self, arc: Arc) -> Arc:
        """The next arc; lengths grow where Newton converges fast, and are cut on failure."""
        length = arc.length
        for _ in range(MOST_CUTS):
            follows = self._step(arc, length)
            if not follows.equilibrium.failure:
                break
            self.newton.effort.refused_steps += 1
            length *= self.newton.options.cut
        return follows

    def _step(self, arc: Arc, length: float) -> Arc:
        """One step of a given length; it also fails where the tangent turns sharply."""
        newton, here = self.newton, arc.equilibrium
        load = here.load + arc.slope * length
        direction = newton.system.expanded(arc.tangent)
        moved = newton.kinematics.advanced(here.state, direction, length)
        guess = newton.kinematics.with_motions(moved, load)

        def normal_plane(_s: State, _e: Equilibrium, r: Reals, d: Reals) -> float:
            return -self._product(arc.tangent, r) / self._product(arc.tangent, d)

        found = corrected(newton, guess, load, normal_plane)
        growth = GROWTH if found.iterations <= FEW_ITERATIONS else 1.0
        follows = replace(self._arc(found, arc.tangent, growth * length), arrived_by=length)
        if not found.failure and self._product(follows.tangent, arc.tangent) < SHARPEST_TURN:
            return Arc(
                EquilibriumPoint(found.state, found.load, failure="a sharp turn"), *_NO_TANGENT
            )
        return follows

    def _arc(self, found: EquilibriumPoint, before: Reals | None, length: float) -> Arc:
        """An equilibrium with its tangent, at an acute angle to the tangent ``before``.

        Without that one the load increases, and ``length`` is its step.
        """
        if found.failure or found.direction is None:
            return Arc(found, *_NO_TANGENT)
        speed = float(np.sqrt(self._product(found.direction, found.direction)))
        if before is None:
            length *= speed
        elif self._product(found.direction, before) < 0:
            speed = -speed
        return Arc(found, found.direction / speed, float(1 / speed), min(length, self.longest))

    def _limit_between(self, a: Arc, b: Arc) -> tuple[Arc, Limit] | None:
        """The limit between two successive arcs, if there is one."""
        if a.slope * b.slope < 0:
            turn = self._extremum_between(a, b)
            kind: Literal["maximum", "minimum"] = "maximum" if a.slope > 0 else "minimum"
            return turn, Limit(kind, self.point(turn))
        if a.equilibrium.unstable_modes != b.equilibrium.unstable_modes:
            change = self._bifurcation_between(a, b)
            return change, Limit("bifurcation", self.point(change))
        return None

    def _bifurcation_between(self, a: Arc, b: Arc) -> Arc:
        """The first arc found with another number of unstable modes than ``a``, by bisection."""
        low, high, found = 0.0, b.arrived_by, b
        for _ in range(HALVINGS):
            middle = self._step(a, (low + high) / 2)
            if middle.equilibrium.unstable_modes == a.equilibrium.unstable_modes:
                low = (low + high) / 2
            elif not middle.equilibrium.failure:
                high, found = (low + high) / 2, middle
        return found

    def _extremum_between(self, a: Arc, b: Arc) -> Arc:
        """The arc between two others where the slope of the load vanishes, by bracketed secants."""
        (low, rising), (high, falling), best = (0.0, a.slope), (b.arrived_by, b.slope), b
        for _ in range(MOST_SECANTS):
            share = rising / (rising - falling)
            length = low + min(max(share, 0.05), 0.95) * (high - low)
            tried = self._step(a, length)
            if tried.equilibrium.failure:
                break
            best = tried if abs(tried.slope) < abs(best.slope) else best
            if abs(tried.slope) < FLAT * abs(a.slope):
                break
            if tried.slope * a.slope > 0:
                low, rising = length, tried.slope
            else:
                high, falling = length, tried.slope
        return best

    def _product(self, a: Reals, b: Reals) -> float:
        return float(a[self.measured] @ b[self.measured]) / np.count_nonzero(self.measured)


MOST_CUTS = 8
MOST_SECANTS = 8
HALVINGS = 6
FLAT = 1e-3
"""Ratio of slopes below which the smaller one is that of a limit point."""
FEW_ITERATIONS = 4
GROWTH = 1.5
SHARPEST_TURN = 0.7
"""Least cosine between the tangents at both ends of a step."""

_NO_TANGENT = (np.zeros(0), 0.0, 0.0)
