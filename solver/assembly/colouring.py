"""Order of parallel assembly: sums that do not depend on the number of threads."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers
from solver.mesh.mesh import Mesh


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
