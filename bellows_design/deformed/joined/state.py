"""Bodies under load, as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from solver import Solution


@dataclass(frozen=True)
class BodyState:
    """A mesh under load.

    ``nodes`` (n, 3): undeformed, mm; ``displacement`` (n, 3), mm; ``von_mises`` (n,), MPa;
    ``tilt`` (rad) and ``shift`` (mm) of its moving plane, ``turn`` (rad) of its tip, if it has one.
    """

    nodes: Reals
    displacement: Reals
    von_mises: Reals
    tilt: float = 0.0
    shift: float = 0.0
    turn: float = 0.0

    @property
    def moved(self) -> Reals:
        """The deformed nodes (n, 3), mm."""
        return self.nodes + self.displacement

    @staticmethod
    def of(solution: Solution) -> BodyState:
        """At the end of a path."""
        from solver import nodal_von_mises

        tilt, shift = solution.plane
        turn = 0.0 if np.isnan(solution.rotation) else float(np.radians(solution.rotation))
        mesh = solution.problem.mesh
        stress = nodal_von_mises(solution)
        return BodyState(mesh.nodes, solution.displacement, stress, tilt, shift, turn)

    @staticmethod
    def at_rest(mesh: Mesh) -> BodyState:
        """Without load."""
        return BodyState(mesh.nodes, np.zeros_like(mesh.nodes), np.zeros(len(mesh.nodes)))


@dataclass(frozen=True)
class ActuatorState:
    """An actuator under load, by what was solved.

    ``body``: the cell, or half of the actuator, or all of it. ``ends``: of a cell, else None.
    ``angle``: rotation of the tip against the root, rad.
    """

    body: BodyState
    ends: BodyState | None
    angle: float
