"""A triangle mesh refined where it must be; neighbours keep sharing their edges."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from printers.arrays import Flags, Floats, Ints

Wanted = Callable[[Floats, Ints, Ints], Flags]
"""Of vertices (n, 3), triangles (m, 3) and their origins (m,): which edges (m, 3), each from a
corner to the next, are to be halved."""


def refined(
    vertices: Floats, triangles: Ints, wanted: Wanted, passes: int
) -> tuple[Floats, Ints, Ints]:
    """Vertices (n, 3), triangles (m, 3), and of which triangle each is a part (m,).

    Edges that are ``wanted`` are halved, in all triangles that share them, again and again until
    there is none, or for so many ``passes``.
    """
    origin = np.arange(len(triangles))
    for _ in range(passes):
        edges, numbers = _edges(triangles)
        chosen = np.zeros(len(edges), dtype=bool)
        chosen[numbers[wanted(vertices, triangles, origin)]] = True
        if not chosen.any():
            break
        middles = np.full(len(edges), -1)
        middles[chosen] = len(vertices) + np.arange(chosen.sum())
        vertices = np.concatenate([vertices, vertices[edges[chosen]].mean(axis=1)])
        triangles, parents = _split(triangles, middles[numbers])
        origin = origin[parents]
    return vertices, triangles, origin


def edge_lengths(vertices: Floats, triangles: Ints) -> Floats:
    """Lengths (m, 3) of the edges from each corner to the next."""
    corners = vertices[triangles]
    return np.asarray(np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2))


def _edges(triangles: Ints) -> tuple[Ints, Ints]:
    """Edges (k, 2), and the numbers (m, 3) of those from each corner to the next."""
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
    size = int(triangles.max()) + 1
    keys, numbers = np.unique(ends[:, :, 0] * size + ends[:, :, 1], return_inverse=True)
    edges = np.stack([keys // size, keys % size], axis=1)
    return edges, numbers.reshape(triangles.shape)


def _split(triangles: Ints, middles: Ints) -> tuple[Ints, Ints]:
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
