"""What may come out otherwise than designed: walls, heights, constants of the material.

Of an extruder that lays too much, every line is wider: a standing wall grows by half of it on
either side. So the wall is thicker by the tolerance, the outer width larger and the chamber
shorter by it, the gap to the next bubble narrower; fillets outside grow by half of it, those inside
shrink by half. Lines stay where they are, so that neither their number nor the pitch changes.
Heights are those of the layers: they stay, and floor and roof, of which a design says no more than
that they are as thick as the walls, grow inwards.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from bellows_design.design.design import Design
from bellows_design.design.variation import parameters
from bellows_design.errors import DesignError

Source = Literal["print", "material"]
Direction = Mapping[str, float]
"""By how much each parameter changes, mm or MPa."""


@dataclass(frozen=True)
class Tolerances:
    """How far things may come out from what was designed.

    ``wall`` of every wall, mm; ``layers`` of every height; ``modulus_percent`` of every constant.
    Raises ``DesignError`` if one is out of bounds.
    """

    wall: float = 0.05
    modulus_percent: float = 10.0
    layers: float = 0.5

    def __post_init__(self) -> None:
        for option, value, most, unit in (
            ("wall", self.wall, 1.0, "mm"),
            ("modulus", self.modulus_percent, 50.0, "%"),
            ("layers", self.layers, 5.0, "layers"),
        ):
            if not 0 <= value <= most:
                raise DesignError(
                    f"{option} is {value:g} {unit} but must lie from 0 to {most:g} {unit}."
                )


@dataclass(frozen=True)
class Cause:
    """Something that may come out otherwise, to either side.

    Attributes:
        label: What, and by how much.
        source: Whether the print or the material is its source.
        direction: Changes of parameters at the upper end.
        part_of: The cause that this one is a part of; empty for one that stands by itself.
        parts: Whether others are parts of it.
    """

    label: str
    source: Source
    direction: Direction
    part_of: str = ""
    parts: bool = False


def causes(design: Design, tolerances: Tolerances) -> tuple[Cause, ...]:
    """All of them, walls first.

    Raises ``PrintersError`` if there is no profile of the design's printer.
    """
    return (
        *_walls(design, tolerances.wall),
        *_heights(design, tolerances.layers * design.profile().layer_height),
        *_constants(design, tolerances.modulus_percent),
    )


def _walls(design: Design, wall: float) -> Iterator[Cause]:
    """All walls together, and then each alone; what is alone adds up to all together."""
    alone: dict[str, Callable[[Design], Direction]] = {
        "bubble walls": _bubble,
        "tendon walls": _tendon,
    }
    if design.indent is not None:
        alone["wall at the indent"] = _remaining
    known = parameters(design)
    directions = {
        label: {n: wall * share for n, share in part(design).items() if n in known}
        for label, part in alone.items()
    }
    together = f"all walls ± {wall:g} mm"
    yield Cause(together, "print", _sum(directions.values()), parts=True)
    for label, direction in directions.items():
        yield Cause(f"{label} ± {wall:g} mm", "print", direction, part_of=together)


def _bubble(design: Design) -> Direction:
    """By thickness; an indent is so much deeper that the wall it leaves stays."""
    changes = {
        "bubble_thickness": 1.0,
        "bubble_width": 1.0,
        "chamber_length": -1.0,
        "bubble_distance": -1.0,
        "inner_fillet": -0.5,
        "outer_fillet": 0.5,
    }
    return changes if _tendon_is_indented(design) else changes | {"indent.depth": 1.0}


def _tendon(design: Design) -> Direction:
    changes = {"tendon_thickness": 1.0, "tendon_width": 1.0}
    return changes | {"indent.depth": 1.0} if _tendon_is_indented(design) else changes


def _remaining(_: Design) -> Direction:
    """The groove is shallower and, its sides being faces of walls too, narrower."""
    return {"indent.depth": -1.0, "indent.width": -1.0}


def _tendon_is_indented(design: Design) -> bool:
    """Whether the tendon's floor is what an indent leaves least of."""
    bellows = design.bellows
    outside = design.indent is not None and design.indent.side == "outside"
    return outside and bellows.tendon_thickness < bellows.bubble_thickness


def _heights(design: Design, height: float) -> Iterator[Cause]:
    for name in ("bubble_height", "tendon_height"):
        label = name.replace("_", " ")
        yield Cause(f"{label} ± {height:g} mm", "print", {name: height})


def _constants(design: Design, percent: float) -> Iterator[Cause]:
    for name, value in parameters(design).items():
        if name.startswith("material."):
            label = f"{name.removeprefix('material.')} ± {percent:g} %"
            yield Cause(label, "material", {name: abs(value) * percent / 100})


def _sum(directions: Iterable[Direction]) -> Direction:
    """Without what cancels out."""
    total: Counter[str] = Counter()
    for direction in directions:
        total.update(direction)
    return {name: value for name, value in total.items() if value}
