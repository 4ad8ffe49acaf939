"""Ten-node tetrahedra from four-node ones: a new node in the middle of every edge."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.exchange.found import Numbers
from solver.mesh.elements import TETRAHEDRON_EDGES


def with_middles(nodes: Reals, tets: Numbers) -> tuple[Reals, Numbers, Numbers]:
    """Nodes (m, 3) and tetrahedra (e, 10) with mid-nodes, and the ends (m - n, 2) of the new ones.

    ``tets`` are (e, 4), on ``nodes`` (n, 3), which keep their numbers.
    """
    ends = np.sort(np.stack([tets[:, edge] for edge in TETRAHEDRON_EDGES], axis=1), axis=2)
    edges, place = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    middles = len(nodes) + place.reshape(-1, len(TETRAHEDRON_EDGES))
    every = np.concatenate([nodes, nodes[edges].mean(axis=1)])
    return every, np.concatenate([tets, middles], axis=1), edges


def with_middles_in_sets(
    node_sets: dict[str, Numbers], edges: Numbers, number_of_nodes: int
) -> dict[str, Numbers]:
    """Sets of nodes, each with the new nodes between two of its own.

    ``edges`` (k, 2) are the ends of the new nodes, which follow the ``number_of_nodes`` old ones.
    """
    larger = {}
    for name, members in node_sets.items():
        marked = np.zeros(number_of_nodes, bool)
        marked[members] = True
        between = number_of_nodes + np.flatnonzero(marked[edges].all(axis=1))
        larger[name] = np.concatenate([np.asarray(members, np.int64), between])
    return larger
