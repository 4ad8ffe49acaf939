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
SAME_FACE = float(np.cos(np.radians(1.0)))  # normals this close belong to one plane face
FLATNESS = 0.004  # mm: bend of a face across the probe; a cylinder of 20 mm radius has as much
STEADY_RADIUS = 1.2  # mm: a curved wall must keep its thickness this far around
STEADY_SPREAD = 0.06  # mm: twice the chord error of a facet on either side, with room for rounding


@dataclass(frozen=True)
class Slabs:
    """Opposite faces seen from sample points: equal-length arrays.

    `thickness` (k,) mm along the normal; `middle` (k, 3) mm; `normal` (k, 3) of the starting face;
    `facing` (k,) cosine between the faces, 1 when parallel; `area` in mm² of the starting face
    behind every entry.
    """

    thickness: Floats
    middle: Floats
    normal: Floats
    facing: Floats
    area: float

    def chosen(self, which: Flags) -> Slabs:
        """The entries picked by (k,) flags."""
        return Slabs(
            self.thickness[which],
            self.middle[which],
            self.normal[which],
            self.facing[which],
            self.area,
        )

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


@dataclass(frozen=True)
class Neighbours:
    """Pairs of slabs within `STEADY_RADIUS` of each other on walls that turn by less than 60
    degrees between them: numbers `first` (k,) and `second` (k,) of the slabs, each pair once."""

    first: Ints
    second: Ints


def neighbours_of(slabs: Slabs) -> Neighbours:
    """The pairs of slabs that are parts of one wall."""
    from scipy.spatial import cKDTree

    if not len(slabs.thickness):
        return Neighbours(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))
    found = cKDTree(slabs.middle).query_pairs(STEADY_RADIUS, output_type="ndarray")
    alike = np.einsum("ij,ij->i", slabs.normal[found[:, 0]], slabs.normal[found[:, 1]]) > 0.5
    first, second = found[alike].T
    return Neighbours(first, second)


def steady(slabs: Slabs, pairs: Neighbours) -> Flags:
    """(k,): slabs whose thickness stays the same all around, on flat and curved walls alike."""
    first, second = pairs.first, pairs.second
    uneven = np.abs(slabs.thickness[first] - slabs.thickness[second]) > STEADY_SPREAD
    result = np.ones(len(slabs.thickness), dtype=bool)
    result[first[uneven]] = False
    result[second[uneven]] = False
    return result


def turning(slabs: Slabs, pairs: Neighbours) -> Flags:
    """(k,): slabs on whose opposite sides the wall turns, so that it is curved there.

    A facet of a curved wall looks flat by itself; a flat wall turns on one side at most, where it
    runs into a fillet. Walls that are flat on less than twice `STEADY_RADIUS` count as curved.
    """
    first, second = pairs.first, pairs.second
    turned = np.einsum("ij,ij->i", slabs.normal[first], slabs.normal[second]) < SAME_FACE
    here = np.concatenate([first[turned], second[turned]])
    there = np.concatenate([second[turned], first[turned]])
    step = slabs.middle[there] - slabs.middle[here]
    side = np.zeros_like(slabs.middle)
    np.add.at(side, here, step)
    result = np.zeros(len(slabs.thickness), dtype=bool)
    result[here[np.einsum("ij,ij->i", step, side[here]) < 0]] = True
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
