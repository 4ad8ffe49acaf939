"""Newton's method at one load: options, corrections, increments applied as finite motions.

Far from equilibrium a slender body's own tangent misleads: an increment stretches walls to second
order, the stress of that, which the next correction removes, acts on the body's softest mode like
an axial force on a column, and turns it stiff, loose or unstable. So the geometric part of the
tangent is formed with the stress after the increment to first order, which is in equilibrium with
the loads to first order too: the mixed integration point method (Magisano, Leonetti and Garcea,
CMAME 313, 2017, doi 10.1016/j.cma.2016.10.023). The residual is never changed, so the answer is
not, and near equilibrium both tangents are the same. Half of the paper's Prototype 1 takes 10 to 17
factorizations with it, whatever the load steps, and 11 to 29 without. Cells with a moving plane,
short and thick, gain nothing by it and go without.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Assembly, Equilibrium
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.errors import SolverError
from solver.linear.scaling import factors, scaled
from solver.linear.solvers import SingularMatrix, linear_solver
from solver.nonlinear.checkpoint import Checkpoint
from solver.nonlinear.finite_motion import motion_along, rotation
from solver.problem.problem import Problem
from solver.problem.supports import fixed_displacements, given_displacements
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import PathPoint
from solver.results.stress import deviatoric_at_nodes, von_mises


@dataclass(frozen=True)
class SolverOptions:
    """How the load is walked.

    Steps are fractions of the asked load. Without a ``first_step`` it is a tenth, or along an axis
    as much as would move the body by its own diagonal if it went on as it begins. A load counts as
    reached when the last Newton correction moved no node by more than ``tolerance``, in units of
    the body's diagonal; what is left after that correction is far smaller. Below the asked load
    ``loose_tolerance`` will do, or a twentieth of a mean edge of the mesh if that is less (a
    slender body is stiff against what is small against its length), of a correction by the state's
    own tangent. At the asked load a factorization is used again after a correction that was smaller
    than the one before by the factor ``reuse``; 0 is never.
    """

    first_step: float | None = None
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
            if name == "first_step" and value is None:
                continue
            if value is None or not low < value <= high:
                raise SolverError(
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
    node's. A step reached on the way from zero carries a ``checkpoint`` to go on from.
    """

    kind: Literal["iteration", "step", "refused"]
    load: float
    rotation: float
    iteration: int
    correction: float
    checkpoint: Checkpoint | None = None


Listener = Callable[[Event], None]

FIRST_STEP = 0.1
"""Of the load, where no other is asked for."""

DIFFERENCE = 1e-6
"""Fraction of the load between the two residuals of a difference quotient."""

EDGE_SHARE = 0.05
"""Share of a mean edge by which a state on the way may be off."""

IMBALANCE = 1e-3
"""More than that is left where a factorization used again was blind to a soft mode of the body."""

DIVERGED = 1.0
"""A correction of so many body diagonals corrects nothing."""


@dataclass(frozen=True)
class Attempt:
    """Newton's outcome at one load: a state in equilibrium, or why there is none.

    ``imbalance``: the residual left there, relative to that of the load alone. ``direction``, where
    the walk goes on from there: the equilibrium's derivative with respect to the load.
    """

    state: State
    iterations: int
    failure: str = ""
    imbalance: float = 0.0
    direction: State | None = None


@dataclass
class Effort:
    """Running counts of a solve."""

    iterations: int = 0
    factorizations: int = 0
    load_steps: int = 0
    refused_steps: int = 0


@dataclass
class Newton:
    """Newton's method on one problem at fractions (``load``) of its loads and one ``pressure``.

    Holds what is computed once per mesh and the factorization at hand.
    """

    problem: Problem
    pressure: float
    options: SolverOptions
    listener: Listener | None = None
    effort: Effort = field(default_factory=Effort)

    def __post_init__(self) -> None:
        if self.pressure and not self.problem.pressurised:
            raise SolverError(
                f"pressure = {self.pressure:g} MPa: the problem has no pressurised surface."
            )
        self.assembly = Assembly(self.problem)
        self.scale = factors(self.problem, self.assembly.numbering)
        self.matrix = scaled(linear_solver(self.options.linear_solver), self.scale)
        self.matrix.analyze(self.assembly.pattern)
        self.analyzed = self.assembly.pattern
        self.touched = False
        self.move = motion_along(self.problem.mesh, self.problem.axis)
        self.slender = self.problem.axis is not None and self.assembly.plane is None
        self.trusted = trusted_nodes(self.problem)
        mesh, supports = self.problem.mesh, self.problem.supports
        self.held = fixed_displacements(mesh, supports, self.problem.moving_plane)
        edge = self.problem.mesh.edge / self.problem.mesh.size
        self.loose_tolerance = min(self.options.loose_tolerance, EDGE_SHARE * edge)

    def correct(self, guess: State, load: float, tolerance: float, onward: bool = False) -> Attempt:
        """Equilibrium at a fixed load from ``guess``; where walls touch, at worst in two stages.

        ``onward``: with what a walk needs to go on from there.
        """
        attempt = self.iterate(guess, load, tolerance, onward)
        if not attempt.failure or not self.touched:
            return attempt
        with self.assembly.touches.softened():
            soft = self.iterate(guess, load, tolerance)
        return attempt if soft.failure else self.iterate(soft.state, load, tolerance, onward)

    def iterate(self, guess: State, load: float, tolerance: float, onward: bool = False) -> Attempt:
        """Newton iterations at a fixed load from ``guess``, until a correction is small.

        As soon as corrections shrink fast, the tangent is the state's own and its factorization
        serves again; or, if the walk goes ``onward`` from here, the iterations end with a small
        correction by a state's own tangent. Where walls touch no correction larger than the
        contact's depth will do, and which points touch may take as many iterations again to settle.
        """
        state, previous, reuse, own = guess, 0.0, False, False
        size = self.problem.mesh.size
        self.touched, iteration = False, 0
        while iteration < self.options.maximum_iterations * (2 if self.touched else 1):
            iteration += 1
            equilibrium = self.evaluate(state, load, tangent=not reuse)
            if not equilibrium.admissible:
                return Attempt(guess, iteration, "an element would turn inside out")
            try:
                if not reuse:
                    self.factorize(equilibrium)
                    own = not len(state.geometric_stress)
                increment = self.solve(-equilibrium.residual)
            except SingularMatrix as error:
                return Attempt(guess, iteration, f"the tangent is singular ({error})")
            correction = float(np.abs(self.linear(state, increment)).max())
            if not correction < DIVERGED * size:
                return Attempt(guess, iteration, "the Newton corrections grew without bound")
            moved = self.advance(state, increment)
            self.effort.iterations += 1
            self.notify("iteration", load, moved, iteration, correction)
            depth = self.assembly.touches.depth(moved)
            self.touched |= bool(np.isfinite(depth))
            small = correction <= min(tolerance * size, depth)
            fast = correction < self.options.reuse * previous
            if small and onward and own:
                return self.accepted_onward(state, load, equilibrium, moved, iteration, guess)
            if small and not onward:
                attempt = self.verified(moved, load, iteration, guess)
                if attempt.failure or not reuse or attempt.imbalance <= IMBALANCE:
                    return attempt
                fast = False
            reuse = fast and own and not onward
            state = moved if small or fast else self.extrapolated(state, increment, moved)
            previous = correction
        return Attempt(guess, iteration, f"Newton did not converge in {iteration} iterations")

    def accepted_onward(
        self,
        state: State,
        load: float,
        equilibrium: Equilibrium,
        moved: State,
        iterations: int,
        guess: State,
    ) -> Attempt:
        """Accept ``moved``, with the direction to go on in, by the tangent of ``state`` nearby."""
        if self.stable is False:
            return Attempt(guess, iterations, "the equilibrium would be unstable")
        return Attempt(moved, iterations, direction=self.direction(state, load, equilibrium))

    def direction(self, state: State, load: float, equilibrium: Equilibrium) -> State:
        """Derivative of the equilibrium with respect to the load, by the tangent at hand."""
        return self.solve(-self.rate(state, load, equilibrium))

    def verified(self, state: State, load: float, iterations: int, guess: State) -> Attempt:
        """Accept a converged state only if it is stable and no element is turned inside out.

        Stable means that the tangent has one negative pivot for each pressure unknown and no
        more: the equilibrium is a minimum of energy among all incompressible neighbours.
        """
        equilibrium = self.evaluate(state, load, tangent=self.stable is False)
        if not equilibrium.admissible:
            return Attempt(guess, iterations, "an element would turn inside out")
        if self.stable is False and not self._stable_at(equilibrium):
            return Attempt(guess, iterations, "the equilibrium would be unstable")
        pushed = float(np.linalg.norm(load * self.rate(state, load, equilibrium))) or 1.0
        imbalance = float(np.linalg.norm(equilibrium.residual)) / pushed
        return Attempt(state, iterations, imbalance=imbalance)

    def _stable_at(self, equilibrium: Equilibrium) -> bool:
        """Whether a state is stable, where the last tangent, that of a state nearby, is not."""
        try:
            self.factorize(equilibrium)
        except SingularMatrix:
            return False
        return self.stable is not False

    @property
    def unstable_modes(self) -> int | None:
        """In how many ways the last factorized tangent gives way; None if unknown.

        Negative eigenvalues beyond one for each pressure. Where only their parity is known, a
        wrong one counts as one, and a right one as unknown.
        """
        pressures, negative = len(self.problem.mesh.vertices), self.matrix.negative_pivots
        if negative is not None:
            return abs(negative - pressures)
        odd = self.matrix.odd_negative
        return None if odd is None or odd == (pressures % 2 == 1) else 1

    @property
    def stable(self) -> bool | None:
        """Whether the last factorized tangent is that of a stable state; None if unknown."""
        return None if self.unstable_modes is None else self.unstable_modes == 0

    def evaluate(self, state: State, load: float, tangent: bool = True) -> Equilibrium:
        """Residual and tangent at a state under a fraction of the load."""
        return self.assembly.evaluate(state, load * self.pressure, tangent, load)

    def rate(self, state: State, load: float, equilibrium: Equilibrium) -> Reals:
        """Derivative of the residual (m,) with respect to the load, the unknowns held: N.

        What prescribed motions add comes by a difference quotient: only predictors use it.
        """
        rate: Reals = self.pressure * equilibrium.force - self.assembly.dead_force
        if not self.problem.supports.prescribed:
            return rate
        step = DIFFERENCE if load < 0.5 else -DIFFERENCE
        moved = self.evaluate(self.placed(state, load + step), load, tangent=False)
        return rate + (moved.residual - equilibrium.residual) / step

    def factorize(self, equilibrium: Equilibrium) -> None:
        """Factorize a tangent and count it; contact may have changed its pattern."""
        if equilibrium.pattern is not self.analyzed:
            self.matrix.analyze(equilibrium.pattern)
            self.analyzed = equilibrium.pattern
        self.matrix.factorize(equilibrium.tangent)
        self.effort.factorizations += 1

    def solve(self, right_hand_side: Reals) -> State:
        """Solve with the factorization at hand: an increment of the state."""
        return self.expanded(self.matrix.solve(right_hand_side))

    def expanded(self, vector: Reals) -> State:
        """A vector over the unknowns (m,) as an increment of the state."""
        return State(*self.assembly.numbering.expand(vector))

    def linear(self, state: State, increment: State) -> Reals:
        """Displacement (n, 3) of an increment to first order, mm."""
        plane = self.assembly.plane
        return increment.displacement if plane is None else plane.linear(state, increment)

    def advance(self, state: State, increment: State, fraction: float = 1.0) -> State:
        """The state after a fraction of an increment, applied as a finite motion."""
        step = increment.scaled(fraction)
        moved = self.move(state.displacement, self.linear(state, step))
        kept = State(
            np.where(self.held, state.displacement, moved),
            state.hydrostatic_pressure + step.hydrostatic_pressure,
        )
        plane = self.assembly.plane
        return kept if plane is None else plane.finite(state, step, kept)

    def predicted(self, reached: Attempt, load: float, target: float) -> State:
        """The state at ``target`` to first order from one at ``load``, with supports in place."""
        assert reached.direction is not None
        step = reached.direction.scaled(target - load)
        moved = self.advance(reached.state, step)
        if self.problem.supports.prescribed:  # moves nodes as no step of the unknowns does
            return self.placed(moved, target)
        return self.extrapolated(reached.state, step, moved)

    def extrapolated(self, state: State, increment: State, moved: State) -> State:
        """``moved`` with the stress that an ``increment`` from ``state`` leads to, to first order.

        Without it on a cell with a moving plane (see the module's text).
        """
        if not self.slender:
            return moved
        stress = self.assembly.extrapolated_stress(state, increment)
        return replace(moved, geometric_stress=stress)

    def led(self, state: State, load: float) -> State:
        """A state with what prescribed motions lead put where it is at a fraction of the load."""
        return self.placed(state, load) if self.problem.supports.prescribed else state

    def placed(self, state: State, load: float) -> State:
        """A state with what is held or led put where it is at a fraction of the load."""
        given = self.given(load)
        displacement = np.where(np.isnan(given), state.displacement, given)
        return State(displacement, state.hydrostatic_pressure, state.plane)

    def given(self, load: float) -> Reals:
        """Given displacements (n, 3) at a fraction of the load, NaN where free, mm.

        Raises ``SolverError`` if a prescribed motion lets go of something on its way.
        """
        problem = self.problem
        given = given_displacements(problem.mesh, problem.supports, load, problem.moving_plane)
        if problem.supports.prescribed and (np.isnan(given) == self.held).any():
            raise SolverError(
                f"supports: a prescribed motion is NaN at {100 * load:.4g} % of the load in other "
                "components than at the whole load."
            )
        return given

    def turned(self, state: State) -> float:
        """Rotation of the tip, or of the moving plane, degrees."""
        if self.assembly.plane is not None:
            return float(np.degrees(state.plane[0]))
        return rotation(self.problem.mesh, state.displacement)

    def point(self, state: State, load: float, iterations: int, stable: bool | None) -> PathPoint:
        """Describe an equilibrium."""
        stress = von_mises(deviatoric_at_nodes(self.problem, state.displacement))
        highest = float(stress[self.trusted].max(initial=0.0))
        volume = enclosed_volume(self.problem.mesh, state.displacement, self.problem.pressurised)
        return PathPoint(
            load * self.pressure, self.turned(state), iterations, highest, volume, load, stable
        )

    def notify(
        self,
        kind: Literal["iteration", "step", "refused"],
        load: float,
        state: State,
        iteration: int,
        correction: float,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        """Tell the listener."""
        if self.listener is not None:
            turned = self.turned(state)
            self.listener(Event(kind, load, turned, iteration, correction, checkpoint))
