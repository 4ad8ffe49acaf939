"""Points that pass through what they may not cross, between two states of a path.

A contact presses points that are inside by less than a certain depth; what a step has carried
further, it does not see any more. So two equilibria in sequence are compared.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.kernels.closest_points import Flags

MARGIN = 0.5
"""How far beside a facet, in its barycentric coordinates, points still pass through it: the facet
nearest at either end of the way need not be the one on the way."""


def through_facets(points: tuple[Reals, Reals], facets: tuple[Reals, Reals], deep: float) -> Flags:
    """Which points (p, 3) pass through their facets (p, 3, 3) between two states.

    They end deeper than ``deep`` (mm) behind the facet, and did not begin there.
    """
    places = [_seen_from(*pair) for pair in zip(facets, points, strict=True)]
    (heights, beside), (ends, beyond) = places
    way = np.where(heights > ends, heights - ends, np.inf)
    share = np.clip(heights / way, 0.0, 1.0)[:, None]
    crossed = ((1 - share) * beside + share * beyond).min(axis=1) >= -MARGIN
    passed: Flags = (heights >= -deep) & (ends < -deep) & crossed
    return passed


def past_axis(before: Reals, after: Reals, near: float) -> Flags:
    """Which offsets (..., 3) from an axis turn by more than 90 deg, on a way ``near`` it (mm)."""
    way = after - before
    turned = (before * after).sum(axis=-1) < 0
    squared = np.maximum((way * way).sum(axis=-1), np.finfo(float).tiny)
    share = np.clip(-(before * way).sum(axis=-1) / squared, 0.0, 1.0)
    nearest = np.linalg.norm(before + share[..., None] * way, axis=-1)
    passed: Flags = turned & (nearest < near)
    return passed


def _seen_from(facets: Reals, points: Reals) -> tuple[Reals, Reals]:
    """Heights (p,) of points over their facets, mm, and barycentric coordinates (p, 3) there."""
    one, other = facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0]
    normal, away = np.cross(one, other), points - facets[:, 0]
    squared = (normal * normal).sum(axis=1)
    r = (np.cross(away, other) * normal).sum(axis=1) / squared
    s = (np.cross(one, away) * normal).sum(axis=1) / squared
    heights: Reals = (away * normal).sum(axis=1) / np.sqrt(squared)
    return heights, np.stack([1 - r - s, r, s], axis=1)
