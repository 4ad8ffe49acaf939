"""A triangle mesh with no edge longer than asked for; neighbours keep sharing their edges."""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals

MOST_PASSES = 12
"""Each halves what is too long: enough for 4000 times the length."""


def refined(
    vertices: Reals, triangles: Integers, longest: float
) -> tuple[Reals, Integers, Integers]:
    """Vertices (n, 3), triangles (m, 3), and of which triangle each is a part (m,).

    Every edge longer than ``longest`` is halved, until there is none.
    """
    origin = np.arange(len(triangles))
    for _ in range(MOST_PASSES):
        edges, numbers = _edges(triangles)
        long = np.linalg.norm(np.diff(vertices[edges], axis=1)[:, 0], axis=1) > longest
        if not long.any():
            break
        middles = np.full(len(edges), -1)
        middles[long] = len(vertices) + np.arange(long.sum())
        vertices = np.concatenate([vertices, vertices[edges[long]].mean(axis=1)])
        triangles, parents = _split(triangles, middles[numbers])
        origin = origin[parents]
    return vertices, triangles, origin


def _edges(triangles: Integers) -> tuple[Integers, Integers]:
    """Edges (k, 2), and the numbers (m, 3) of those from each corner to the next."""
    pairs = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2)
    edges, numbers = np.unique(np.sort(pairs.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    return edges, numbers.reshape(triangles.shape)


def _split(triangles: Integers, middles: Integers) -> tuple[Integers, Integers]:
    """Triangles cut at the middles (m, 3) of their edges, -1 where there is none."""
    marked = middles >= 0
    count = marked.sum(axis=1)
    turns = np.where(count == 1, marked.argmax(axis=1), ((~marked).argmax(axis=1) + 1) % 3)
    turns = np.where(count % 3 == 0, 0, turns)
    columns = (turns[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, columns, axis=1).T
    d, e, f = np.take_along_axis(middles, columns, axis=1).T
    parts = {
        0: ((a, b, c),),
        1: ((a, d, c), (d, b, c)),
        2: ((d, b, e), (a, d, e), (a, e, c)),
        3: ((a, d, f), (d, b, e), (f, e, c), (d, e, f)),
    }
    found = [
        (np.stack(corners, axis=1)[count == number], np.flatnonzero(count == number))
        for number, pieces in parts.items()
        for corners in pieces
    ]
    return np.concatenate([each for each, _ in found]), np.concatenate([own for _, own in found])
