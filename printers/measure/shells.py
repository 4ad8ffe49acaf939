"""The connected pieces of a closed surface: bodies of material and voids inside them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats
from printers.measure.surface import Surface

NEGLIGIBLE_VOLUME = 1e-3  # mm³: a cube of 0.1 mm, far below what one line can leave open


@dataclass(frozen=True)
class Shells:
    """Shell number -> enclosed volume in mm³ of the bodies and of the voids (as positive numbers).

    Shells around less than `NEGLIGIBLE_VOLUME` are left out.
    """

    surface: Surface
    bodies: Mapping[int, float]
    voids: Mapping[int, float]

    @property
    def material(self) -> float:
        """Volume of the material in mm³."""
        return sum(self.bodies.values()) - sum(self.voids.values())

    def bounds(self, shell: int) -> Floats:
        """(2, 3) mm: lower and upper corner of the box around a shell."""
        corners = self.surface.corners[self.surface.shell_of_triangle == shell]
        return np.array([corners.min(axis=(0, 1)), corners.max(axis=(0, 1))])

    def middle(self, shell: int) -> Floats:
        """(3,) mm: the middle of that box."""
        return np.asarray(self.bounds(shell).mean(axis=0))


def split_shells(surface: Surface) -> Shells:
    """Sort the shells by the sign of the volume they enclose."""
    volume_parts = np.einsum("ij,ij->i", surface.corners.mean(axis=1), surface.area_vectors) / 3
    volumes = np.bincount(surface.shell_of_triangle, weights=volume_parts)
    return Shells(
        surface,
        {int(k): float(volumes[k]) for k in np.flatnonzero(volumes > NEGLIGIBLE_VOLUME)},
        {int(k): float(-volumes[k]) for k in np.flatnonzero(volumes < -NEGLIGIBLE_VOLUME)},
    )
