"""Which designs may be reached from a point without another evaluation by itself.

All of it follows from the numbers alone: the room along the length, the faces of the body, the
distance up to which a neighbour is looked for, and the port.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.design.design import Design
from bellows_design.design.lengths import FULL_ROUND_SNAP, SMALLEST_FEATURE
from bellows_design.design.topology import same_topology, signature
from bellows_design.errors import DesignError
from bellows_design.neighbours.distance import distance
from bellows_design.study.optimize.point import Point
from bellows_design.study.optimize.space.variables import Variables
from solver.arrays import Reals

CELL = "unit-cell"
"""The model of actuators of three bubbles and more."""

CLEARANCE = 1.2 * FULL_ROUND_SNAP
"""mm. So far designs stay from those with other faces: a fillet becomes a full round when it is
nearly one."""

CHANNEL_FLATS = (
    "flat between the channel's fillets along y",
    "flat between the channel's fillets along z",
)
"""Lengths that are 0 of all channels whose fillet has no room: what it lacks tells more."""

SEARCH_REACH = 0.35
"""Distance that a neighbour may have in a search. It is more than elsewhere: what is found there is
evaluated by itself before the search goes on."""

SPARE_REACH = 0.95
"""Fraction of that distance that is used."""

BOTH_SIDES = (1e-4, -1e-4)
"""Steps of difference quotients by the logarithms of the variables."""


@dataclass(frozen=True)
class Allowed:
    """Lengths that must not become negative, around an evaluated point.

    ``anchor`` is the design whose mesh is moved.
    """

    variables: Variables
    anchor: Design

    def margins(self, values: Reals) -> dict[str, float]:
        """Each must be 0 or more, mm; of the distance, a fraction. Raises ``DesignError``."""
        design = self.variables.design(values)
        found = {"room": -self.variables.train_excess(values)}
        found["distance"] = SPARE_REACH * SEARCH_REACH - distance(self.anchor, design)
        found["port"] = design.port.hole_radius(design.bellows) - SMALLEST_FEATURE / 2
        found |= self.faces(design)
        return found

    def linearised(self, at: Point) -> dict[str, tuple[float, Reals]]:
        """Margins at a point and their derivatives by the logarithms of the variables."""
        here = self.margins(at.variables)
        slopes = {name: np.zeros(len(at.variables)) for name in here}
        for index in range(len(at.variables)):
            beside = [(step, self._beside(at, index, step)) for step in BOTH_SIDES]
            for name, value in here.items():
                found = [(there[name] - value) / step for step, there in beside if name in there]
                slopes[name][index] = np.mean(found) if found else 0.0
        return {name: (value, slopes[name]) for name, value in here.items()}

    def refused(self, values: Reals) -> str:
        """Why a design cannot be reached; '' if it can."""
        if reason := self.variables.exists(values):
            return reason
        design = self.variables.design(values)
        if distance(self.anchor, design) > SEARCH_REACH:
            return "it is too far away"
        return same_topology(self.anchor, design, CELL)

    def faces(self, design: Design) -> dict[str, float]:
        """How far each length that tells faces is from changing its sign, mm; zeros stay zero."""
        before, after = _lengths(self.anchor), _lengths(design)
        return {
            name: float(np.sign(length)) * after[name] - min(CLEARANCE, abs(length))
            for name, length in before.items()
            if abs(length) > 1e-9 and name in after
        }

    def _beside(self, at: Point, index: int, step: float) -> dict[str, float]:
        """Margins beside a point; none where there is no design."""
        moved = at.variables.copy()
        moved[index] *= np.exp(step)
        try:
            return self.margins(moved)
        except DesignError:
            return {}


def _lengths(design: Design) -> dict[str, float]:
    """Lengths whose signs tell the faces, those of the channel's flats also below 0."""
    p = design.bellows
    rooms = (p.channel_width / 2 - p.chamber_fillet, p.channel_height / 2 - p.chamber_fillet)
    return signature(design, CELL) | dict(zip(CHANNEL_FLATS, rooms, strict=True))
