"""A box around a design: some of its parameters, each within the same percentage of its value.

Coordinates run from -1 to 1 along each side; the design is in the middle.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.design.design import Design
from bellows_design.design.variation import parameters, same_topology, varied
from bellows_design.errors import DesignError
from bellows_design.neighbours.carried import REACH
from bellows_design.neighbours.distance import distance
from solver.arrays import Reals

BLOCK = 64
"""Points of the sequence that are drawn at once; a power of two keeps it balanced."""

LEAST_ADMISSIBLE = 0.25
"""Share of the points that must be designs of the same faces, or the box is narrowed."""

NARROWER, NARROWEST = 0.8, 0.5
"""Factor by which a box is narrowed, and the percentage below which it is given up."""

WITHIN = 0.98
"""Of the reach, about as far as points beyond it are drawn in."""


@dataclass(frozen=True)
class Box:
    """Parameters ``names`` of a design whose number of bubbles is given, within ``percent``."""

    design: Design
    names: tuple[str, ...]
    percent: float
    model: str = "full"

    @property
    def half_sides(self) -> Reals:
        """(names,) mm and MPa: from the middle to where a coordinate is 1."""
        values = parameters(self.design)
        return np.array([values[name] * self.percent / 100 for name in self.names])

    def at(self, point: Reals) -> Design | None:
        """The design at a point, (names,); None where there is none of the same faces."""
        values, steps = parameters(self.design), self.half_sides * point
        changes = {n: values[n] + float(s) for n, s in zip(self.names, steps, strict=True)}
        try:
            found = varied(self.design, changes)
        except DesignError:
            return None
        return None if same_topology(self.design, found, self.model) else found


@dataclass(frozen=True)
class Sample:
    """Points of a box, (points, names), in an order in which neighbours follow each other.

    Attributes:
        box: The box; narrower than the one asked for where few designs in that had the same faces.
        points: Coordinates, from -1 to 1.
        designs: One for each point.
        drawn_in: How many lay farther from the middle than neighbours reach, and were drawn in.
        redrawn: How many were no designs, or had other faces, and were replaced.
    """

    box: Box
    points: Reals
    designs: tuple[Design, ...]
    drawn_in: int
    redrawn: int


def sampled(box: Box, count: int, seed: int) -> Sample:
    """So many points of a box, by a scrambled Sobol' sequence.

    Raises ``DesignError`` if hardly any point of it is a design of the same faces.
    """
    while box.percent >= NARROWEST:
        found = _admissible(box, count, seed)
        if found is not None:
            return found
        box = replace(box, percent=NARROWER * box.percent)
    raise DesignError(
        f"range: around {box.design.name} hardly any design within {NARROWEST:g} % of its numbers "
        "has the same faces."
    )


def tour(points: Reals) -> list[int]:
    """An order of points, (points, names): from the middle always on to the nearest one left."""
    left, here, order = list(range(len(points))), np.zeros(points.shape[1]), []
    while left:
        order.append(min(left, key=lambda i: float(np.linalg.norm(points[i] - here))))
        left.remove(order[-1])
        here = points[order[-1]]
    return order


def _admissible(box: Box, count: int, seed: int) -> Sample | None:
    """The sample, unless too few of the points drawn are admissible."""
    kept: list[tuple[Reals, Design, bool]] = []
    drawn = 0
    for point in _sequence(len(box.names), seed):
        drawn += 1
        inside = _within_reach(box, point)
        design = box.at(inside)
        if design is not None:
            kept.append((inside, design, inside is not point))
        if len(kept) == count:
            break
        if drawn >= BLOCK and len(kept) < LEAST_ADMISSIBLE * drawn:
            return None
    points = np.array([each[0] for each in kept])
    order = tour(points)
    designs = tuple(kept[i][1] for i in order)
    drawn_in = sum(each[2] for each in kept)
    return Sample(box, points[order], designs, drawn_in, drawn - count)


def _sequence(dimension: int, seed: int) -> Iterator[Reals]:
    from scipy.stats.qmc import Sobol

    engine = Sobol(dimension, seed=seed)
    while True:
        yield from 2 * engine.random(BLOCK) - 1


def _within_reach(box: Box, point: Reals) -> Reals:
    """The point, or one nearer to the middle that is within the reach of neighbours."""
    while (apart := _distance(box, point)) > REACH:
        point = point * (WITHIN * REACH / apart)
    return point


def _distance(box: Box, point: Reals) -> float:
    """From the middle; 0 where there is no design."""
    design = box.at(point)
    return 0.0 if design is None else distance(box.design, design)
