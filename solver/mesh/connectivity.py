"""Connected parts of a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers
from solver.compilation import njit


@njit(cache=True)
def connected_parts(cells: Integers, size: int) -> Integers:
    """Number of the part that each of ``size`` nodes belongs to, -1 for nodes of no cell (n,).

    Cells (e, m) that share a node belong to one part.
    """
    parent = np.arange(size)
    used = np.zeros(size, np.bool_)
    for cell in cells:
        root = _root(parent, cell[0])
        for node in cell:
            parent[_root(parent, node)] = root
            used[node] = True
    parts = np.full(size, -1, np.int32)
    count = 0
    for node in range(size):
        if not used[node]:
            continue
        root = _root(parent, node)
        if parts[root] < 0:
            parts[root] = count
            count += 1
        parts[node] = parts[root]
    return parts


@njit(cache=True)
def _root(parent: NDArray[np.int64], node: int) -> int:
    """Root of a node in the union-find forest, with path halving."""
    while parent[node] != node:
        parent[node] = parent[parent[node]]
        node = parent[node]
    return node
