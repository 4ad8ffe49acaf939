"""The unknown fields of a body at one load."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from solver.arrays import Reals
from solver.problem.problem import Problem


@dataclass(frozen=True)
class State:
    """Displacement (n, 3), mm, and hydrostatic pressure (v,), MPa, positive in compression.

    ``plane``: tilt (rad) and shift (mm) of the moving plane, zeros without one. Increments have
    the same form; on a moving plane the z of their displacement is the change of height in it.
    ``geometric_stress`` (e, q, 6): second Piola-Kirchhoff stress at the integration points that the
    geometric part of the tangent is formed with, MPa (see ``Newton``), and ``membrane_strain``
    (t, m) the strain that does so in membranes, mm^2 (``Membranes.strains``); if empty, those of
    the displacement.
    """

    displacement: Reals
    hydrostatic_pressure: Reals
    plane: Reals = field(default_factory=lambda: np.zeros(2))
    geometric_stress: Reals = field(default_factory=lambda: np.zeros((0, 0, 6)))
    membrane_strain: Reals = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def extrapolated(self) -> bool:
        """Whether the tangent is formed with other stresses than those of the displacement."""
        return len(self.geometric_stress) > 0 or len(self.membrane_strain) > 0

    @staticmethod
    def zero(problem: Problem) -> State:
        """The undeformed, unstressed body."""
        mesh = problem.mesh
        return State(np.zeros(mesh.nodes.shape), np.zeros(len(mesh.vertices)))

    def scaled(self, factor: float) -> State:
        """A multiple of an increment."""
        return State(
            factor * self.displacement, factor * self.hydrostatic_pressure, factor * self.plane
        )
