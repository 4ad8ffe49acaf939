"""The sparsity pattern of the tangent, and the positions of element entries in it.

Computed once per mesh; afterwards the kernels add element matrices directly to CSR values.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import prange
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.compilation import njit
from solver.errors import SolverError


@dataclass(frozen=True)
class Pattern:
    """Upper triangle (with the whole diagonal) in CSR: ``indptr`` (n + 1,), ``indices`` (nnz,)."""

    indptr: Integers
    indices: Integers

    def entries(self, dofs: Integers) -> Integers:
        """Positions in the values of each cell's upper triangle, row by row; -1 where prescribed.

        ``dofs`` (e, m) unknowns of each cell -> (e, m (m + 1) / 2).
        """
        width = dofs.shape[1]
        places = np.empty((len(dofs), width * (width + 1) // 2), np.int32)
        _locate(self.indptr, self.indices, dofs, places)
        return places


@dataclass(frozen=True)
class WholeMatrix:
    """Both triangles of a ``Pattern``, ``indptr`` (n + 1,), ``indices`` (k,), by rows or columns.

    ``source`` (k,): the entry of the upper triangle that each one comes from, ``side`` (k,): 1
    above the diagonal, -1 below, 0 on it, for storage by rows.
    """

    indptr: Integers
    indices: Integers
    source: NDArray[np.int64]
    side: NDArray[np.int8]

    @staticmethod
    def of(pattern: Pattern) -> WholeMatrix:
        """Mirror the upper triangle."""
        from scipy.sparse import csr_array

        size = len(pattern.indptr) - 1
        numbers = np.arange(1, len(pattern.indices) + 1, dtype=np.float64)
        upper = csr_array((numbers, pattern.indices, pattern.indptr), shape=(size, size))
        lower = upper.T.tocsr()
        lower.setdiag(0.0)
        lower.eliminate_zeros()
        whole = csr_array(upper + lower)
        whole.sort_indices()
        rows = np.repeat(np.arange(size), np.diff(whole.indptr))
        return WholeMatrix(
            indptr=whole.indptr.astype(np.int32),
            indices=whole.indices.astype(np.int32),
            source=whole.data.astype(np.int64) - 1,
            side=np.sign(whole.indices - rows).astype(np.int8),
        )

    def by_rows(self, values: Reals, skew: Reals | None) -> Reals:
        """Values (k,) of the symmetric matrix plus a skew one, both given by upper triangles."""
        if skew is None or not len(skew):
            return values[self.source]
        return values[self.source] + self.side * skew[self.source]

    def by_columns(self, values: Reals, skew: Reals | None) -> Reals:
        """The same column by column."""
        return self.by_rows(values, None if skew is None else -skew)


def upper_pattern(dofs: Integers, size: int) -> Pattern:
    """Pattern of a matrix of ``size`` unknowns coupled within cells of unknowns (e, m)."""
    cell_ptr, cells = incidence(dofs, size)
    counts = np.zeros(size + 1, np.int64)
    _count_columns(dofs, cell_ptr, cells, counts)
    indptr = np.cumsum(counts)
    if indptr[-1] > np.iinfo(np.int32).max:
        raise SolverError(f"mesh: {size} unknowns couple in more entries than 32-bit CSR holds.")
    indices = np.empty(indptr[-1], np.int32)
    _fill_columns(dofs, cell_ptr, cells, indptr, indices)
    return Pattern(indptr.astype(np.int32), indices)


def widened(pattern: Pattern, dofs: Integers) -> tuple[Pattern, Integers]:
    """Pattern that also couples unknowns within cells (e, m), and positions of the old entries."""
    size = len(pattern.indptr) - 1
    rows = np.repeat(np.arange(size), np.diff(pattern.indptr))
    old = rows * size + pattern.indices
    upper = np.triu_indices(dofs.shape[1])
    one, other = (dofs[:, index].astype(np.int64).ravel() for index in upper)
    first, last = np.minimum(one, other), np.maximum(one, other)
    keys = np.unique((first * size + last)[first >= 0])
    before = np.searchsorted(old, keys)  # both are sorted: a merge needs no other sorting
    known = before < len(old)
    known[known] = old[before[known]] == keys[known]
    keys, before = keys[~known], before[~known]
    shift = np.cumsum(np.bincount(before, minlength=len(old) + 1)[:-1])
    places = np.arange(len(old)) + shift
    merged = np.empty(len(old) + len(keys), np.int64)
    merged[places] = old
    merged[before + np.arange(len(keys))] = keys
    counts = np.bincount(keys // size, minlength=size) + np.diff(pattern.indptr)
    indptr = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    return Pattern(indptr, (merged % size).astype(np.int32)), places.astype(np.int32)


def incidence(table: Integers, size: int) -> tuple[Integers, Integers]:
    """Rows of ``table`` that contain each number below ``size``, as CSR (pointer, rows)."""
    flat = table.ravel()
    rows = np.repeat(np.arange(len(table), dtype=np.int32), table.shape[1])[flat >= 0]
    flat = flat[flat >= 0]
    pointer = np.concatenate([[0], np.cumsum(np.bincount(flat, minlength=size))])
    return pointer.astype(np.int32), rows[np.argsort(flat, kind="stable")]


@njit(cache=True, nogil=True)
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


@njit(cache=True, nogil=True)
def _same_cells(pointer: Integers, cells: Integers, row: int) -> bool:
    """Whether an unknown belongs to the same cells as the one before, as those of one node do."""
    before, start, end = pointer[row - 1], pointer[row], pointer[row + 1]
    if start - before != end - start or start == end:
        return False
    different = 0
    for k in range(end - start):
        different += cells[before + k] != cells[start + k]
    return different == 0


@njit(cache=True, nogil=True)
def _count_columns(
    dofs: Integers, pointer: Integers, cells: Integers, counts: NDArray[np.int64]
) -> None:
    seen_by = np.full(len(pointer), -1)
    for row in range(len(pointer) - 1):
        if row and _same_cells(pointer, cells, row):  # all columns but the row before itself
            counts[row + 1] = counts[row] - 1
            continue
        for place in range(pointer[row], pointer[row + 1]):
            for column in dofs[cells[place]]:
                if column >= row and seen_by[column] != row:
                    seen_by[column] = row
                    counts[row + 1] += 1


@njit(cache=True, nogil=True)
def _fill_columns(
    dofs: Integers, pointer: Integers, cells: Integers, indptr: NDArray[np.int64], indices: Integers
) -> None:
    seen_by = np.full(len(pointer), -1)
    for row in range(len(pointer) - 1):
        end = indptr[row]
        if row and _same_cells(pointer, cells, row):
            indices[end : indptr[row + 1]] = indices[indptr[row - 1] + 1 : end]
            continue
        for place in range(pointer[row], pointer[row + 1]):
            for column in dofs[cells[place]]:
                if column >= row and seen_by[column] != row:
                    seen_by[column] = row
                    indices[end] = column
                    end += 1
        indices[indptr[row] : end].sort()


@njit(cache=True, nogil=True, parallel=True)
def _locate(indptr: Integers, indices: Integers, dofs: Integers, places: Integers) -> None:
    for cell in prange(len(dofs)):
        _locate_cell(indptr, indices, dofs[cell], places[cell])


@njit(cache=True, nogil=True)
def _locate_cell(indptr: Integers, indices: Integers, dofs: Integers, places: Integers) -> None:
    """Positions of one cell's entries: columns in ascending order, each found behind the last.

    The unknowns of a node follow each other, so that most columns stand right behind the last.
    """
    width = len(dofs)
    order = np.argsort(dofs)
    places[:] = -1
    for a in range(width):
        i = order[a]
        row = dofs[i]
        if row < 0:
            continue
        place = indptr[row]
        for b in range(a, width):
            j = order[b]
            place = _found_from(indices, place, indptr[row + 1], dofs[j])
            first, last = min(i, j), max(i, j)
            places[first * width - first * (first + 1) // 2 + last] = place


@njit(cache=True, nogil=True)
def _found_from(indices: Integers, start: int, end: int, column: int) -> int:
    """Where a column stands in the ascending ``indices`` from ``start`` to ``end``."""
    for place in range(start, min(start + 2, end)):
        if indices[place] == column:
            return place
    low, high = start, end
    while low < high:
        middle = (low + high) // 2
        if indices[middle] < column:
            low = middle + 1
        else:
            high = middle
    return low
