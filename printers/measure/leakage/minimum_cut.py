"""The minimum cut of a graph: the cheapest edges that part its source from its drain."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from printers.arrays import Flags, Ints

SOURCE, DRAIN = 0, 1
"""Numbers of these two nodes."""


def source_side(count: int, a: Ints, b: Ints, capacity: NDArray[np.int32]) -> Flags:
    """(count,): nodes on the source's side of the minimum cut of a graph with the edges a-b.

    `capacity` of the edges in whole units; all of them must add up to less than 2³¹.
    """
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
