"""Locating the leaks of a cavity.

With the declared openings plugged, the shortest closed curve on the surface that parts the cavity
from the outside is the rim of the leak: a minimum cut in the graph of neighbouring triangles whose
capacities are the lengths of the shared edges.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from printers.arrays import Flags, Floats, Ints
from printers.measure.plugging import near_axis
from printers.measure.surface import Surface, label
from printers.model import Opening

SOURCE, DRAIN = 0, 1  # nodes of the graph: what is certainly inside, and outside
UNITS_PER_MILLIMETRE = 1000  # the maximum flow counts in whole micrometres
GROWTH_STEPS = (0.0, 2.0, 4.0, 8.0, 16.0)  # radii of the opening taken as certainly inside


@dataclass(frozen=True)
class Leak:
    """`centre` (3,) mm of the leak's rim and the `width` of a circle as long as the rim, mm."""

    centre: tuple[float, float, float]
    width: float


def find_leaks(surface: Surface, openings: Sequence[Opening]) -> tuple[Leak, ...]:
    """The leaks of a plugged surface, narrowest first; none when all are wider than the opening."""
    centres = surface.corners.mean(axis=1)
    inner_ends = _inner_ends(surface, centres, openings)
    outside = _on_bounding_box(surface)
    if not inner_ends.any():
        return ()
    distance = np.linalg.norm(centres - centres[inner_ends].mean(axis=0), axis=1)
    for step in GROWTH_STEPS:
        reach = step * max(opening.radius for opening in openings)
        inside = inner_ends | (_connected(surface, inner_ends, distance <= reach) & ~outside)
        rim = _minimum_cut(surface, inside, outside)
        if not _follows_start_border(surface, rim, inside):
            return _leaks(surface, rim)
    return ()


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


def _minimum_cut(surface: Surface, inside: Flags, outside: Flags) -> Ints:
    """Half-edges of the shortest curve between the two sets of triangles."""
    first, second, half_edge = surface.neighbours
    node = np.arange(len(inside)) + 2
    node[inside], node[outside] = SOURCE, DRAIN
    length = _edge_lengths(surface, half_edge)
    capacity = np.ceil(length * UNITS_PER_MILLIMETRE).astype(np.int32)
    a, b = node[first], node[second]
    crossing = a != b
    reached = _source_side(len(node) + 2, a[crossing], b[crossing], capacity[crossing])
    return half_edge[reached[a] != reached[b]]


def _source_side(count: int, a: Ints, b: Ints, capacity: NDArray[np.int32]) -> Flags:
    """(count,): nodes on the source's side of the minimum cut of a graph with the edges a-b."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    ends = np.concatenate([a, b]), np.concatenate([b, a])
    graph = coo_array((np.tile(capacity, 2), ends), shape=(count, count)).tocsr()
    residual = graph - maximum_flow(graph, SOURCE, DRAIN).flow
    residual.data[residual.data < 0] = 0
    residual.eliminate_zeros()
    reached = np.zeros(count, dtype=bool)
    reached[breadth_first_order(residual, SOURCE, return_predecessors=False)] = True
    return reached


def _edge_lengths(surface: Surface, half_edge: Ints) -> Floats:
    ends = surface.vertices[surface.half_edges[half_edge]]
    return np.asarray(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))


def _follows_start_border(surface: Surface, rim: Ints, inside: Flags) -> bool:
    """Whether most of the curve runs along the border of the set it started from."""
    first, second, half_edge = surface.neighbours
    border = half_edge[inside[first] != inside[second]]
    lengths = _edge_lengths(surface, rim)
    return bool(lengths[np.isin(rim, border)].sum() > 0.5 * lengths.sum())


def _leaks(surface: Surface, rim: Ints) -> tuple[Leak, ...]:
    """One leak for every connected piece of the curve."""
    ends = surface.half_edges[rim]
    piece = label(len(surface.vertices), ends[:, 0], ends[:, 1])[ends[:, 0]]
    leaks = [_leak(surface, rim[piece == number]) for number in np.unique(piece)]
    return tuple(sorted(leaks, key=lambda leak: leak.width))


def _leak(surface: Surface, rim: Ints) -> Leak:
    middles = surface.vertices[surface.half_edges[rim]].mean(axis=1)
    lengths = _edge_lengths(surface, rim)
    x, y, z = (float(value) for value in np.average(middles, axis=0, weights=lengths))
    return Leak((x, y, z), float(lengths.sum()) / np.pi)
