"""Newton's method at one load.

After a correction far from equilibrium the next tangent is formed with extrapolated stress
(`solver.nonlinear.extrapolation`); the residual is unchanged, and so is the solution.
"""

from __future__ import annotations

from dataclasses import InitVar, dataclass, field, replace

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Assembly, Equilibrium
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.errors import SolverError
from solver.linear.interface import SingularMatrix
from solver.nonlinear.attempts import Attempt, Correction, NoCorrection
from solver.nonlinear.budget import Budget
from solver.nonlinear.checkpoint import Checkpoint, Effort
from solver.nonlinear.events import Event, Kind, Listener
from solver.nonlinear.extrapolation import DIFFERENCE, Extrapolation
from solver.nonlinear.kinematics import Kinematics
from solver.nonlinear.linear_system import LinearSystem
from solver.nonlinear.loading import Loading
from solver.nonlinear.options import SolverOptions
from solver.problem.problem import Problem
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import PathPoint
from solver.results.stress import Peak, deviatoric_at_sides, von_mises

EDGE_SHARE = 0.05
"""Upper bound of the loose tolerance, as a fraction of a mean edge."""

IMBALANCE = 1e-3
"""Largest relative residual after a reused factorization; more is the error of a soft mode."""

PRESSURE_SHARE = 100.0
"""Bound of the correction of the hydrostatic pressure, relative to the material's initial shear
modulus and the largest pressure, over that of displacements, in body diagonals. A correction's
strain is its displacement over a length of the mesh: in bellows the ratio is between 2 and 70."""

PRESSURE_ROUNDING = 1e-9
"""Relative corrections of the hydrostatic pressure below this one always count as small."""

DIVERGED = 1.0
"""Corrections of so many body diagonals count as divergence."""


def pressure_bound(tolerance: float) -> float:
    """Bound of a small relative correction of the pressure, for one of displacements."""
    return max(PRESSURE_SHARE * tolerance, PRESSURE_ROUNDING)


@dataclass
class Newton:
    """Newton's method on one problem at fractions (``load``) of a ``loading``.

    Holds what is computed once per mesh, the last factorization, and counts of the effort.
    ``former``: of a problem before, on a mesh that may differ in the positions of its nodes; what
    both have in common is taken over from it, which is then of no use any more.
    """

    problem: Problem
    loading: Loading
    options: SolverOptions
    listener: Listener | None = None
    effort: Effort = field(default_factory=Effort)
    former: InitVar[Newton | None] = None
    assembly: Assembly = field(init=False)
    system: LinearSystem = field(init=False)

    def __post_init__(self, former: Newton | None) -> None:
        if self.loading.pressures[1] and not self.problem.pressurised:
            raise SolverError(
                f"pressure = {self.loading.pressures[1]:g} MPa: the problem has no pressurised "
                "surface."
            )
        mesh = self.problem.mesh
        layout, system = (former.assembly.layout, former.system) if former else (None, None)
        self.assembly = Assembly(self.problem, self.loading.start.displacement, layout)
        if system is not None and self.assembly.layout is not layout:
            system = None
        self.system = LinearSystem(self.assembly, self.options.linear_solver, system)
        self.kinematics = Kinematics.of(self.problem, self.assembly.plane, self.loading)
        self.fading_force = self._fading_force()
        self.extrapolation = Extrapolation.of(self.problem, self.assembly, self.kinematics)
        self.trusted = trusted_nodes(self.problem)
        self.loose_tolerance = min(self.options.loose_tolerance, EDGE_SHARE * mesh.edge / mesh.size)
        # stress left open must not outweigh a soft spring, nor stretch a stiff film
        if self.problem.springs or self.problem.membranes or self.extrapolation.stiffened:
            self.loose_tolerance = min(self.loose_tolerance, self.options.tolerance)
        self.budget = Budget(self.options)

    def exhausted(self) -> str:
        """Which part of the budget is spent, as text; empty while something is left."""
        return self.budget.exhausted(self.effort)

    @property
    def wrinkling(self) -> bool:
        """Whether there are films that may wrinkle."""
        return any(membrane.wrinkles for membrane in self.problem.membranes)

    @property
    def patience(self) -> int:
        """Largest number of iterations at one load, as long as nothing touches."""
        return self.options.maximum_iterations * (1 + self.wrinkling)

    def correct(
        self,
        guess: State,
        load: float,
        tolerance: float,
        onward: bool = False,
        previous: float = 0.0,
    ) -> Attempt:
        """Equilibrium at a fixed load from ``guess``; with contact, if need be in two stages.

        ``onward``: with the direction in which the path continues. Ends without one where the
        solve's budget is spent. ``previous``: the ``distance`` of a correction before, if any.
        """
        attempt = self.iterate(guess, load, tolerance, onward, previous)
        if not attempt.failure or not attempt.touched:
            return attempt
        with self.assembly.contacts.softened():
            soft = self.iterate(guess, load, tolerance)
        return attempt if soft.failure else self.iterate(soft.state, load, tolerance, onward)

    def iterate(
        self,
        guess: State,
        load: float,
        tolerance: float,
        onward: bool = False,
        previous: float = 0.0,
    ) -> Attempt:
        """Newton iterations at a fixed load from ``guess``, until a correction is small.

        Both fields must be: where supports prescribe how a body deforms, displacements are right at
        once while a nonlinear volumetric law still leaves the pressure far off.

        Once corrections decrease fast, the tangent is that of the state itself and its
        factorization is reused; or, if the path continues ``onward``, the iterations end with a
        small correction by such a tangent. With contact the last correction must not exceed the
        contacts' ``depth`` nor change much what rigid bodies exert, and twice as many iterations
        are allowed, for the set of points in contact to converge; so they are with films that may
        wrinkle, for the set of points that are taut.
        """
        state = guess
        reuse = own = touched = False
        iteration = 0
        while iteration < max(self.patience, self.options.maximum_iterations * (1 + touched)):
            if iteration and (reason := self.exhausted()):
                return Attempt(guess, iteration, reason, touched=touched)
            iteration += 1
            own = own if reuse else not state.extrapolated
            try:
                found = self.correction(state, load, self.system if reuse else None, iteration)
            except NoCorrection as reason:
                return Attempt(guess, iteration, str(reason), touched=touched)
            small, touches = self._is_small(found, load, tolerance)
            touched |= touches
            distance = self.distance(found)
            fast = distance < self.options.reuse * previous
            if small and (own or not onward):
                attempt = self._accepted(found, load, iteration, guess, onward)
                if onward or attempt.failure or not reuse or attempt.imbalance <= IMBALANCE:
                    return replace(attempt, touched=touched)
                fast = False
            reuse = fast and own and not onward
            state = found.moved
            if not (small or fast):
                state = self.extrapolation.with_stress(found.state, found.increment, found.moved)
            previous = distance
        failure = f"Newton did not converge in {iteration} iterations"
        return Attempt(guess, iteration, failure, touched=touched)

    def correction(
        self, state: State, load: float, at_hand: LinearSystem | None = None, iteration: int = 0
    ) -> Correction:
        """One correction, with a factorization ``at_hand`` or a new one.

        Raises ``NoCorrection``.
        """
        equilibrium = self.evaluate(state, load, tangent=at_hand is None)
        if not equilibrium.admissible:
            raise NoCorrection("an element would turn inside out")
        try:
            if at_hand is None:
                self.factorize(equilibrium)
            increment = (at_hand or self.system).increment(-equilibrium.residual)
        except SingularMatrix as error:
            raise NoCorrection(f"the tangent is singular ({error})") from error
        size = self.kinematics.longest(state, increment)
        if not size < DIVERGED * self.problem.mesh.size:
            raise NoCorrection("the Newton corrections grew without bound")
        moved = self.kinematics.advanced(state, increment)
        self.effort.iterations += 1
        self.notify("iteration", load, moved, iteration, size)
        pressure_size = self.pressure_size(increment, moved)
        return Correction(state, equilibrium, increment, moved, size, pressure_size)

    def _is_small(self, found: Correction, load: float, tolerance: float) -> tuple[bool, bool]:
        """Whether a correction may be the last one, and whether surfaces touch after it."""
        contacts, share = self.assembly.contacts, self.loading.share(load)
        depth = contacts.depth(found.moved, share, tolerance)
        touches = bool(np.isfinite(depth))
        small = found.size <= min(tolerance * self.problem.mesh.size, depth)
        small = small and found.pressure_size <= pressure_bound(tolerance)
        if small and touches:
            small = contacts.settled(found.state, found.moved, share, tolerance)
        return small, touches

    def distance(self, found: Correction) -> float:
        """Size of a correction in both fields, the larger one, in body diagonals."""
        return max(found.size / self.problem.mesh.size, found.pressure_size / PRESSURE_SHARE)

    def pressure_size(self, increment: State, moved: State) -> float:
        """Largest hydrostatic pressure of an increment, relative to its scale in a state.

        Each region has its own scale: its shear modulus and its largest pressure.
        """
        region, moduli = self.problem.mesh.region_of_vertex, self.problem.distribution.region_moduli
        changes, scales = np.zeros((2, len(moduli)))
        np.maximum.at(changes, region, np.abs(increment.hydrostatic_pressure))
        np.maximum.at(scales, region, np.abs(moved.hydrostatic_pressure))
        return float((changes / (moduli + scales)).max())

    def _accepted(
        self, found: Correction, load: float, iterations: int, guess: State, onward: bool
    ) -> Attempt:
        """The state after a small correction, if it is in stable equilibrium.

        ``onward``: judged by the last tangent, which also gives the direction of the path.
        """
        if not onward:
            return self.verified(found.moved, load, iterations, guess)
        if self.system.stable is False:
            return Attempt(guess, iterations, "the equilibrium would be unstable")
        direction = self.direction(found.state, load, found.equilibrium)
        return Attempt(found.moved, iterations, direction=direction)

    def verified(self, state: State, load: float, iterations: int, guess: State) -> Attempt:
        """Accept a converged state only if it is stable and no element is inverted.

        Stable means that the tangent has one negative pivot for each pressure unknown and no
        more: the equilibrium is a minimum of energy under the constraint of incompressibility. The
        last tangent tells, of a state nearby; at rigid bodies other points may touch there.
        """
        pressed = self.assembly.contacts.against_rigid(state, self.loading.share(load))
        doubtful = self.system.stable is False or pressed
        equilibrium = self.evaluate(state, load, tangent=doubtful)
        if not equilibrium.admissible:
            return Attempt(guess, iterations, "an element would turn inside out")
        if doubtful and not self._stable_at(equilibrium):
            return Attempt(guess, iterations, "the equilibrium would be unstable")
        applied = float(np.linalg.norm(load * self.rate(state, load, equilibrium))) or 1.0
        imbalance = float(np.linalg.norm(equilibrium.residual)) / applied
        return Attempt(state, iterations, imbalance=imbalance)

    def _stable_at(self, equilibrium: Equilibrium) -> bool:
        """Whether a state is stable, if the last tangent, of a state nearby, is not."""
        try:
            self.factorize(equilibrium)
        except SingularMatrix:
            return False
        return self.system.stable is not False

    def evaluate(self, state: State, load: float, tangent: bool = True) -> Equilibrium:
        """Residual and tangent at a state under a fraction of the load."""
        loading, share = self.loading, self.loading.share(load)
        found = self.assembly.evaluate(state, loading.pressure(load), tangent, share)
        if not len(self.fading_force):
            return found
        return replace(found, residual=found.residual - (1 - share) * self.fading_force)

    def remaining_force(self, load: float) -> tuple[Reals, Reals]:
        """What is left of the stage before at a load: nodal forces (n, 3), and on the plane (2,).

        In N, on the plane's tilt in N mm; (0, 3) and zeros if there is none.
        """
        share = 1 - self.loading.share(load)
        if not len(self.fading_force) or share == 0:
            return np.zeros((0, 3)), np.zeros(2)
        forces, _, plane = self.assembly.numbering.expand(share * self.fading_force)
        return forces, plane

    def _fading_force(self) -> Reals:
        """What keeps the start in equilibrium besides this path's loads (m,), N; empty if nothing.

        Dead loads and other pressures of the stage before, reactions of supports that are gone: as
        dead forces they fade as the load grows, and at the whole load nothing is left of them.
        """
        if not len(self.loading.supports_from):
            return np.zeros(0)
        start, pressure = self.loading.start, self.loading.pressures[0]
        return self.assembly.evaluate(start, pressure, tangent=False, load=0.0).residual

    def factorize(self, equilibrium: Equilibrium) -> None:
        """Factorize a tangent and count it. Raises ``SingularMatrix``."""
        self.system.factorize(equilibrium)
        self.effort.factorizations += 1

    def departing(self, state: State, load: float) -> Attempt:
        """An equilibrium with the direction in which the path continues."""
        equilibrium = self.evaluate(state, load)
        self.factorize(equilibrium)
        return Attempt(state, 0, direction=self.direction(state, load, equilibrium))

    def direction(self, state: State, load: float, equilibrium: Equilibrium) -> State:
        """Derivative of the equilibrium with respect to the load, by the last factorization."""
        return self.system.increment(-self.rate(state, load, equilibrium))

    def rate(self, state: State, load: float, equilibrium: Equilibrium) -> Reals:
        """Derivative of the residual (m,) with respect to the load at constant unknowns, N.

        The part of prescribed motions is a difference quotient: only predictors use it.
        """
        loading = self.loading
        fixed_forces = self.assembly.dead_force(state)
        if len(self.fading_force):
            fixed_forces = fixed_forces - self.fading_force
        rate: Reals = loading.pressure_rate * equilibrium.force - loading.share_rate * fixed_forces
        if self.assembly.contacts.move and not loading.constant:
            rate = rate + self.assembly.contacts.rate(state, load)
        if not self.problem.supports.prescribed or loading.constant:
            return rate
        step = DIFFERENCE if load < 0.5 else -DIFFERENCE
        there = self.kinematics.with_supports(state, load + step)
        moved = self.evaluate(there, load, tangent=False)
        return rate + (moved.residual - equilibrium.residual) / step

    def predicted(self, reached: Attempt, load: float, target: float) -> State:
        """The state at ``target`` to first order from one at ``load``, with its supports there."""
        assert reached.direction is not None
        return self.extrapolation.predicted(reached.state, reached.direction, load, target)

    def passed(self, before: State, load: float, after: State, target: float) -> str:
        """Why a state at ``target`` cannot follow one at ``load``: bodies passed; else empty."""
        share = self.loading.share
        return self.assembly.contacts.passed(before, share(load), after, share(target))

    def led_by_bodies(self, load: float, target: float) -> float:
        """Longest way of a rigid body between two fractions of the load, mm."""
        share = self.loading.share
        return self.assembly.contacts.way(share(load), share(target))

    def point(
        self,
        state: State,
        load: float,
        iterations: int,
        stable: bool | None,
        peak: Peak | None = None,
    ) -> PathPoint:
        """Describe an equilibrium; ``peak``: of its stress, where that is known."""
        stress = self._highest_stress(state) if peak is None else peak.value
        return PathPoint(
            pressure=self.loading.pressure(load),
            rotation=self.kinematics.rotation(state),
            iterations=iterations,
            max_von_mises=stress,
            volume=enclosed_volume(self.problem.mesh, state.displacement, self.problem.pressurised),
            load=load,
            stable=stable,
        )

    def _highest_stress(self, state: State) -> float:
        """Largest nodal von Mises stress, MPa."""
        stress = von_mises(deviatoric_at_sides(self.problem, state.displacement))
        return float(stress[self.trusted[self.problem.mesh.sides]].max(initial=0.0))

    def notify(
        self,
        kind: Kind,
        load: float,
        state: State,
        iteration: int,
        correction: float,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        """Call the listener with an event."""
        if self.listener is not None:
            rotation = self.kinematics.rotation(state)
            spent = self.budget.spent(self.effort)
            self.listener(Event(kind, load, rotation, iteration, correction, checkpoint, spent))
