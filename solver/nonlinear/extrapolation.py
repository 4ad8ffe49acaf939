"""States after an increment, with the stress to first order that the next tangent is formed with.

Far from equilibrium the tangent of a slender body is a poor predictor: an increment stretches walls
to second order, and the stress of that, which the next correction removes, acts on the body's
softest mode like an axial force on a column, which makes that mode too stiff, too soft or unstable.
So the geometric part of the tangent is formed with the stress after the increment to first order,
which is in equilibrium with the loads to first order too: the mixed integration point method
(Magisano, Leonetti and Garcea, CMAME 313, 2017, doi 10.1016/j.cma.2016.10.023). Near equilibrium
both tangents are the same. Half of the paper's Prototype 1 takes 10 to 17 factorizations with it,
whatever the load steps, and 11 to 29 without. It does not help cells with a moving plane, short and
thick, and is not used there. The stress of membranes, which hardly stretch, is always extrapolated:
without that a strip with an inextensible film takes more than ten times as many factorizations, or
stops short of its load. So is that of a body with a region a hundred times as stiff as another one
or more: a beam with a film of a two-hundredth of its height takes 13 factorizations whatever the
ratio of stiffness; without, 21 at 1e4, and at 1e6 it stops short
(``tests/benchmarks/stiffness_ratio.py``). That holds for cells with a moving plane too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from solver.arrays import Reals
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.nonlinear.kinematics import Kinematics
from solver.problem.problem import Problem

DIFFERENCE = 1e-6
"""Fraction of the load between the two ends of a difference quotient."""

STIFFENING = 1e2
"""Ratio of the shear moduli of two materials from which on the stress is extrapolated."""


@dataclass(frozen=True)
class Extrapolation:
    """Extrapolated stress of a ``problem`` in its ``assembly``.

    ``slender``: a body with an axis and without a moving plane; ``stiffened``: with a region far
    stiffer than another one.
    """

    problem: Problem
    assembly: Assembly
    kinematics: Kinematics
    slender: bool
    stiffened: bool

    @staticmethod
    def of(problem: Problem, assembly: Assembly, kinematics: Kinematics) -> Extrapolation:
        """Where stress is extrapolated is decided by the body and its materials."""
        moduli = problem.distribution.moduli
        stiffened = bool(moduli.max() >= STIFFENING * moduli.min())
        slender = problem.axis is not None and assembly.plane is None
        return Extrapolation(problem, assembly, kinematics, slender, stiffened)

    def predicted(self, state: State, direction: State, load: float, target: float) -> State:
        """The state at ``target`` to first order from one at ``load``, with its supports there.

        ``direction``: derivative of the equilibrium with respect to the load.
        """
        step = direction.scaled(target - load)
        moved = self.kinematics.advanced(state, step)
        if self.problem.supports.prescribed:
            return self.led_on(state, load, step, moved, target)
        return self.with_stress(state, step, moved)

    def led_on(
        self, state: State, load: float, increment: State, moved: State, target: float
    ) -> State:
        """``moved`` with its supports and the stress of its films at another load.

        It is the ``state`` at ``load`` after an ``increment`` of the unknowns. What supports lead
        displaces nodes without any, and stretches films too.
        """
        if not self.problem.supports.prescribed:
            return self.with_film_stress(state, increment, moved)
        there = self.kinematics.with_supports(moved, target)
        if self.assembly.films is None and not self.stiffened:
            return there
        displacement = increment.displacement + self._led_by_supports(state, load, target)
        return self.with_film_stress(state, replace(increment, displacement=displacement), there)

    def with_stress(self, state: State, increment: State, moved: State) -> State:
        """``moved`` with the stress after an ``increment`` from ``state``, to first order.

        On a cell with a moving plane only that of films and stiff regions (see the module's text).
        """
        moved = self.with_film_stress(state, increment, moved)
        if not self.slender or self.stiffened:
            return moved
        return replace(moved, geometric_stress=self._stress(state, increment))

    def with_film_stress(self, state: State, increment: State, moved: State) -> State:
        """The same for membranes and stiff regions only; ``moved`` itself without any."""
        films = self.assembly.films
        if films is not None:
            strain = films.extrapolated_strain(state, increment)
            moved = replace(moved, membrane_strain=strain)
        if not self.stiffened:
            return moved
        return replace(moved, geometric_stress=self._stress(state, increment))

    def _led_by_supports(self, state: State, load: float, target: float) -> Reals:
        """What supports lead between two loads to first order, displacements (n, 3)."""
        step = DIFFERENCE if load < 0.5 else -DIFFERENCE
        there = self.kinematics.with_supports(state, load + step)
        led: Reals = (there.displacement - state.displacement) * ((target - load) / step)
        return led

    def _stress(self, state: State, increment: State) -> Reals:
        """Stress (e, q, 6) after an increment to first order, MPa."""
        along = replace(increment, displacement=self.kinematics.linear(state, increment))
        return self.assembly.extrapolated_stress(state, along)
