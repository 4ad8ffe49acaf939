"""How far derivatives reach: the change of the load over which a first order holds.

Along the path of equilibria q(s) under s times the load, R(q, s) = 0 gives

    K q' = -R_s,   K q'' = -(R_qq q' q' + 2 R_qs q'),

R being linear in s. As K q' + R_s = 0, the residual after a short step d along q' is d^2 / 2 times
the bracket, to which one evaluation is enough for an estimate. Near
a limit point at s*, q - q* goes as (s* - s)^(1/2), so that |q'| / (2 |q''|) is the distance s* - s
itself; elsewhere it is the change of the load over which the path turns (our own estimate).
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.sensitivity.adjoint import TangentSystem
from solver.sensitivity.unknowns import Direction, moved

LENGTH = 1e-3
"""Longest displacement of the step, in body diagonals."""

SHORT = 0.02
"""Reach, as a fraction of the load, below which a warning says so."""


def reach_of(system: TangentSystem) -> float | None:
    """Change of pressure and dead loads, as a fraction of them; None without any load."""
    assembly, at = system.at.assembly, system.at
    rate = at.pressure * system.equilibrium.force - at.load * assembly.dead_force(at.state)
    if not rate.any():
        return None
    first, _ = system.solve(-rate)
    size = _length(system, first)
    step = LENGTH * assembly.problem.mesh.size / size
    here = system.equilibrium.residual
    bend = 2 * (_residual(system, first, step) - here) / step**2
    second, _ = system.solve(-bend)
    turning = _length(system, second)
    return size / (2 * turning) if turning else None


def warning_of(reach: float | None) -> str:
    """A sentence on a short reach; empty otherwise."""
    if reach is None or reach >= SHORT:
        return ""
    return (
        f"the state is near a limit point or another sharp turn of its path: derivatives hold for "
        f"changes that are worth less than {100 * reach:.2g} % of the load."
    )


def _residual(system: TangentSystem, direction: Reals, step: float) -> Reals:
    """Residual (m,) after a step along the path, to first order."""
    assembly, at = system.at.assembly, system.at
    there = moved(assembly, at.state, step * direction)
    share = 1 + step
    found = assembly.evaluate(there, share * at.pressure, tangent=False, load=at.load)
    residual: Reals = found.residual - step * at.load * assembly.dead_force(there)
    return residual


def _length(system: TangentSystem, vector: Reals) -> float:
    """Longest displacement of a direction of the unknowns, mm."""
    direction = Direction.of(system.at.assembly, system.at.state, vector)
    return float(np.linalg.norm(direction.displacement, axis=1).max())
