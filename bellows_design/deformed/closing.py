"""Surfaces of two meshes that meet in a joint, closed by strips of triangles along its outlines.

The outlines are one curve with other nodes on either side. A strip from the one to the other has
next to no area; with it the surface is watertight, each edge used once in either direction.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals

Loop = NDArray[np.int64]


def closed(triangles: Integers, nodes: Reals) -> Integers:
    """Flat triangles (m, 3) on nodes (n, 3) with strips between the outlines that they leave open.

    Each outline is joined to the one that is nearest to it.
    """
    loops = _outlines(triangles)
    strips = [triangles]
    while len(loops) > 1:
        first = loops.pop()
        partner = min(range(len(loops)), key=lambda other: _apart(nodes, first, loops[other]))
        strips.append(_strip(nodes, first, loops.pop(partner)))
    return np.concatenate(strips).astype(np.int32)


def _outlines(triangles: Integers) -> list[Loop]:
    """Nodes along the edges that one triangle alone has, in the direction that it has them."""
    edges = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    size = int(edges.max()) + 1
    keys = edges[:, 0].astype(np.int64) * size + edges[:, 1]
    reverse = edges[:, 1].astype(np.int64) * size + edges[:, 0]
    following = dict(edges[~np.isin(keys, reverse)].tolist())
    loops = []
    while following:
        start, node = following.popitem()
        loop = [start]
        while node != start:
            loop.append(node)
            node = following.pop(node)
        loops.append(np.array(loop))
    return loops


def _apart(nodes: Reals, one: Loop, other: Loop) -> float:
    """How far the boxes around two outlines differ, mm."""
    boxes = [np.stack([nodes[loop].min(axis=0), nodes[loop].max(axis=0)]) for loop in (one, other)]
    return float(np.abs(boxes[0] - boxes[1]).max())


def _strip(nodes: Reals, one: Loop, other: Loop) -> Integers:
    """Triangles between two outlines that run against each other."""
    other = other[::-1]
    nearest = int(np.linalg.norm(nodes[other] - nodes[one[0]], axis=1).argmin())
    other = np.roll(other, -nearest)
    a, b = (_lengths(nodes[loop]) for loop in (one, other))
    strip, i, j = [], 0, 0
    while i < len(one) or j < len(other):
        here, there = one[i % len(one)], other[j % len(other)]
        if j == len(other) or (i < len(one) and a[i] <= b[j]):
            i += 1
            strip.append((one[i % len(one)], here, there))
        else:
            j += 1
            strip.append((there, other[j % len(other)], here))
    return np.array(strip, dtype=np.int32)


def _lengths(points: Reals) -> Reals:
    """Length (k,) along a closed line to the node after each of its points, of the whole."""
    steps = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    lengths: Reals = np.cumsum(steps) / steps.sum()
    return lengths
