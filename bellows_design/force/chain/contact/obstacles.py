"""Rigid objects in the plane of the finger: signed distance and its first two derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from bellows_design.errors import BellowsError
from solver.arrays import Reals


@dataclass(frozen=True)
class Distance:
    """How far k points are outside an object.

    Attributes:
        value: signed distance (k,), mm, negative inside.
        gradient: outward unit normal (k, 2).
        hessian: its derivative (k, 2, 2), 1/mm.
    """

    value: Reals
    gradient: Reals
    hessian: Reals


@dataclass(frozen=True)
class Plane:
    """A wall through ``point`` (x, z in mm), whose ``normal``, of any length, points into the open.

    Raises:
        BellowsError: The normal is zero.
    """

    point: tuple[float, float]
    normal: tuple[float, float]

    def __post_init__(self) -> None:
        if not np.hypot(*self.normal) > 0:
            raise BellowsError("normal = (0, 0) of a plane gives no direction")

    def gap(self, points: Reals) -> Reals:
        """Signed distance of ``points`` (k, 2)."""
        return (points - self.point) @ self._unit

    def distance(self, points: Reals) -> Distance:
        """Of ``points`` (k, 2), with derivatives."""
        gradient = np.broadcast_to(self._unit, points.shape)
        return Distance(self.gap(points), gradient, np.zeros((len(points), 2, 2)))

    @property
    def _unit(self) -> Reals:
        """The normal of length one."""
        return np.array(self.normal) / np.hypot(*self.normal)


@dataclass(frozen=True)
class Disc:
    """A cylinder across the finger, or a sphere in its plane of symmetry: ``radius`` in mm.

    Raises:
        BellowsError: The radius is not positive.
    """

    centre: tuple[float, float]
    radius: float

    def __post_init__(self) -> None:
        if not self.radius > 0:
            raise BellowsError(f"radius = {self.radius:g} mm of a disc must be positive")

    def gap(self, points: Reals) -> Reals:
        """Signed distance of ``points`` (k, 2)."""
        arms = points - self.centre
        return np.hypot(arms[:, 0], arms[:, 1]) - self.radius

    def distance(self, points: Reals) -> Distance:
        """Of ``points`` (k, 2), with derivatives."""
        return _round_distance(points - self.centre, self.radius)


@dataclass(frozen=True)
class RoundedBox:
    """A box of ``half_sizes`` along x and z, rounded at its corners, turned about its centre.

    Lengths in mm; ``angle`` in rad, from +x towards -z. The corner's radius must be positive, as
    the surface has no normal at a sharp one.

    Raises:
        BellowsError: The corner's radius is not positive, or does not fit.
    """

    centre: tuple[float, float]
    half_sizes: tuple[float, float]
    corner_radius: float
    angle: float = 0.0

    def __post_init__(self) -> None:
        if not 0 < self.corner_radius <= min(self.half_sizes):
            raise BellowsError(
                f"corner_radius = {self.corner_radius:g} mm of a box must be positive and at most "
                f"half of its smaller side, {min(self.half_sizes):g} mm"
            )

    def gap(self, points: Reals) -> Reals:
        """Signed distance of ``points`` (k, 2)."""
        beyond = self._beyond((points - self.centre) @ self._axes.T)
        outside = np.maximum(beyond, 0.0)
        inside = np.minimum(beyond.max(axis=1), 0.0)
        return np.hypot(outside[:, 0], outside[:, 1]) + inside - self.corner_radius

    def distance(self, points: Reals) -> Distance:
        """Of ``points`` (k, 2), with derivatives."""
        axes = self._axes
        local = (points - self.centre) @ axes.T
        signs = np.where(local < 0, -1.0, 1.0)
        beyond = self._beyond(local)
        corner = _round_distance(np.maximum(beyond, 0.0), self.corner_radius)
        at_corner = beyond.min(axis=1) > 0
        nearest = beyond.argmax(axis=1)
        flat = np.eye(2)[nearest]
        value = np.where(at_corner, corner.value, beyond.max(axis=1) - self.corner_radius)
        gradient = np.where(at_corner[:, None], corner.gradient, flat) * signs
        hessian = np.where(at_corner[:, None, None], corner.hessian, 0.0)
        hessian = hessian * signs[:, :, None] * signs[:, None]
        return Distance(value, gradient @ axes, axes.T @ hessian @ axes)

    @property
    def _axes(self) -> Reals:
        """Directions of the box's sides, as rows."""
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return np.array([[cos, -sin], [sin, cos]])

    def _beyond(self, local: Reals) -> Reals:
        """How far points in the box's axes are beyond the centres of its corners."""
        return np.abs(local) - (np.array(self.half_sizes) - self.corner_radius)


Obstacle: TypeAlias = Plane | Disc | RoundedBox


def _round_distance(arms: Reals, radius: float) -> Distance:
    """Distance from a circle of points at ``arms`` (k, 2) from its centre."""
    reach = np.maximum(np.hypot(arms[:, 0], arms[:, 1]), 1e-12)
    gradient = arms / reach[:, None]
    across = np.eye(2) - gradient[:, :, None] * gradient[:, None]
    return Distance(reach - radius, gradient, across / reach[:, None, None])
