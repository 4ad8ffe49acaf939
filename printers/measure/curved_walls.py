"""Which curved walls a part has: cans and domes, but not the corners between flat walls.

A curved face that runs smoothly into a flat wall is the corner of that wall. How the wall thickens
in there depends on both fillets, from nothing where they have one centre to a sharp edge, and any
of that is sound as long as the flat wall is; so corners are not judged, whatever their radii.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.arrays import Flags, Ints
from printers.measure.slabs import STEADY_SPREAD, Neighbours, Slabs
from printers.measure.surface import label
from printers.tolerances import SMALLEST_AREA

MOST_OF_IT = (0.125, 0.875)
"""Quantiles between which a curved wall must keep its thickness: at its rim, where it runs into a
foot or a floor, it may grow."""


def curved_walls(
    slabs: Slabs, pairs: Neighbours, curved: Flags, flat: Flags, constant: Flags
) -> Iterator[Flags]:
    """Flags (k,) of the slabs of every curved wall, flat walls and their corners left out.

    `curved`, `flat` (k,): slabs on curved and on flat walls; `constant` (k,): slabs around which
    the thickness stays the same. Parts that are nowhere constant are no walls: a round bore in a
    block has none.
    """
    piece = _pieces(pairs, curved)
    corners = np.unique(piece[_beside(pairs, curved, flat)])
    for number in np.setdiff1d(np.unique(piece[curved]), corners):
        members = piece == number
        if (members & constant).sum() * slabs.area >= SMALLEST_AREA:
            yield members & _typical(slabs, members)


def _pieces(pairs: Neighbours, curved: Flags) -> Ints:
    """(k,): number of the connected curved piece that every slab belongs to; -1 on others."""
    inside = curved[pairs.first] & curved[pairs.second]
    numbers = label(len(curved), pairs.first[inside], pairs.second[inside])
    return np.where(curved, numbers, -1)


def _beside(pairs: Neighbours, curved: Flags, flat: Flags) -> Flags:
    """(k,): curved slabs with a neighbour on a flat wall."""
    result = np.zeros(len(curved), dtype=bool)
    for here, there in ((pairs.first, pairs.second), (pairs.second, pairs.first)):
        result[here[curved[here] & flat[there]]] = True
    return result


def _typical(slabs: Slabs, members: Flags) -> Flags:
    """(k,): all slabs if the wall tapers, otherwise those about as thick as most of it."""
    low, median, high = np.quantile(slabs.thickness[members], [MOST_OF_IT[0], 0.5, MOST_OF_IT[1]])
    if high - low > STEADY_SPREAD:
        return np.ones(len(members), dtype=bool)
    return np.asarray(np.abs(slabs.thickness - median) <= STEADY_SPREAD / 2)
