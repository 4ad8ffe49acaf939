"""How much of the sky a place on the surface sees.

From a wall inside a cavity hardly a ray gets out, from a convex face every one does, from the
ground of a groove some.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.box_tree import first_hits
from printers.measure.samples import Samples, sample
from printers.measure.surface import Surface

RAYS = 48
SAMPLES_PER_SQUARE_MILLIMETRE = 1.0
SAMPLE_BOUNDS = (2_000, 6_000)
CLOSE = 2.0  # mm from a rim, within which more samples tell how the sky changes along a fillet
CLOSE_SAMPLES_PER_SQUARE_MILLIMETRE = 20.0
CLOSE_BOUNDS = (1, 4_000)
LIFT = 1e-4  # mm above the surface, from which rays start
SMOOTH = 0.87  # cosine of 30°: triangles that turn by less are of one face
UNKNOWN = 0.5  # share of the sky of a face on which no sample lies, such as a pin hole's wall


@dataclass(frozen=True, eq=False)
class Sky:
    """What the triangles of a surface see.

    Attributes:
        share: Of the rays into the half-space above each triangle, those that leave the part.
            *Shape:* `(m,)`
        known: Whether a sample lies on the triangle's face; else `share` is `UNKNOWN`.
            *Shape:* `(m,)`
    """

    share: Floats
    known: Flags


@dataclass(frozen=True, eq=False)
class Looks:
    """What was seen from samples: (k,) their triangles, and the share of rays that leave."""

    triangle: Ints
    share: Floats


def look_around(surface: Surface) -> Looks:
    """From samples all over the surface."""
    samples = sample(surface, SAMPLES_PER_SQUARE_MILLIMETRE, SAMPLE_BOUNDS)
    return _looks(surface, np.arange(len(surface.triangles)), samples)


def look_closer(surface: Surface, looks: Looks, points: Floats) -> Looks:
    """The looks, and more from triangles whose middle is `CLOSE` to one of points (k, 3)."""
    from scipy.spatial import cKDTree

    distance = cKDTree(points).query(surface.corners.mean(axis=1), distance_upper_bound=CLOSE)[0]
    close = np.flatnonzero(np.isfinite(distance))
    part = Surface(surface.vertices, surface.triangles[close])
    if not part.areas.sum() > 0:
        return looks
    samples = sample(part, CLOSE_SAMPLES_PER_SQUARE_MILLIMETRE, CLOSE_BOUNDS)
    more = _looks(surface, close, samples)
    return Looks(
        np.concatenate([looks.triangle, more.triangle]), np.concatenate([looks.share, more.share])
    )


def _looks(surface: Surface, sampled: Ints, samples: Samples) -> Looks:
    """From samples of the triangles `sampled` (k,) of the surface."""
    share = _escaping(surface, samples.points, samples.normals)
    return Looks(sampled[samples.triangle], share)


def exposure(surface: Surface, looks: Looks) -> Sky:
    """The sky that each triangle sees; one without a sample sees that of the nearest sample.

    Nearest along the face, so that no value crosses an edge, where what is seen may jump, and that
    the triangulation of a face does not count.
    """
    count = np.bincount(looks.triangle, minlength=len(surface.triangles))
    total = np.bincount(looks.triangle, weights=looks.share, minlength=len(surface.triangles))
    nearest = _nearest_on_face(surface, np.flatnonzero(count))
    known = nearest >= 0
    return Sky(np.where(known, (total / np.maximum(count, 1))[nearest], UNKNOWN), known)


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


def _nearest_on_face(surface: Surface, sampled: Ints) -> Ints:
    """(m,): of the triangles `sampled` (k,) the nearest from middle to middle along the face; -1
    where none is on it."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    first, second, _ = surface.neighbours
    smooth = np.einsum("ij,ij->i", surface.normals[first], surface.normals[second]) > SMOOTH
    first, second, count = first[smooth], second[smooth], len(surface.triangles)
    middle = surface.corners.mean(axis=1)
    steps = np.maximum(np.linalg.norm(middle[first] - middle[second], axis=1), LIFT)
    graph = coo_array((steps, (first, second)), shape=(count, count)).tocsr()
    found = dijkstra(
        graph, directed=False, indices=sampled, min_only=True, return_predecessors=True
    )
    return np.where(np.isfinite(found[0]), found[2], -1)
