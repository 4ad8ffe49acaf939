"""Slabs: places where two faces of a part lie opposite each other, with material or air between.

A wall is a slab of material, a gap a slab of air. Rays start from points spread evenly over the
surface, so every measured thickness carries the area it was found on and no result depends on how
the faces are cut into triangles.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.box_tree import first_hits
from printers.measure.samples import Samples
from printers.measure.surface import Surface

Filling = Literal["material", "air"]

OFF_THE_SURFACE = 1e-6  # mm
PARALLEL = float(np.cos(np.radians(8.0)))  # a taper this slight is a wall of varying thickness
FLATNESS = 0.004  # mm: bend of a face across the probe; a cylinder of 20 mm radius has as much
STEADY_RADIUS = 1.2  # mm: a curved wall must keep its thickness this far around
STEADY_SPREAD = 0.06  # mm: twice the chord error of a facet on either side, with room for rounding


@dataclass(frozen=True)
class Slabs:
    """Opposite faces seen from sample points: equal-length arrays.

    `thickness` (k,) mm along the normal; `middle` (k, 3) mm; `normal` (k, 3) of the starting face;
    `facing` (k,) cosine between the faces, 1 when parallel; `area` in mm² of the starting face
    behind every entry, and its `triangle` (k,).
    """

    thickness: Floats
    middle: Floats
    normal: Floats
    facing: Floats
    triangle: Ints
    area: float

    def chosen(self, which: Flags) -> Slabs:
        """The entries picked by (k,) flags."""
        return Slabs(
            self.thickness[which],
            self.middle[which],
            self.normal[which],
            self.facing[which],
            self.triangle[which],
            self.area,
        )

    @property
    def far(self) -> Floats:
        """(k, 3) mm: the other end of every slab of material."""
        return self.middle - self.thickness[:, None] / 2 * self.normal

    @property
    def parallel(self) -> Flags:
        """(k,): faces within 8 degrees of parallel."""
        return np.asarray(self.facing >= PARALLEL)

    @property
    def vertical(self) -> Flags:
        """(k,): standing walls, whose normal lies within 45 degrees of the horizontal."""
        return np.asarray(np.abs(self.normal[:, 2]) <= np.sqrt(0.5))


def measure_slabs(surface: Surface, samples: Samples, filling: Filling, reach: float) -> Slabs:
    """Thickness of material or air over all samples, up to `reach` mm; thicker places drop out."""
    side = -1.0 if filling == "material" else 1.0
    direction = side * samples.normals
    start = samples.points + OFF_THE_SURFACE * direction
    thickness, triangle = first_hits(
        surface.tree, start, start + reach * direction, samples.triangle
    )
    # The ray leaves material through a face that looks along it, and air through one against it.
    facing = -side * np.einsum("ij,ij->i", surface.normals[triangle], direction)
    hit = np.isfinite(thickness)
    found = Slabs(
        thickness,
        samples.points + np.where(hit, thickness, 0.0)[:, None] / 2 * direction,
        samples.normals,
        facing,
        samples.triangle,
        samples.area,
    )
    return found.chosen(hit)


def flat(surface: Surface, slabs: Slabs, radius: float) -> Flags:
    """(k,): slabs whose two faces are plane within `radius` mm around the ray.

    From the middle of the slab, moved sideways by the radius, both faces must appear where the
    straight continuation of the faces puts them: the mean of two opposite probes equals half the
    thickness. This holds for tapered walls as well as for parallel ones.
    """
    plane = np.ones(len(slabs.thickness), dtype=bool)
    for sideways in _tangents(slabs.normal):
        for across in (1.0, -1.0):
            ahead = _probe(surface, slabs, radius * sideways, across * slabs.normal)
            back = _probe(surface, slabs, -radius * sideways, across * slabs.normal)
            plane &= np.abs((ahead + back - slabs.thickness) / 2) <= FLATNESS
    return plane


def steady(slabs: Slabs) -> Flags:
    """(k,): slabs whose thickness stays the same all around, on flat and curved walls alike."""
    from scipy.spatial import cKDTree

    if not len(slabs.thickness):
        return np.zeros(0, dtype=bool)
    found = cKDTree(slabs.middle).query_pairs(STEADY_RADIUS, output_type="ndarray")
    alike = np.einsum("ij,ij->i", slabs.normal[found[:, 0]], slabs.normal[found[:, 1]]) > 0.5
    first, second = found[alike].T
    uneven = np.abs(slabs.thickness[first] - slabs.thickness[second]) > STEADY_SPREAD
    result = np.ones(len(slabs.thickness), dtype=bool)
    result[first[uneven]] = False
    result[second[uneven]] = False
    return result


def _probe(surface: Surface, slabs: Slabs, sideways: Floats, direction: Floats) -> Floats:
    start = slabs.middle + sideways
    reach = slabs.thickness[:, None] / 2 + 0.5
    return first_hits(surface.tree, start, start + reach * direction)[0]


def _tangents(normal: Floats) -> tuple[Floats, Floats]:
    helper = np.eye(3)[np.abs(normal).argmin(axis=1)]
    first = np.cross(helper, normal)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return first, np.cross(normal, first)
