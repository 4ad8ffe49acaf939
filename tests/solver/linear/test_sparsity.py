"""The pattern of a matrix of cells, and where the cells' entries stand in it."""

from __future__ import annotations

import numpy as np
import pytest

from solver.arrays import Integers
from solver.linear.sparsity import upper_pattern, widened

NODES, CELLS, WIDTH = 40, 60, 5


def cells(random: np.random.Generator) -> tuple[Integers, int]:
    """Cells of nodes with three unknowns each, some of them prescribed, and one for all cells."""
    numbers = np.full((NODES, 3), -1, np.int32)
    free = random.random((NODES, 3)) > 0.2
    numbers[free] = np.arange(free.sum(), dtype=np.int32)
    nodes = np.stack([random.choice(NODES, WIDTH, replace=False) for _ in range(CELLS)])
    common = np.full((CELLS, 1), free.sum(), np.int32)
    return np.hstack([numbers[nodes].reshape(CELLS, -1), common]), int(free.sum()) + 1


@pytest.mark.parametrize("seed", range(5))
def test_entries_of_cells_add_up_to_the_matrix_of_their_couplings(seed: int) -> None:
    """Against a dense matrix, to which each pair of a cell's unknowns adds a number of its own."""
    random = np.random.default_rng(seed)
    dofs, size = cells(random)
    pattern = upper_pattern(dofs, size)
    entries = pattern.entries(dofs)
    one, other = np.triu_indices(dofs.shape[1])
    weights = random.integers(1, 100, entries.shape).astype(float)
    dense = np.zeros((size, size))
    rows, columns = dofs[:, one], dofs[:, other]
    used = (rows >= 0) & (columns >= 0)
    low, high = np.minimum(rows, columns)[used], np.maximum(rows, columns)[used]
    np.add.at(dense, (low, high), weights[used])
    assert ((entries >= 0) == used).all()
    values = np.bincount(entries[used], weights[used], len(pattern.indices))
    found = np.zeros((size, size))
    found[np.repeat(np.arange(size), np.diff(pattern.indptr)), pattern.indices] = values
    assert (found == dense).all()
    assert np.count_nonzero(dense) == len(pattern.indices)  # no entry is missing, none too many


def test_columns_of_every_row_ascend() -> None:
    pattern = upper_pattern(*cells(np.random.default_rng(9)))
    steps = np.diff(pattern.indices)
    within = np.ones(len(steps), bool)
    ends = pattern.indptr[1:-1] - 1
    within[ends[(ends >= 0) & (ends < len(steps))]] = False
    assert (steps[within] > 0).all()


@pytest.mark.parametrize("seed", range(3))
def test_a_widened_pattern_is_that_of_all_cells_and_keeps_what_was_there(seed: int) -> None:
    random = np.random.default_rng(seed)
    dofs, size = cells(random)
    more = random.integers(-1, size, (7, 9)).astype(np.int32)
    narrow = upper_pattern(dofs, size)
    wide, places = widened(narrow, more)
    rows = np.full((CELLS + 7, dofs.shape[1]), -1, np.int32)
    rows[:CELLS], rows[CELLS:, :9] = dofs, more
    whole = upper_pattern(rows, size)
    assert np.array_equal(wide.indptr, whole.indptr)
    assert np.array_equal(wide.indices, whole.indices)
    assert np.array_equal(wide.indices[places], narrow.indices)
    assert np.array_equal(widened(wide, more)[1], np.arange(len(wide.indices)))
