"""Rigid motions in the plane y = 0, in which an actuator bends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals


@dataclass(frozen=True)
class Motion:
    """A rotation about y through the origin, then a shift.

    ``angle``: rad, positive from z to x as the solver's rotations: it turns +x towards -z. ``x``
    and ``z``: the shift, mm.
    """

    angle: float = 0.0
    x: float = 0.0
    z: float = 0.0

    @staticmethod
    def about(angle: float, centre: Reals) -> Motion:
        """The rotation by ``angle`` (rad) about a point (3,), mm."""
        moved = Motion(angle).applied(centre[None, :])[0]
        return Motion(angle, float(centre[0] - moved[0]), float(centre[2] - moved[2]))

    def applied(self, points: Reals) -> Reals:
        """Points (n, 3), mm, after the motion."""
        x, z, moved = points[:, 0], points[:, 2], points.copy()
        cosine, sine = np.cos(self.angle), np.sin(self.angle)
        moved[:, 0] = cosine * x + sine * z + self.x
        moved[:, 2] = cosine * z - sine * x + self.z
        return moved

    def after(self, first: Motion) -> Motion:
        """This motion after a ``first`` one."""
        origin = self.applied(np.array([[first.x, 0.0, first.z]]))[0]
        return Motion(self.angle + first.angle, float(origin[0]), float(origin[2]))

    @property
    def inverse(self) -> Motion:
        """The motion that undoes this one."""
        back = Motion(-self.angle).applied(np.array([[-self.x, 0.0, -self.z]]))[0]
        return Motion(-self.angle, float(back[0]), float(back[2]))

    @property
    def mirrored(self) -> Motion:
        """What it is to a body that is mirrored at x = 0."""
        return Motion(-self.angle, -self.x, self.z)


def fitted(points: Reals, targets: Reals) -> Motion:
    """The motion that brings points (n, 3) nearest to ``targets`` (n, 3), by least squares."""
    centre, goal = points.mean(axis=0), targets.mean(axis=0)
    (x, _, z), (u, _, w) = (points - centre).T, (targets - goal).T
    angle = float(np.arctan2((z * u - x * w).sum(), (x * u + z * w).sum()))
    turned = Motion(angle).applied(centre[None, :])[0]
    return Motion(angle, float(goal[0] - turned[0]), float(goal[2] - turned[2]))
