"""Loads along a path: pressure, dead loads and motions as functions of the fraction of the load."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Reals
from solver.assembly.state import State
from solver.errors import SolverError
from solver.problem.problem import Problem

if TYPE_CHECKING:
    from solver.results.solution import Solution


@dataclass(frozen=True)
class Loading:
    """From the loads at a ``start`` to those of a problem.

    ``pressures``: at no and at the whole load, MPa. ``constant``: dead loads and motions keep their
    whole size while the pressure varies, else they grow with it. ``supports_from`` (n, 3):
    displacements in mm that supports hold, or lead on, from the start; empty for zero.
    """

    start: State
    pressures: tuple[float, float]
    constant: bool = False
    supports_from: Reals = field(default_factory=lambda: np.zeros((0, 3)))

    @staticmethod
    def of(problem: Problem, pressure: float, after: Solution | None = None) -> Loading:
        """From the undeformed body, or from an equilibrium of another stage, to ``pressure``.

        The pressure of that stage goes on if the same surfaces are under pressure. Raises
        ``SolverError`` if the stage had another mesh.
        """
        if after is None:
            return Loading(State.zero(problem), (0.0, pressure))
        _check_same_mesh(problem, after.problem)
        same = set(problem.pressurised) == set(after.problem.pressurised)
        pressures = (after.pressure if same else 0.0, pressure)
        return Loading(after.state, pressures, supports_from=after.displacement)

    def pressure(self, load: float) -> float:
        """Pressure at a fraction of the load, MPa."""
        return self.pressures[1] if load == 1 else self.pressures[0] + load * self.pressure_rate

    @property
    def pressure_rate(self) -> float:
        """Change of the pressure over the whole load, MPa."""
        return self.pressures[1] - self.pressures[0]

    def share(self, load: float) -> float:
        """Fraction of dead loads and prescribed motions at a fraction of the load."""
        return 1.0 if self.constant else load

    @property
    def share_rate(self) -> float:
        """Derivative of ``share``."""
        return 0.0 if self.constant else 1.0

    def held(self, given: Reals) -> Reals:
        """Given displacements (n, 3) from the start on as ones from the undeformed body, mm."""
        return given + self.supports_from if len(self.supports_from) else given


def _check_same_mesh(problem: Problem, former: Problem) -> None:
    """Raise ``SolverError`` unless two problems have the same mesh, moving plane included.

    Regions too: a node between them has a pressure for each.
    """
    ours, theirs = problem.mesh, former.mesh
    if ours is not theirs:
        if not (
            np.array_equal(ours.nodes, theirs.nodes) and np.array_equal(ours.tets, theirs.tets)
        ):
            raise SolverError("after: a stage goes on from one with the same mesh; it has another.")
        if not np.array_equal(ours.tet_vertices, theirs.tet_vertices):
            raise SolverError(
                "after: a stage goes on from one whose mesh has the same regions; it has others."
            )
    if problem.moving_plane != former.moving_plane:
        raise SolverError(
            f"after: the moving plane is {problem.moving_plane!r}, that of the stage before "
            f"{former.moving_plane!r}; it must be the same."
        )
