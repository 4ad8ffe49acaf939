"""The surface parted into what is inside a cavity and what is outside, along the shortest rims.

The minimum cut in the graph of neighbouring triangles, between those that see hardly any sky and
those that see most of it. An edge costs its length, and the more the less sky its triangles see: so
a cut runs around a mouth where it opens to the outside, not around a narrower place farther in.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from printers.arrays import Flags, Floats, Ints
from printers.measure.leakage.minimum_cut import DRAIN, SOURCE, source_side
from printers.measure.surface import Surface, label
from printers.openings.exposure import Sky, exposure, look_around, look_closer
from printers.tolerances import ROUNDING

DARK = (0.05, 0.15, 0.3)
"""Shares of the sky below which a triangle is taken as inside: the next where the one before finds
no cavity. Walls of chambers see less than the first, the ground of a groove of 1.2 mm, 8 mm deep,
0.1, the middle of a tube that is open at both ends, five diameters long, less than the second."""

BRIGHT = 0.75
"""Share of the sky above which a triangle is outside for certain."""

DEEP = 4.0
"""Least ratio of a cavity's wall to the circle with a circumference as long as its rims. A dent
like half a ball has 2, a slit at most 3, whatever its depth, a tube of one diameter 5."""

DARKEST = 0.1  # share of the sky added to every edge's: no edge costs more than ten times another
LARGEST_FLOW = 2**30  # the maximum flow counts in whole numbers of 32 bits


@dataclass(frozen=True)
class Cavity:
    """Inner surface behind its rims.

    Attributes:
        triangles: Which belong to its wall.
            *Shape:* `(m,)`
        volume: Of the air behind its rims, mm³.
        rims: Of each mouth the half-edges of the wall's triangles along it.
    """

    triangles: Flags
    volume: float
    rims: tuple[Ints, ...]


def find_cavities(surface: Surface) -> tuple[Cavity, ...]:
    """The cavities that open to the outside, the largest first.

    Air that is sealed is none of them: it has no rim. Raises nothing for surfaces that do not
    close, but what is found on them means little.
    """
    looks = look_around(surface)
    sky = exposure(surface, looks)
    for dark in DARK:
        inside = sky.known & (sky.share < dark)
        found = _cavities(surface, sky, inside)
        if found:  # a closer look moves rims, and takes no more for inside, such as a gap's ground
            closer = exposure(surface, look_closer(surface, looks, _along_rims(surface, found)))
            return _cavities(surface, closer, inside) or found
    return ()


def _along_rims(surface: Surface, cavities: Sequence[Cavity]) -> Floats:
    """The ends (k, 3) of the edges along all rims."""
    edges = np.concatenate([rim for cavity in cavities for rim in cavity.rims])
    return np.asarray(surface.vertices[surface.half_edges[edges]].reshape(-1, 3))


def _cavities(surface: Surface, sky: Sky, inside: Flags) -> tuple[Cavity, ...]:
    outside = sky.known & (sky.share > BRIGHT) & ~inside
    if not (inside.any() and outside.any()):
        return ()
    inner = _inner_side(surface, sky.share, inside, outside)
    pieces = _pieces(surface, inner)
    cavities = (_cavity(surface, pieces == number) for number in np.unique(pieces[inner]))
    found = [cavity for cavity in cavities if cavity is not None]
    return tuple(sorted(found, key=lambda cavity: -cavity.volume))


def _inner_side(surface: Surface, sky: Floats, inside: Flags, outside: Flags) -> Flags:
    """(m,): triangles on the inner side of the cheapest cut."""
    first, second, half_edge = surface.neighbours
    node = np.arange(len(sky)) + 2
    node[inside], node[outside] = SOURCE, DRAIN
    cost = edge_lengths(surface, half_edge) / (DARKEST + np.maximum(sky[first], sky[second]))
    a, b = node[first], node[second]
    crossing = a != b
    capacity = _whole(cost[crossing])
    reached = source_side(len(sky) + 2, a[crossing], b[crossing], capacity)
    return np.asarray(reached[node])


def _whole(costs: Floats) -> NDArray[np.int32]:
    """(k,): costs in whole units, as fine as they can be while all of them add up to a flow."""
    unit = max(float(costs.sum()), ROUNDING) / LARGEST_FLOW
    return np.asarray(np.maximum(np.rint(costs / unit), 1).astype(np.int32))


def _pieces(surface: Surface, inner: Flags) -> Ints:
    """(m,): number of the connected piece of inner, or outer, surface of each triangle."""
    first, second, _ = surface.neighbours
    same = inner[first] == inner[second]
    return label(len(inner), first[same], second[same])


def _cavity(surface: Surface, triangles: Flags) -> Cavity | None:
    """The piece of inner surface as a cavity; None if it is sealed, or no more than a dent."""
    rims = _rims(surface, triangles)
    around = sum(float(edge_lengths(surface, rim).sum()) ** 2 for rim in rims) / (4 * np.pi)
    if not rims or float(surface.areas[triangles].sum()) < DEEP * around:
        return None
    volume = -_enclosed(surface, triangles, rims)
    return Cavity(triangles, volume, rims) if volume > 0 else None


def _rims(surface: Surface, triangles: Flags) -> tuple[Ints, ...]:
    """Half-edges of the triangles along the border, a group for each connected curve."""
    first, second, half_edge = surface.neighbours
    border = half_edge[triangles[first] != triangles[second]]
    if not len(border):
        return ()
    ends = surface.half_edges[border]
    piece = label(len(surface.vertices), ends[:, 0], ends[:, 1])[ends[:, 0]]
    return tuple(border[piece == number] for number in np.unique(piece))


def _enclosed(surface: Surface, triangles: Flags, rims: tuple[Ints, ...]) -> float:
    """Signed volume, mm³, within triangles and a fan over each rim."""
    corners = surface.corners[triangles]
    total = float(np.einsum("ij,ij->", corners.mean(axis=1), surface.area_vectors[triangles]) / 3)
    for rim in rims:
        start, end = rim_of(surface, triangles, rim)
        middle = (start + end).mean(axis=0) / 2
        total += float(np.einsum("ij,ij->", np.cross(start, end), middle[None]) / 6)
    return total


def rim_of(surface: Surface, triangles: Flags, rim: Ints) -> tuple[Floats, Floats]:
    """Ends (k, 3) of a rim's edges, run through so that a fan over them closes the triangles."""
    ends = surface.vertices[surface.half_edges[rim]]
    own = triangles[rim // 3]  # the half-edge is that of either triangle beside it
    return np.where(own[:, None], ends[:, 1], ends[:, 0]), np.where(
        own[:, None], ends[:, 0], ends[:, 1]
    )


def edge_lengths(surface: Surface, half_edges: Ints) -> Floats:
    """(k,) mm."""
    ends = surface.vertices[surface.half_edges[half_edges]]
    return np.asarray(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
