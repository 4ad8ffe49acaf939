"""Points spread over a surface, at which thickness and overhangs are measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.surface import Surface


@dataclass(frozen=True)
class Samples:
    """Points spread evenly over a surface, each standing for the same area.

    *Shape:* `points` (k, 3) mm, `normals` (k, 3) outward, `triangle` (k,); `area` in mm² of each.
    """

    points: Floats
    normals: Floats
    triangle: Ints
    area: float

    def chosen(self, which: Flags) -> Samples:
        """The samples picked by (k,) flags."""
        return Samples(self.points[which], self.normals[which], self.triangle[which], self.area)


def sample(surface: Surface, per_square_millimetre: float, bounds: tuple[int, int]) -> Samples:
    """Spread points over the surface by area, without randomness.

    Positions step evenly through the accumulated area and inside the triangles along the
    R2 sequence (M. Roberts, 2018), so that the density does not depend on the triangulation.
    `bounds` are the least and the greatest number of points.
    """
    total = float(surface.areas.sum())
    count = int(np.clip(total * per_square_millimetre, *bounds))
    step = np.arange(count)
    accumulated = np.cumsum(surface.areas)
    triangle = np.searchsorted(accumulated, (step + 0.5) * total / count).clip(
        max=len(surface.triangles) - 1
    )
    points = _points_in(surface.corners[triangle], step)
    return Samples(points, surface.normals[triangle], triangle, total / count)


def _points_in(corners: Floats, step: Ints) -> Floats:
    plastic = 1.324717957244746
    root = np.sqrt((0.5 + step / plastic) % 1)
    across = (0.5 + step / plastic**2) % 1
    weights = np.stack([1 - root, root * (1 - across), root * across], axis=1)
    return np.asarray(np.einsum("ij,ijk->ik", weights, corners))
