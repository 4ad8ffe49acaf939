"""Locating the leaks of a cavity, and telling its wall from the outside although it is open.

With the declared openings plugged, the shortest closed curve on the surface that parts the cavity
from the outside is the rim of the leak: a minimum cut in the graph of neighbouring triangles whose
capacities are the lengths of the shared edges. The cut runs between what is certainly inside, which
hangs together with the plugs' inner ends and sees no open air, and what certainly sees some.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.leakage.exposure import escaping_rays
from printers.measure.leakage.minimum_cut import DRAIN, SOURCE, source_side
from printers.measure.plugging import near_axis
from printers.measure.surface import Surface, label
from printers.model import Opening

RIM_STEP = 0.2  # mm
UNITS_PER_MILLIMETRE = 1000  # the maximum flow counts in whole micrometres
OUT_IN_THE_OPEN = 18  # escaping rays: more than from the wall of a hole, half of which is covered


@dataclass(frozen=True)
class Leak:
    """`centre` (3,) mm of the leak's rim and its `width`, mm: its hydraulic diameter, four times
    the area within the rim over the rim's length, which is the diameter of a round hole and about
    twice the width of a long slit."""

    centre: tuple[float, float, float]
    width: float


@dataclass(frozen=True, eq=False)
class OpenCavity:
    """A cavity that leaks: its `leaks`, narrowest first, the triangles of its wall, `inside` (m,),
    and points (k, 3) mm along the rims of the leaks."""

    leaks: tuple[Leak, ...]
    inside: Flags
    rims: Floats


def find_leaks(surface: Surface, openings: Sequence[Opening]) -> OpenCavity | None:
    """The leaks of a plugged surface; None if the cavity lies as open as the outside."""
    centres = surface.corners.mean(axis=1)
    inner_ends = _inner_ends(surface, centres, openings)
    escaping = escaping_rays(surface)
    outside = _on_bounding_box(surface) | (escaping >= OUT_IN_THE_OPEN)
    hidden = _connected(surface, inner_ends, escaping == 0) & ~outside
    if not (inner_ends & hidden).any():
        return None
    reached, rim = _minimum_cut(surface, hidden, outside)
    return OpenCavity(_leaks(surface, rim), reached, _along(surface.vertices[rim]))


def _inner_ends(surface: Surface, centres: Floats, openings: Sequence[Opening]) -> Flags:
    """Triangles on the faces of the plugs that look into the cavity."""
    chosen = np.zeros(len(centres), dtype=bool)
    for opening in openings:
        inwards = surface.normals @ -np.asarray(opening.direction) > 0.99
        behind = (centres - opening.centre) @ np.asarray(opening.direction) < -opening.radius / 2
        chosen |= near_axis(centres, opening, 0.0) & inwards & behind
    return chosen


def _on_bounding_box(surface: Surface) -> Flags:
    near = np.abs(surface.vertices[:, None] - surface.bounds) < 1e-6
    touching = np.asarray(near.any(axis=(1, 2)))
    return np.asarray(np.all(touching[surface.triangles], axis=1))


def _connected(surface: Surface, start: Flags, allowed: Flags) -> Flags:
    first, second, _ = surface.neighbours
    free = start | allowed
    kept = free[first] & free[second]
    piece = label(len(free), first[kept], second[kept])
    return free & np.isin(piece, piece[start])


def _minimum_cut(surface: Surface, inside: Flags, outside: Flags) -> tuple[Flags, Ints]:
    """Triangles (m,) on the inner side of the shortest curve between the two sets, and the ends
    (k, 2) of the edges along the curve, which all run in the sense of the inner triangles."""
    first, second, half_edge = surface.neighbours
    node = np.arange(len(inside)) + 2
    node[inside], node[outside] = SOURCE, DRAIN
    ends = surface.half_edges[half_edge]
    capacity = np.ceil(_lengths(surface, ends) * UNITS_PER_MILLIMETRE).astype(np.int32)
    a, b = node[first], node[second]
    crossing = a != b
    reached = source_side(len(node) + 2, a[crossing], b[crossing], capacity[crossing])
    out, back = reached[a] & ~reached[b], reached[b] & ~reached[a]
    return reached[node], np.concatenate([ends[out], ends[back][:, ::-1]])


def _lengths(surface: Surface, ends: Ints) -> Floats:
    """(k,) mm of edges between vertices (k, 2)."""
    return np.asarray(np.linalg.norm(np.diff(surface.vertices[ends], axis=1)[:, 0], axis=1))


def _along(segments: Floats) -> Floats:
    """Points (k, 3) along segments (n, 2, 3), closer to each other than `RIM_STEP`."""
    longest = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).max(initial=0.0)
    share = np.linspace(0, 1, int(longest / RIM_STEP) + 2)[:, None, None]
    return np.asarray(((1 - share) * segments[:, 0] + share * segments[:, 1]).reshape(-1, 3))


def _leaks(surface: Surface, rim: Ints) -> tuple[Leak, ...]:
    """One leak for every connected piece of the curve."""
    piece = label(len(surface.vertices), rim[:, 0], rim[:, 1])[rim[:, 0]]
    leaks = [_leak(surface, rim[piece == number]) for number in np.unique(piece)]
    return tuple(sorted(leaks, key=lambda leak: leak.width))


def _leak(surface: Surface, rim: Ints) -> Leak:
    ends, lengths = surface.vertices[rim], _lengths(surface, rim)
    x, y, z = (float(value) for value in np.average(ends.mean(axis=1), axis=0, weights=lengths))
    spokes = ends - np.array([x, y, z])
    area = np.linalg.norm(np.cross(spokes[:, 0], spokes[:, 1]).sum(axis=0)) / 2
    return Leak((x, y, z), float(4 * area / lengths.sum()))
