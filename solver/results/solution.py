"""What a solve returns, and how to write it down."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State
from solver.mesh.mesh import Mesh
from solver.problem.problem import Problem


@dataclass(frozen=True)
class PathPoint:
    """One equilibrium on the load path.

    ``pressure`` (MPa), ``rotation`` of the moving plane or else of the surface ``tip`` about y
    (degrees, positive towards -z, past 360; NaN without either), Newton ``iterations`` spent on
    the step, largest nodal von Mises stress (MPa), ``volume`` inside the pressurised surfaces
    (mm^3, see ``enclosed_volume``), the fraction of the whole ``load``, whether it
    is ``stable`` while the load is held (None where the linear solver cannot tell).
    """

    pressure: float
    rotation: float
    iterations: int
    max_von_mises: float
    volume: float
    load: float = 1.0
    stable: bool | None = None


@dataclass(frozen=True)
class Solution:
    """The last good equilibrium of a problem: at the asked pressure exactly if ``converged``.

    ``pressure`` is the applied pressure it belongs to (MPa), ``displacement`` (n, 3) in mm,
    ``hydrostatic_pressure`` (v,) in MPa at ``mesh.vertices``, positive in compression.
    ``message`` says in one sentence how far the load came and why it stopped there.
    ``plane``: tilt (rad) and shift (mm) of the moving plane, zeros without one. ``load``: the
    fraction of the whole load it belongs to. ``limit``: the pressure (MPa; the fraction of the load
    where there is no pressure) of the limit point that ended the way, None if there was none.
    ``refused_steps`` load steps were cut back. ``negative_pivots`` of the last tangent that was
    factorized equals v where the state is stable; None if the linear solver cannot tell.
    """

    problem: Problem
    pressure: float
    displacement: Reals
    hydrostatic_pressure: Reals
    path: tuple[PathPoint, ...]
    converged: bool
    message: str
    newton_iterations: int
    factorizations: int
    load_steps: int
    refused_steps: int
    linear_solver: str
    negative_pivots: int | None
    seconds: float
    plane: tuple[float, float] = (0.0, 0.0)
    load: float = 1.0
    limit: float | None = None

    @property
    def stable(self) -> bool | None:
        """Whether the state is stable while the load is held; None if that is unknown."""
        return self.path[-1].stable

    @property
    def state(self) -> State:
        """Displacement, hydrostatic pressure and moving plane together."""
        return State(self.displacement, self.hydrostatic_pressure, np.array(self.plane))

    @property
    def rotation(self) -> float:
        """Rotation of moving plane or ``tip`` at the end of the path, degrees."""
        return self.path[-1].rotation


def cavity_volume(mesh: Mesh, displacement: Reals, surfaces: tuple[str, ...]) -> float:
    """Volume of the cavity inside ``surfaces`` of the deformed mesh, mm^3.

    For a half model this is the half cavity's volume. See ``enclosed_volume``.
    """
    return enclosed_volume(mesh, displacement, surfaces)
