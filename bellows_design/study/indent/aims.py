"""What an indent is searched for, as a number that is to be small."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.study.changes import Changes, change
from bellows_design.study.indent.kinds import SHALLOWEST
from bellows_design.study.paper import TABLE_4

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.design.indent import Indent

LOSS_WEIGHT = 10.0
"""Of the square of a lost angle (%) against a point of stress: a tenth of a percent costs 0.1."""


@dataclass(frozen=True)
class Aim:
    """Something to search for.

    Attributes:
        name: In words.
        value: Of the changes against the design without indent; the search makes it small.
        slope: Its derivatives by the change of angle and by that of stress.
        printable: Whether the indent must be of whole layers and leave enough of them.
    """

    name: str
    value: Callable[[Changes], float]
    slope: Callable[[Changes], tuple[float, float]]
    printable: bool = False


def as_in_the_paper() -> Changes:
    """What the paper's indent changed against its Prototype 2, %."""
    plain, indented = TABLE_4[-2:]
    return Changes(
        change(indented.bending_angle_deg, plain.bending_angle_deg),
        change(indented.max_stress_mpa, plain.max_stress_mpa),
    )


def like(target: Changes) -> Aim:
    """The indent whose changes come nearest to ``target``."""

    def slope(found: Changes) -> tuple[float, float]:
        apart = max(found.apart(target), 1e-9)
        return (
            (found.bending_angle_percent - target.bending_angle_percent) / apart,
            (found.max_von_mises_percent - target.max_von_mises_percent) / apart,
        )

    return Aim("nearest to the paper's", lambda found: found.apart(target), slope)


def _lost(found: Changes) -> float:
    return max(0.0, -found.bending_angle_percent)


LEAST_STRESS = Aim(
    "least stress at no loss of angle, printable",
    lambda found: found.max_von_mises_percent + LOSS_WEIGHT * _lost(found) ** 2,
    lambda found: (-2 * LOSS_WEIGHT * _lost(found), 1.0),
    printable=True,
)


def deepest_printed(design: Design, outside: bool) -> float:
    """Greatest depth, mm, that leaves as many layers as the design's printer needs to seal."""
    bellows, printer = design.bellows, design.profile()
    wall = bellows.bubble_thickness
    wall = min(wall, bellows.tendon_thickness) if outside else wall
    return wall - printer.minimum_solid_layers * printer.layer_height


def of_whole_layers(design: Design, indent: Indent) -> Indent | None:
    """The same with the nearest depth of whole layers that leaves enough of them.

    None if there is no such depth, or its arc would be deeper than half of its width.
    """
    layer = design.profile().layer_height
    widest = indent.width / 2 if indent.shape == "arc" else math.inf
    most = min(deepest_printed(design, indent.side == "outside"), widest)
    fewest, greatest = math.ceil(SHALLOWEST / layer - 1e-9), math.floor(most / layer + 1e-9)
    layers = min(max(fewest, round(indent.depth / layer)), greatest)
    if layers < fewest:
        return None
    depth = min(round(layers * layer, 9), widest)
    rounded = indent.model_dump() | {"depth": depth}
    if indent.side == "outside" and indent.shape == "rectangular":
        rounded["fillet"] = min(indent.fillet, depth)
    return type(indent).model_validate(rounded)
