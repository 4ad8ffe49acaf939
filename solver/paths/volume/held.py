"""Equilibria at a held volume: steps from one to another, and whether they are stable.

While the volume V is held, the pressure p is an unknown like the others, and the tangent of
Pi - p V is that of constant pressure, K, bordered by the derivative of the volume. By Haynsworth's
formula the bordered matrix has one negative eigenvalue more than K where dV/dp > 0, and as many
where dV/dp < 0; one belongs to the constraint. So the modes that are unstable at a held volume are
those at constant pressure, less one where the pressure falls with the volume.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Equilibrium
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.nonlinear.newton import Newton
from solver.paths.bordering import EquilibriumPoint, corrected


@dataclass(frozen=True)
class HeldVolume:
    """An equilibrium ``found`` at a ``volume`` (mm^3), or why there is none.

    ``compliance``: dV/dp, mm^3/MPa. ``velocity`` (n, 3): derivative of the displacement with
    respect to the volume, 1/mm^2. ``unstable_modes``: their number while the volume is held, None
    where the linear solver cannot tell.
    """

    found: EquilibriumPoint
    volume: float
    compliance: float = np.nan
    velocity: Reals | None = None
    unstable_modes: int | None = None

    @staticmethod
    def of(newton: Newton, found: EquilibriumPoint, volume: float) -> HeldVolume:
        """An equilibrium whose tangent was factorized last."""
        if found.failure or found.direction is None or found.force is None:
            return HeldVolume(found, volume)
        compliance = -float(found.force @ found.direction)
        direction = newton.system.expanded(found.direction)
        velocity = newton.kinematics.linear(found.state, direction) / compliance
        modes = _modes_at_held_volume(newton, found, compliance < 0)
        return HeldVolume(found, volume, compliance, velocity, modes)

    @property
    def failure(self) -> str:
        """Why this is no equilibrium; empty if it is one."""
        return self.found.failure

    @property
    def pressure(self) -> float:
        """MPa."""
        return self.found.load

    @property
    def slope(self) -> float:
        """dp/dV, MPa/mm^3: zero at a limit point of the pressure."""
        return 1 / self.compliance

    @property
    def stable(self) -> bool | None:
        """Whether it is stable while its volume is held; None if unknown."""
        return None if self.unstable_modes is None else self.unstable_modes == 0

    def turn(self, other: HeldVolume) -> float:
        """Angle (rad) between the directions in which the path leaves two equilibria."""
        assert self.velocity is not None and other.velocity is not None
        cosine = np.vdot(self.velocity, other.velocity)
        cosine /= np.linalg.norm(self.velocity) * np.linalg.norm(other.velocity)
        return float(np.arccos(np.clip(cosine, -1.0, 1.0)))


def _modes_at_held_volume(newton: Newton, found: EquilibriumPoint, falling: bool) -> int | None:
    """Unstable modes at a held volume; where only their parity is known, 1 if it is odd."""
    if newton.system.negative_pivots is None:
        odd = (found.unstable_modes == 1) != falling
        return 1 if odd else None
    assert found.unstable_modes is not None
    return found.unstable_modes - falling


def volume_of(newton: Newton, state: State) -> float:
    """Volume inside the pressurised surfaces, mm^3, signed as in ``enclosed_volume``."""
    problem = newton.problem
    return enclosed_volume(problem.mesh, state.displacement, problem.pressurised)


def at_volume(newton: Newton, start: HeldVolume, wanted: float) -> HeldVolume:
    """From an equilibrium to the one with the ``wanted`` volume.

    The volume's derivative is minus ``force``: the residual is that of Pi - p V.
    """
    here = start.found
    assert here.direction is not None
    change = (wanted - start.volume) / start.compliance
    step = newton.system.expanded(change * here.direction)
    moved = newton.kinematics.advanced(here.state, step)
    guess = newton.extrapolation.with_film_stress(here.state, step, moved)

    def row(state: State, equilibrium: Equilibrium, r: Reals, d: Reals) -> float:
        excess = volume_of(newton, state) - wanted
        return (excess - float(equilibrium.force @ r)) / float(equilibrium.force @ d)

    return HeldVolume.of(newton, corrected(newton, guess, here.load + change, row), wanted)
