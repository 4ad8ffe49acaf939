"""The sparsity pattern of the tangent, and where every element's entries lie in it.

Computed once per mesh; afterwards the kernels add element matrices straight into CSR values.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from solver.arrays import Integers
from solver.mesh.mesh import Mesh


@dataclass(frozen=True)
class Pattern:
    """Upper triangle (with the whole diagonal) in CSR: ``indptr`` (n + 1,), ``indices`` (nnz,)."""

    indptr: Integers
    indices: Integers

    def entries(self, dofs: Integers) -> Integers:
        """Places in the values of each cell's upper triangle, row by row; -1 where prescribed.

        ``dofs`` (e, m) unknowns of each cell -> (e, m (m + 1) / 2).
        """
        width = dofs.shape[1]
        places = np.empty((len(dofs), width * (width + 1) // 2), np.int32)
        _locate(self.indptr, self.indices, dofs, places)
        return places


def upper_pattern(dofs: Integers, size: int) -> Pattern:
    """Pattern of a matrix of ``size`` unknowns coupled within cells of unknowns (e, m)."""
    cell_ptr, cells = incidence(dofs, size)
    counts = np.zeros(size + 1, np.int64)
    _count_columns(dofs, cell_ptr, cells, counts)
    indptr = np.cumsum(counts)
    if indptr[-1] > np.iinfo(np.int32).max:
        raise ValueError(f"mesh: {size} unknowns couple in more entries than 32-bit CSR holds.")
    indices = np.empty(indptr[-1], np.int32)
    _fill_columns(dofs, cell_ptr, cells, indptr, indices)
    return Pattern(indptr.astype(np.int32), indices)


def widened(pattern: Pattern, dofs: Integers) -> tuple[Pattern, Integers]:
    """A pattern that also couples the unknowns within cells (e, m), and the old entries' places."""
    size = len(pattern.indptr) - 1
    rows = np.repeat(np.arange(size), np.diff(pattern.indptr))
    old = rows * size + pattern.indices
    upper = np.triu_indices(dofs.shape[1])
    one, other = (dofs[:, index].astype(np.int64).ravel() for index in upper)
    first, last = np.minimum(one, other), np.maximum(one, other)
    keys = np.union1d(old, (first * size + last)[first >= 0])
    counts = np.bincount(keys // size, minlength=size)
    indptr = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    places = np.searchsorted(keys, old).astype(np.int32)
    return Pattern(indptr, (keys % size).astype(np.int32)), places


def incidence(table: Integers, size: int) -> tuple[Integers, Integers]:
    """Which rows of ``table`` name each number below ``size``, as CSR (pointer, rows)."""
    flat = table.ravel()
    rows = np.repeat(np.arange(len(table), dtype=np.int32), table.shape[1])[flat >= 0]
    flat = flat[flat >= 0]
    pointer = np.concatenate([[0], np.cumsum(np.bincount(flat, minlength=size))])
    return pointer.astype(np.int32), rows[np.argsort(flat, kind="stable")]


@njit(cache=True)
def connected_parts(cells: Integers, size: int) -> Integers:
    """Number of the part that each of ``size`` nodes belongs to, -1 for nodes of no cell (n,).

    Cells (e, m) that share a node belong to one part.
    """
    parent = np.arange(size)
    for cell in cells:
        root = _root(parent, cell[0])
        for node in cell[1:]:
            parent[_root(parent, node)] = root
    parts = np.full(size, -1, np.int32)
    count = 0
    for node in np.unique(cells):
        root = _root(parent, node)
        if parts[root] < 0:
            parts[root] = count
            count += 1
        parts[node] = parts[root]
    return parts


@njit(cache=True)
def _root(parent: NDArray[np.int64], node: int) -> int:
    """Where the parents of a node end; the way there is halved for the next time."""
    while parent[node] != node:
        parent[node] = parent[parent[node]]
        node = parent[node]
    return node


@njit(cache=True)
def is_odd(permutation: Integers) -> bool:
    """Whether a permutation (n,) is made of an odd number of swaps."""
    seen = np.zeros(len(permutation), np.bool_)
    cycles = 0
    for first in range(len(permutation)):
        if not seen[first]:
            cycles += 1
            place = first
            while not seen[place]:
                seen[place] = True
                place = permutation[place]
    return (len(permutation) - cycles) % 2 == 1


def chunks(
    mesh: Mesh, elements: NDArray[np.int64] | None = None
) -> tuple[Integers, Integers, Integers]:
    """All or some elements in chunks, the chunks in colours: chunks of one colour share no node.

    Chunks are slabs across the longest side of the body, so that few colours suffice. Returns the
    elements chunk by chunk (e,), where each chunk starts (c + 1,), and at which chunk each colour
    starts (k + 1,).
    """
    elements = np.arange(len(mesh.tets)) if elements is None else elements
    if len(elements) == 0:
        return np.zeros(0, np.int32), np.zeros(1, np.int32), np.zeros(1, np.int32)
    centres = mesh.nodes[mesh.tets[elements]].mean(axis=1)
    along = centres[:, np.ptp(centres, axis=0).argmax()]
    count = int(np.clip(len(centres) // ELEMENTS_PER_CHUNK, 1, MOST_CHUNKS))
    order = elements[np.argsort(along, kind="stable")].astype(np.int32)
    slabs = np.array_split(order, count)
    touched = np.zeros((count, len(mesh.nodes)), np.float32)
    for slab, nodes in zip(slabs, touched, strict=True):
        nodes[mesh.tets[slab]] = 1.0
    colours = _colour(touched @ touched.T > 0)
    by_colour = np.argsort(colours, kind="stable")
    lengths = [len(slabs[slab]) for slab in by_colour]
    return (
        np.concatenate([slabs[slab] for slab in by_colour]),
        np.cumsum([0, *lengths], dtype=np.int32),
        np.cumsum([0, *np.bincount(colours)], dtype=np.int32),
    )


ELEMENTS_PER_CHUNK = 64
MOST_CHUNKS = 64


def _colour(touching: NDArray[np.bool_]) -> list[int]:
    """Greedy colouring of a graph given by its symmetric adjacency matrix."""
    colours: list[int] = []
    for node, neighbours in enumerate(touching):
        taken = {colours[other] for other in np.flatnonzero(neighbours[:node])}
        colours.append(next(c for c in range(node + 1) if c not in taken))
    return colours


@njit(cache=True)
def _count_columns(
    dofs: Integers, pointer: Integers, rows: Integers, counts: NDArray[np.int64]
) -> None:
    seen_by = np.full(len(pointer), -1)
    for row in range(len(pointer) - 1):
        for place in range(pointer[row], pointer[row + 1]):
            for column in dofs[rows[place]]:
                if column >= row and seen_by[column] != row:
                    seen_by[column] = row
                    counts[row + 1] += 1


@njit(cache=True)
def _fill_columns(
    dofs: Integers, pointer: Integers, rows: Integers, indptr: NDArray[np.int64], indices: Integers
) -> None:
    seen_by = np.full(len(pointer), -1)
    for row in range(len(pointer) - 1):
        end = indptr[row]
        for place in range(pointer[row], pointer[row + 1]):
            for column in dofs[rows[place]]:
                if column >= row and seen_by[column] != row:
                    seen_by[column] = row
                    indices[end] = column
                    end += 1
        indices[indptr[row] : end].sort()


@njit(cache=True, parallel=True)
def _locate(indptr: Integers, indices: Integers, dofs: Integers, places: Integers) -> None:
    for cell in prange(len(dofs)):
        entry = 0
        for i in range(dofs.shape[1]):
            for j in range(i, dofs.shape[1]):
                row = min(dofs[cell, i], dofs[cell, j])
                column = max(dofs[cell, i], dofs[cell, j])
                if row < 0:
                    places[cell, entry] = -1
                else:
                    start, end = indptr[row], indptr[row + 1]
                    place = start + np.searchsorted(indices[start:end], column)
                    places[cell, entry] = place
                entry += 1
