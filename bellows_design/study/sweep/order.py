"""An order in which neighbours follow each other: a short way through all points.

A travelling salesman's way, found by the usual heuristics: the nearest point next, then pieces are
turned round where that shortens it (2-opt; G. A. Croes, Operations Research 6(6), 1958), among
pieces that are not long. Ten thousand points take seconds, where their evaluation takes hours.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

Points = NDArray[np.float64]
Places = NDArray[np.intp]

NEAREST = 8
"""Points that are asked for at once; more where all of them were passed."""

LONGEST_PIECE = 60
"""Points in a piece that is turned round."""

PASSES = 3
"""Over the whole way."""


def ordered(points: Points, groups: Sequence[Hashable]) -> Places:
    """Places of ``points``, shape (points, axes), in an order that is short; groups are kept whole.

    Designs of different topology are no neighbours, however near: each is a group. The way of a
    group begins with its point nearest to the end of the one before.
    """
    members: dict[Hashable, list[int]] = {}
    for place, group in enumerate(groups):
        members.setdefault(group, []).append(place)
    rest = [np.array(places, dtype=np.intp) for places in members.values()]
    way: list[Places] = []
    end = points.min(axis=0) if len(points) else np.zeros(0)
    while rest:
        gaps = [np.linalg.norm(points[places] - end, axis=1).min() for places in rest]
        places = rest.pop(int(np.argmin(gaps)))
        way.append(places[_way(points[places], end)])
        end = points[way[-1][-1]]
    return np.concatenate(way) if way else np.zeros(0, np.intp)


def length(points: Points) -> float:
    """Of the way through points in their order."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _way(points: Points, start: NDArray[np.float64]) -> Places:
    way = _nearest_next(points, start)
    for _ in range(PASSES):
        if not _turn_pieces(points, way):
            break
    return way


def _nearest_next(points: Points, start: NDArray[np.float64]) -> Places:
    """Always to the nearest point that was not passed; the tree is made anew as it empties."""
    left = np.arange(len(points))
    passed = np.zeros(len(points), dtype=bool)
    way = np.empty(len(points), dtype=np.intp)
    tree, here, gone = KDTree(points), start, 0
    for step in range(len(points)):
        if 2 * gone > len(left):
            left, gone = left[~passed[left]], 0
            tree = KDTree(points[left])
        way[step] = _nearest(tree, left, passed, here)
        passed[way[step]] = True
        here, gone = points[way[step]], gone + 1
    return way


def _nearest(tree: KDTree, left: Places, passed: NDArray[np.bool_], here: Points) -> int:
    """The nearest point of the tree that was not passed; there is one."""
    number = NEAREST
    while True:
        number = min(number, len(left))
        found = left[np.atleast_1d(tree.query(here, number)[1])]
        fresh = found[~passed[found]]
        if len(fresh):
            return int(fresh[0])
        number *= 2


def _turn_pieces(points: Points, way: Places) -> bool:
    """Turn pieces of ``way`` round, in place, where that shortens it; whether any was."""
    turned = False
    for first in range(len(way) - 3):
        path = points[way[first : first + LONGEST_PIECE + 2]]
        steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
        # the piece from the second point of the path to point `last`, then on to the one after it
        across = np.linalg.norm(path[2:-1] - path[0], axis=1)
        onward = np.linalg.norm(path[3:] - path[1], axis=1)
        gain = steps[0] + steps[2:] - across - onward
        best = int(np.argmax(gain))
        if gain[best] > 1e-12:
            piece = slice(first + 1, first + 3 + best)
            way[piece] = way[piece][::-1].copy()
            turned = True
    return turned
