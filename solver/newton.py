"""Newton's method at one load: options, corrections, increments applied as finite motions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from solver.arrays import Reals
from solver.assembly import Assembly, Equilibrium
from solver.constraints import fixed_displacements
from solver.linear import LinearSolver, SingularMatrix, linear_solver, quick_solver
from solver.models import Problem
from solver.motion import motion_along, rotation
from solver.pressure import enclosed_volume
from solver.results import PathPoint
from solver.sharp_edges import trusted_nodes
from solver.state import State
from solver.stress import deviatoric_at_nodes, von_mises


@dataclass(frozen=True)
class SolverOptions:
    """How the load is walked.

    Steps are fractions of the asked pressure. A load counts as reached when the last Newton
    correction moved no node by more than ``tolerance``, in units of the body's diagonal; what is
    left after that correction is far smaller. Below the asked pressure ``loose_tolerance`` will
    do, if the correction was smaller than the one before. A factorization is used again after a
    correction that was smaller than the one before by the factor ``reuse``; 0 is never.
    """

    first_step: float = 0.1
    growth: float = 2.0
    cut: float = 0.35
    smallest_step: float = 1e-3
    maximum_iterations: int = 12
    tolerance: float = 1e-5
    loose_tolerance: float = 5e-3
    reuse: float = 0.25
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
    ("reuse", -1, 0.9),
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


@dataclass(frozen=True)
class Attempt:
    """Newton's outcome at one load: a state in equilibrium, or why there is none.

    ``force``: the residual's derivative with respect to the pressure there, mm^2.
    """

    state: State
    iterations: int
    failure: str = ""
    force: Reals = field(default_factory=lambda: np.zeros(0))


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
        self.matrix: LinearSolver = quick_solver(self.options.linear_solver)
        self.matrix.analyze(self.assembly.pattern)
        self.analyzed = self.assembly.pattern
        self.touched = False
        self.move = motion_along(self.problem.mesh, self.problem.axis)
        self.trusted = trusted_nodes(self.problem)
        self.held = fixed_displacements(self.problem.mesh, self.problem.supports)

    def correct(self, guess: State, load: float, tolerance: float) -> Attempt:
        """Equilibrium at a fixed load from ``guess``; where walls touch, at worst in two stages."""
        attempt = self.iterate(guess, load, tolerance)
        if not attempt.failure or not self.touched:
            return attempt
        with self.assembly.touches.softened():
            soft = self.iterate(guess, load, tolerance)
        return attempt if soft.failure else self.iterate(soft.state, load, tolerance)

    def iterate(self, guess: State, load: float, tolerance: float) -> Attempt:
        """Newton iterations at a fixed load from ``guess``, until a correction is small.

        A factorization serves as long as corrections shrink fast. The first correction after a
        predictor may be small by chance, with large ones to follow: a ``tolerance`` looser than
        the options' counts only while corrections shrink, and where walls touch none larger than
        the contact's depth will do. Which points touch may take as many iterations again to settle.
        """
        state, previous, size, reuse = guess, 0.0, self.problem.mesh.size, False
        self.touched, iteration = False, 0
        while iteration < self.options.maximum_iterations * (2 if self.touched else 1):
            iteration += 1
            equilibrium = self.assembly.evaluate(state, load * self.pressure, tangent=not reuse)
            if not equilibrium.admissible:
                return Attempt(guess, iteration, "an element would turn inside out")
            try:
                increment = self.increment(equilibrium, reuse)
            except SingularMatrix as error:
                return Attempt(guess, iteration, f"the tangent is singular ({error})")
            correction = float(np.abs(self.linear(state, increment)).max())
            if not correction < DIVERGED * size:
                return Attempt(guess, iteration, "the Newton corrections grew without bound")
            state = self.advance(state, increment)
            self.effort.iterations += 1
            self.notify("iteration", load, state, iteration, correction)
            contracting = correction < previous
            allowed = (tolerance if contracting else self.options.tolerance) * size
            depth = self.assembly.touches.depth(state)
            self.touched |= bool(np.isfinite(depth))
            if correction <= min(allowed, depth):
                return self.verified(state, load, iteration, guess)
            previous, reuse = correction, correction < self.options.reuse * previous
        return Attempt(guess, iteration, f"Newton did not converge in {iteration} iterations")

    def increment(self, equilibrium: Equilibrium, reuse: bool) -> State:
        """Newton's increment, by a new factorization or by the one at hand."""
        if not reuse:
            self.factorize(equilibrium)
        return self.solve(-equilibrium.residual)

    def verified(self, state: State, load: float, iterations: int, guess: State) -> Attempt:
        """Accept a converged state only if it is stable and no element is turned inside out.

        Stable means that the tangent has one negative pivot for each pressure unknown and no
        more: the equilibrium is a minimum of energy among all incompressible neighbours.
        """
        if self.matrix.negative_pivots not in (None, len(self.problem.mesh.vertices)):
            return Attempt(guess, iterations, "the equilibrium would be unstable")
        equilibrium = self.assembly.evaluate(state, load * self.pressure, tangent=False)
        if equilibrium.admissible:
            return Attempt(state, iterations, force=equilibrium.force)
        return Attempt(guess, iterations, "an element would turn inside out")

    def direction(self, force: Reals) -> State:
        """Derivative of the equilibrium with respect to the load, by the factorization at hand.

        ``force``: the residual's derivative with respect to the pressure, mm^2.
        """
        return self.solve(-self.pressure * force)

    def sharpen(self) -> None:
        """Go on in double precision, if single precision was this solver's own choice."""
        if self.options.linear_solver == "auto" and self.matrix.name == "pardiso-single":
            self.matrix = linear_solver("pardiso")
            self.matrix.analyze(self.analyzed)

    def factorize(self, equilibrium: Equilibrium) -> None:
        """Factorize a tangent and count it; contact may have changed its pattern."""
        if equilibrium.pattern is not self.analyzed:
            self.matrix.analyze(equilibrium.pattern)
            self.analyzed = equilibrium.pattern
        self.matrix.factorize(equilibrium.tangent)
        self.effort.factorizations += 1

    def solve(self, right_hand_side: Reals) -> State:
        """Solve with the factorization at hand."""
        return State(*self.assembly.numbering.expand(self.matrix.solve(right_hand_side)))

    def linear(self, state: State, increment: State) -> Reals:
        """Displacement (n, 3) of an increment to first order, mm."""
        plane = self.assembly.plane
        return increment.displacement if plane is None else plane.linear(state, increment)

    def advance(self, state: State, increment: State, fraction: float = 1.0) -> State:
        """The state after a fraction of an increment, applied as a finite motion."""
        step = increment.scaled(fraction)
        moved = self.supported(
            self.move(state.displacement, self.linear(state, step)),
            state.hydrostatic_pressure + step.hydrostatic_pressure,
        )
        plane = self.assembly.plane
        return moved if plane is None else plane.finite(state, step, moved)

    def supported(self, displacement: Reals, pressure: Reals) -> State:
        """A state with the prescribed displacements put back to zero."""
        return State(np.where(self.held, 0.0, displacement), pressure)

    def turned(self, state: State) -> float:
        """Rotation of the tip, or of the moving plane, degrees."""
        if self.assembly.plane is not None:
            return float(np.degrees(state.plane[0]))
        return rotation(self.problem.mesh, state.displacement)

    def point(self, state: State, load: float, iterations: int) -> PathPoint:
        """Describe an equilibrium."""
        stress = von_mises(deviatoric_at_nodes(self.problem, state.displacement))
        highest = float(stress[self.trusted].max(initial=0.0))
        volume = enclosed_volume(self.problem.mesh, state.displacement, self.problem.pressurised)
        return PathPoint(load * self.pressure, self.turned(state), iterations, highest, volume)

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
            self.listener(Event(kind, load, self.turned(state), iteration, correction))
