"""The same bubbles, more or fewer of them: a unit cell does not know how many there are."""

from __future__ import annotations

from dataclasses import replace

from bellows_design.analysis.models import FEWEST_BUBBLES, UNIT_CELL
from bellows_design.design.design import Design
from bellows_design.neighbours.record import NeighbourEvaluation


def of_count(design: Design, count: int) -> Design:
    """``design`` with so many bubbles, and a length that has room for them; root and tip stay."""
    bellows = design.bellows
    if bellows.bubble_count == count:
        return design
    tip = bellows.length - bellows.root_length - bellows.train_length
    train = count * bellows.pitch - bellows.bubble_distance
    numbers = bellows.model_dump() | {
        "number_of_bubbles": count,
        "length": max(bellows.root_length + train + tip, LEAST_LENGTH),
        "offset": bellows.root_length,
    }
    return design.model_copy(update={"bellows": type(bellows).model_validate(numbers)})


LEAST_LENGTH = 10.0
"""mm. Bound of ``BellowsParameters.length``; a longer stub at the tip changes nothing."""


def counts_alike(design: Design, count: int) -> bool:
    """Whether actuators with the design's and with that number of bubbles have cells that do."""
    return min(design.bellows.bubble_count, count) >= FEWEST_BUBBLES


def with_bubbles(found: NeighbourEvaluation, design: Design) -> NeighbourEvaluation:
    """What was found for ``design`` with another number of bubbles, for its own number.

    Every bubble more turns by as much as the others and holds as much; ends and stresses stay. The
    error of the angle grows with the angle; that of the cell does, that of the ends less.
    """
    more = design.bellows.bubble_count - found.design.bellows.bubble_count
    cell = found.solution.path[-1]
    return replace(
        found,
        design=design,
        bending_angle_deg=found.bending_angle_deg + more * 2 * cell.rotation,
        cavity_volume_mm3=found.cavity_volume_mm3 + more * UNIT_CELL.share * cell.volume,
    )
