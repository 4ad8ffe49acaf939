"""Regions of a mesh: named sets of elements, and the sides that nodes have in them.

A node between regions has one side in each of them. What may jump across an interface, such as the
hydrostatic pressure or a recovered stress, has one value for each side.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers
from solver.errors import SolverError
from solver.input_types import mapping, shown

REST = ""
"""Stands for the elements of no named region among the names of regions."""


def checked_regions(given: Mapping[str, Integers], number_of_elements: int) -> dict[str, Integers]:
    """Regions as read-only arrays (k,); ``SolverError`` unless they are disjoint and in range."""
    regions = {
        name: _elements(name, elements, number_of_elements)
        for name, elements in mapping("mesh: regions", given, "name -> elements").items()
    }
    owner = np.full(number_of_elements, -1)
    for number, (name, elements) in enumerate(regions.items()):
        twice = elements[owner[elements] >= 0]
        if len(twice):
            other = list(regions)[owner[twice[0]]]
            raise SolverError(
                f"mesh: element {twice[0]} is in the regions {other!r} and {name!r}; regions must "
                "be disjoint."
            )
        owner[elements] = number
    return regions


def region_numbers(regions: Mapping[str, Integers], number_of_elements: int) -> Integers:
    """Number of each element's region (e,): 0 of the rest, then in the order of the names."""
    numbers = np.zeros(number_of_elements, np.int32)
    for number, elements in enumerate(regions.values(), start=1):
        numbers[elements] = number
    return numbers


def sides_of(
    cells: Integers, region: Integers, regions: int
) -> tuple[Integers, Integers, Integers]:
    """Sides of the nodes of ``cells`` (e, m), which lie in a ``region`` (e,) each.

    Returns node (s,) and region (s,) of each side, ascending by node, then by region, and the sides
    of each cell's nodes (e, m). There are so many ``regions``, with the rest.
    """
    keys = cells.astype(np.int64) * regions + region[:, None]
    sides, positions = np.unique(keys, return_inverse=True)
    nodes, numbers = np.divmod(sides, regions)
    return (
        nodes.astype(np.int32),
        numbers.astype(np.int32),
        positions.reshape(cells.shape).astype(np.int32),
    )


def _elements(name: object, given: object, number_of_elements: int) -> Integers:
    """Numbers of a region's elements (k,), each once, read-only; ``SolverError`` otherwise."""
    if not isinstance(name, str) or name == REST:
        raise SolverError(f"mesh: the name of a region must be a text, got {shown(name)}.")
    elements = _whole_numbers(name, given)  # as wide as given: 2^32 must not become 0
    if not len(elements):
        raise SolverError(f"mesh: the region {name!r} has no elements.")
    if not 0 <= elements.min() <= elements.max() < number_of_elements:
        wrong = elements.max() if elements.min() >= 0 else elements.min()
        raise SolverError(
            f"mesh: the region {name!r} names element {wrong}, but the elements are numbered 0 to "
            f"{number_of_elements - 1}."
        )
    numbers, counts = np.unique(elements, return_counts=True)
    if counts.max() > 1:
        raise SolverError(
            f"mesh: the region {name!r} names element {numbers[counts.argmax()]} twice."
        )
    kept: NDArray[np.int32] = np.array(elements, dtype=np.int32)
    kept.flags.writeable = False
    return kept


def _whole_numbers(name: str, given: object) -> NDArray[np.integer]:
    """An array (k,) of whole numbers; ``SolverError`` for anything else."""
    try:
        array = np.asarray(given)
    except ValueError:
        array = np.zeros((0, 0))
    empty = array.shape == (0,)
    if array.ndim != 1 or not (empty or array.dtype.kind in "iu"):
        raise SolverError(
            f"mesh: the region {name!r} must be numbers of elements (k,), got {shown(given)}."
        )
    return array.astype(np.int64) if empty else array
