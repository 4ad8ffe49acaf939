"""The nonlinear solver: adaptive load steps, tangent predictor, Newton, finite motions."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from solver.arrays import Reals
from solver.assembly import Assembly, State
from solver.linear import LinearSolver, SingularMatrix, linear_solver
from solver.models import Problem
from solver.motion import motion_along, rotation
from solver.results import PathPoint, Solution
from solver.stress import deviatoric_at_nodes, von_mises


@dataclass(frozen=True)
class SolverOptions:
    """How the load is walked.

    Steps are fractions of the asked pressure. A load counts as reached when the last Newton
    correction moved no node by more than ``tolerance``, in units of the body's diagonal; what is
    left after that correction is far smaller. Below the asked pressure ``loose_tolerance`` will
    do, if the correction was smaller than the one before.
    """

    first_step: float = 0.1
    growth: float = 2.0
    cut: float = 0.35
    smallest_step: float = 1e-3
    maximum_iterations: int = 12
    tolerance: float = 1e-5
    loose_tolerance: float = 5e-3
    linear_solver: str = "auto"

    def __post_init__(self) -> None:
        for name, low, high in OPTION_BOUNDS:
            value = getattr(self, name)
            if not low < value <= high:
                raise ValueError(
                    f"solver: {name} must be above {low} and at most {high}, got {value}."
                )


OPTION_BOUNDS = (
    ("first_step", 0, 1),
    ("growth", 1, 10),
    ("cut", 0, 0.9),
    ("smallest_step", 0, 1),
    ("maximum_iterations", 0, 1000),
    ("tolerance", 0, 0.1),
    ("loose_tolerance", 0, 0.1),
)


@dataclass(frozen=True)
class Event:
    """Progress of a solve, for a listener.

    ``kind``: ``iteration`` after each correction, ``step`` after each load step reached,
    ``refused`` after each load step given up. ``load`` is the fraction of the asked pressure
    being tried, ``rotation`` (degrees) that of the ``tip`` so far, ``correction`` (mm) the largest
    node's.
    """

    kind: Literal["iteration", "step", "refused"]
    load: float
    rotation: float
    iteration: int
    correction: float


Listener = Callable[[Event], None]

DIVERGED = 1.0
"""A correction of so many body diagonals corrects nothing."""


def solve(
    problem: Problem,
    pressure: float,
    options: SolverOptions | None = None,
    listener: Listener | None = None,
    initial: tuple[Reals, Reals] | None = None,
) -> Solution:
    """Equilibrium of ``problem`` under ``pressure`` (MPa), walked from zero load.

    With ``initial`` = (displacement (n, 3), hydrostatic pressure (v,)), for instance from
    ``solver.interpolation``, Newton starts there at full load; should that fail, the load is walked
    as usual. A load that cannot be reached gives the last good state with ``converged`` False
    and a ``message``, never a diverged state. Raises ``ValueError`` for bad input.
    """
    if not np.isfinite(pressure):
        raise ValueError(f"pressure must be a finite number of MPa, got {pressure}.")
    start = time.perf_counter()
    newton = Newton(problem, float(pressure), options or SolverOptions(), listener)
    walk = None if initial is None else _jump(newton, _start(newton, *initial))
    if walk is None:
        walk = _walk(newton)
    return _solution(newton, walk, time.perf_counter() - start)


@dataclass(frozen=True)
class Attempt:
    """Newton's outcome at one load: a state in equilibrium, or why there is none."""

    state: State
    iterations: int
    failure: str = ""


@dataclass(frozen=True)
class Walk:
    """How far the load came: the last good ``state``, the ``path`` to it, why it stopped."""

    state: State
    path: tuple[PathPoint, ...]
    failure: str = ""


@dataclass
class Effort:
    """Running counts of a solve."""

    iterations: int = 0
    factorizations: int = 0
    load_steps: int = 0
    refused_steps: int = 0


@dataclass
class Newton:
    """Newton's method on one problem at fractions (``load``) of one ``pressure``.

    Holds what is computed once per mesh and the factorization at hand.
    """

    problem: Problem
    pressure: float
    options: SolverOptions
    listener: Listener | None = None
    effort: Effort = field(default_factory=Effort)

    def __post_init__(self) -> None:
        self.assembly = Assembly(self.problem)
        self.linear: LinearSolver = linear_solver(self.options.linear_solver)
        self.linear.analyze(self.assembly.pattern)
        self.move = motion_along(self.problem.mesh, self.problem.axis)

    def correct(self, guess: State, load: float, tolerance: float) -> Attempt:
        """Newton iterations at a fixed load from ``guess``, until a correction is small.

        The first correction after a predictor may be small by chance, with large ones to follow:
        a ``tolerance`` looser than the options' counts only while corrections shrink. The
        factorization left behind is the last iteration's.
        """
        state, previous, size = guess, 0.0, self.problem.mesh.size
        for iteration in range(1, self.options.maximum_iterations + 1):
            equilibrium = self.assembly.evaluate(state, load * self.pressure)
            if not equilibrium.admissible:
                return Attempt(guess, iteration, "an element would turn inside out")
            try:
                self.factorize(equilibrium.tangent)
            except SingularMatrix as error:
                return Attempt(guess, iteration, f"the tangent is singular ({error})")
            increment = self.solve(-equilibrium.residual)
            correction = float(np.abs(increment.displacement).max())
            if not correction < DIVERGED * size:
                return Attempt(guess, iteration, "the Newton corrections grew without bound")
            state = self.advance(state, increment)
            self.effort.iterations += 1
            self.notify("iteration", load, state, iteration, correction)
            contracting = correction < previous
            if correction <= (tolerance if contracting else self.options.tolerance) * size:
                return self.verified(state, load, iteration, guess)
            previous = correction
        return Attempt(guess, iteration, f"Newton did not converge in {iteration} iterations")

    def verified(self, state: State, load: float, iterations: int, guess: State) -> Attempt:
        """Accept a converged state only if no element of it is turned inside out."""
        if self.assembly.evaluate(state, load * self.pressure, tangent=False).admissible:
            return Attempt(state, iterations)
        return Attempt(guess, iterations, "an element would turn inside out")

    def direction(self, state: State, load: float) -> State:
        """Derivative of the equilibrium with respect to the load, by the factorization at hand."""
        force = self.assembly.evaluate(state, load * self.pressure, tangent=False).force
        return self.solve(-self.pressure * force)

    def factorize(self, tangent: Reals) -> None:
        """Factorize a tangent and count it."""
        self.linear.factorize(tangent)
        self.effort.factorizations += 1

    def solve(self, right_hand_side: Reals) -> State:
        """Solve with the factorization at hand."""
        return State(*self.assembly.numbering.expand(self.linear.solve(right_hand_side)))

    def advance(self, state: State, increment: State, fraction: float = 1.0) -> State:
        """The state after a fraction of an increment, applied as a finite motion."""
        return self.supported(
            self.move(state.displacement, fraction * increment.displacement),
            state.hydrostatic_pressure + fraction * increment.hydrostatic_pressure,
        )

    def supported(self, displacement: Reals, pressure: Reals) -> State:
        """A state with the prescribed displacements put back to zero."""
        free = self.assembly.numbering.displacement >= 0
        return State(np.where(free, displacement, 0.0), pressure)

    def point(self, state: State, load: float, iterations: int) -> PathPoint:
        """Describe an equilibrium."""
        stress = von_mises(deviatoric_at_nodes(self.problem, state.displacement))
        turned = rotation(self.problem.mesh, state.displacement)
        return PathPoint(load * self.pressure, turned, iterations, float(stress.max(initial=0.0)))

    def notify(
        self,
        kind: Literal["iteration", "step", "refused"],
        load: float,
        state: State,
        iteration: int,
        correction: float,
    ) -> None:
        """Tell the listener."""
        if self.listener is not None:
            turned = rotation(self.problem.mesh, state.displacement)
            self.listener(Event(kind, load, turned, iteration, correction))


def _jump(newton: Newton, initial: State) -> Walk | None:
    """Newton at full load from a given state; None if that fails."""
    attempt = newton.correct(initial, 1.0, newton.options.tolerance)
    if attempt.failure:
        newton.effort.refused_steps += 1
        newton.notify("refused", 1.0, initial, attempt.iterations, np.inf)
        return None
    newton.effort.load_steps += 1
    origin = newton.point(State.zero(newton.problem), 0.0, 0)
    return Walk(attempt.state, (origin, newton.point(attempt.state, 1.0, attempt.iterations)))


def _walk(newton: Newton) -> Walk:
    """Adaptive load steps from zero: predict along the tangent, correct, grow or cut the step."""
    options = newton.options
    state, load, step = State.zero(newton.problem), 0.0, options.first_step
    path: tuple[PathPoint, ...] = (newton.point(state, load, 0),)
    newton.factorize(newton.assembly.evaluate(state, 0.0).tangent)
    direction = newton.direction(state, load)
    while load < 1.0:
        target = min(load + step, 1.0)
        guess = newton.advance(state, direction, target - load)
        tolerance = options.tolerance if target == 1.0 else options.loose_tolerance
        attempt = newton.correct(guess, target, tolerance)
        if attempt.failure:
            newton.effort.refused_steps += 1
            newton.notify("refused", target, state, attempt.iterations, np.inf)
            step = options.cut * (target - load)
            if step < options.smallest_step:
                return Walk(state, path, attempt.failure)
            continue
        state, load = attempt.state, target
        step *= options.growth
        path += (newton.point(state, load, attempt.iterations),)
        newton.effort.load_steps += 1
        newton.notify("step", load, state, attempt.iterations, 0.0)
        if load < 1.0:
            direction = newton.direction(state, load)
    return Walk(state, path)


def _start(newton: Newton, displacement: Reals, pressure: Reals) -> State:
    """A given state as a start; ``ValueError`` if its shapes do not fit the mesh."""
    expected = State.zero(newton.problem)
    for name, given, wanted in (
        ("displacement", displacement, expected.displacement),
        ("hydrostatic pressure", pressure, expected.hydrostatic_pressure),
    ):
        if np.shape(given) != wanted.shape:
            raise ValueError(
                f"initial: {name} must have the shape {wanted.shape}, got {np.shape(given)}."
            )
    return newton.supported(displacement, pressure)


def _solution(newton: Newton, walk: Walk, seconds: float) -> Solution:
    """Pack up."""
    reached = walk.path[-1].pressure
    share = f"{reached:.4g} of {newton.pressure:.4g} MPa"
    message = f"stopped at {share}: {walk.failure}." if walk.failure else f"reached {share}."
    effort = newton.effort
    return Solution(
        problem=newton.problem,
        pressure=reached,
        displacement=walk.state.displacement,
        hydrostatic_pressure=walk.state.hydrostatic_pressure,
        path=walk.path,
        converged=not walk.failure,
        message=message,
        newton_iterations=effort.iterations,
        factorizations=effort.factorizations,
        load_steps=effort.load_steps,
        refused_steps=effort.refused_steps,
        linear_solver=newton.linear.name,
        negative_pivots=newton.linear.negative_pivots,
        seconds=seconds,
    )
