"""How much of the sky a place on the surface sees.

From a wall inside a cavity hardly a ray gets out, from a convex face every one does, from the
ground of a groove some.
"""

from __future__ import annotations

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.box_tree import first_hits
from printers.measure.samples import sample
from printers.measure.surface import Surface

RAYS = 48
SAMPLES_PER_SQUARE_MILLIMETRE = 1.0
SAMPLE_BOUNDS = (2_000, 6_000)
LIFT = 1e-4  # mm above the surface, from which rays start
SMOOTH = 0.87  # cosine of 30°: triangles that turn by less are of one face
SPREADING = 200  # steps of neighbours at most over which triangles without a sample are filled


def exposure(surface: Surface) -> Floats:
    """(m,): the share of rays into the half-space above each triangle that leave the part."""
    samples = sample(surface, SAMPLES_PER_SQUARE_MILLIMETRE, SAMPLE_BOUNDS)
    seen = _escaping(surface, samples.points, samples.normals)
    count = np.bincount(samples.triangle, minlength=len(surface.triangles))
    total = np.bincount(samples.triangle, weights=seen, minlength=len(surface.triangles))
    return _filled(surface, total / np.maximum(count, 1), count > 0)


def _escaping(surface: Surface, points: Floats, normals: Floats) -> Floats:
    """(k,): the share of the rays from each point that meet nothing."""
    reach = 1.1 * float(np.linalg.norm(np.ptp(surface.bounds, axis=0)))
    start = points + LIFT * normals
    free = np.zeros(len(points))
    for direction in _directions():
        side = np.einsum("ij,j->i", normals, direction)
        ray = np.where(side > 0, 1.0, -1.0)[:, None] * direction
        free += ~np.isfinite(first_hits(surface.tree, start, start + reach * ray)[0])
    return free / RAYS


def _directions() -> Floats:
    """(RAYS, 3) unit vectors, spread evenly over half of the sphere along a spiral."""
    step = (np.arange(RAYS) + 0.5) / RAYS
    turn = np.pi * (1 + np.sqrt(5)) * np.arange(RAYS)
    beside = np.sqrt(1 - step**2)
    return np.stack([beside * np.cos(turn), beside * np.sin(turn), step], axis=1)


def _filled(surface: Surface, values: Floats, known: Flags) -> Floats:
    """The values, unknown ones from the known ones beside them: on the same face, then on any."""
    first, second, _ = surface.neighbours
    turn = np.einsum("ij,ij->i", surface.normals[first], surface.normals[second])
    for pairs in (np.flatnonzero(turn > SMOOTH), np.arange(len(first))):
        values, known = _spread(values, known, first[pairs], second[pairs])
    return np.where(known, values, 0.5)


def _spread(values: Floats, known: Flags, first: Ints, second: Ints) -> tuple[Floats, Flags]:
    """Values and which are known, after means of neighbours have spread as far as they go."""
    one, other = np.concatenate([first, second]), np.concatenate([second, first])
    for _ in range(SPREADING):
        giving = known[other] & ~known[one]
        if not giving.any():
            break
        count = np.bincount(one[giving], minlength=len(values))
        total = np.bincount(one[giving], weights=values[other[giving]], minlength=len(values))
        values = np.where(count > 0, total / np.maximum(count, 1), values)
        known = known | (count > 0)
    return values, known
