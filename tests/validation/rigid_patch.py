"""The rigid motion of a small piece of a surface: how something moves that is stuck to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver import Solution
from solver.arrays import Integers, Reals


@dataclass(frozen=True)
class RigidMotion:
    """x -> rotation (x - centre) + centre + shift, mm."""

    centre: Reals
    shift: Reals
    rotation: Reals

    def displacement(self, point: Reals) -> Reals:
        """Of a point (3,) that moves along, mm."""
        away = point - self.centre
        return self.rotation @ away - away + self.shift

    @property
    def tilt(self) -> float:
        """Rotation about y, degrees; positive turns +x towards -z."""
        return float(np.degrees(np.arctan2(self.rotation[0, 2], self.rotation[2, 2])))


def motion_of(solution: Solution, surface: str, triangles: Integers | None = None) -> RigidMotion:
    """The rigid motion that is nearest to that of the triangles, in the mean square over them.

    Args:
        solution: an equilibrium.
        surface: name of the surface.
        triangles: those of it that count, (k,) or mask; all if None.
    """
    mesh = solution.problem.mesh
    cells = mesh.triangles(surface)
    cells = cells if triangles is None else cells[triangles]
    nodes, weights = _weighted(mesh.nodes, cells)
    before = mesh.nodes[nodes]
    after = before + solution.displacement[nodes]
    centre, target = (np.average(at, axis=0, weights=weights) for at in (before, after))
    moment = np.einsum("k,ki,kj->ij", weights, after - target, before - centre)
    left, _, right = np.linalg.svd(moment)
    handed = np.diag([1.0, 1.0, np.linalg.det(left @ right)])
    return RigidMotion(centre, target - centre, left @ handed @ right)


def _weighted(positions: Reals, cells: Integers) -> tuple[Integers, Reals]:
    """Nodes and weights that integrate quadratic fields over six-node triangles: the mid-nodes'."""
    a, b, c = (positions[cells[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    nodes, number = np.unique(cells[:, 3:], return_inverse=True)
    weights = np.bincount(number.ravel(), weights=np.repeat(areas / 3, 3))
    return nodes, weights
