"""Kinematics of states: increments as finite motions, given displacements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.assembly.moving_plane import MovingPlane
from solver.assembly.state import State
from solver.errors import SolverError
from solver.nonlinear.finite_motion import Motion, motion_along, rotation
from solver.nonlinear.loading import Loading
from solver.problem.problem import Problem
from solver.problem.supports import fixed_displacements, given_displacements


@dataclass(frozen=True)
class Kinematics:
    """Motions of a ``problem`` under a ``loading``, with its moving ``plane``, if it has one.

    ``motion`` applies increments; ``held`` (n, 3): displacements that are given.
    """

    problem: Problem
    plane: MovingPlane | None
    motion: Motion
    loading: Loading
    held: NDArray[np.bool_]

    @staticmethod
    def of(problem: Problem, plane: MovingPlane | None, loading: Loading) -> Kinematics:
        """Of a problem: increments are finite rotations along its axis, or sums without one."""
        motion = motion_along(problem.mesh, problem.axis)
        held = fixed_displacements(problem.mesh, problem.supports, problem.moving_plane)
        return Kinematics(problem, plane, motion, loading, held)

    def linear(self, state: State, increment: State) -> Reals:
        """Displacement (n, 3) of an increment to first order, mm."""
        plane = self.plane
        return increment.displacement if plane is None else plane.linear(state, increment)

    def longest(self, state: State, increment: State) -> float:
        """Largest component of that displacement, mm."""
        return float(np.abs(self.linear(state, increment)).max())

    def advanced(self, state: State, increment: State, fraction: float = 1.0) -> State:
        """The state after a fraction of an increment, applied as a finite motion."""
        step = increment.scaled(fraction)
        moved = self.motion(state.displacement, self.linear(state, step))
        kept = State(
            np.where(self.held, state.displacement, moved),
            state.hydrostatic_pressure + step.hydrostatic_pressure,
        )
        return kept if self.plane is None else self.plane.finite(state, step, kept)

    def start(self, displacement: Reals, pressure: Reals) -> State:
        """A given state as the initial one at the whole load.

        Raises ``SolverError`` if its shapes do not fit the mesh or a number is not finite.
        """
        self.check_shapes(displacement, pressure)
        state = self.with_supports(State(displacement, pressure), 1.0)
        return state if self.plane is None else self.plane.fitted(state)

    def with_motions(self, state: State, load: float) -> State:
        """A state with the prescribed motions of a fraction of the load."""
        return self.with_supports(state, load) if self.problem.supports.prescribed else state

    def with_supports(self, state: State, load: float) -> State:
        """A state with the given displacements of a fraction of the load."""
        given = self.given(load)
        displacement = np.where(np.isnan(given), state.displacement, given)
        return State(displacement, state.hydrostatic_pressure, state.plane)

    def given(self, load: float) -> Reals:
        """Given displacements (n, 3) at a fraction of the load, NaN where free, mm.

        Raises ``SolverError`` if a prescribed motion frees other components than at the whole load.
        """
        problem = self.problem
        share = self.loading.share(load)
        given = given_displacements(problem.mesh, problem.supports, share, problem.moving_plane)
        if problem.supports.prescribed and (np.isnan(given) == self.held).any():
            raise SolverError(
                f"supports: a prescribed motion is NaN at {100 * load:.4g} % of the load in other "
                "components than at the whole load."
            )
        return self.loading.held(given)

    def rotation(self, state: State) -> float:
        """Rotation of the tip, or of the moving plane, degrees."""
        if self.plane is not None:
            return float(np.degrees(state.plane[0]))
        return rotation(self.problem.mesh, state.displacement)

    def check_shapes(self, displacement: Reals, pressure: Reals) -> None:
        """Raise ``SolverError`` unless these are displacements and pressures of the mesh."""
        expected = State.zero(self.problem)
        for name, given, wanted in (
            ("displacement", displacement, expected.displacement),
            ("hydrostatic pressure", pressure, expected.hydrostatic_pressure),
        ):
            if np.shape(given) != wanted.shape:
                raise SolverError(
                    f"initial: {name} must have the shape {wanted.shape}, got {np.shape(given)}."
                )
            if not np.isfinite(given).all():
                raise SolverError(f"initial: {name} must be finite numbers, found NaN or infinity.")
