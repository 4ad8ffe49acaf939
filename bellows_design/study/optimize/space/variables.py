"""The continuous variables of a choice: their bounds, the design they make, and derivatives.

Walls are whole lines. The outer fillet is the inner one and the wall, so that the wall goes around
corners as thick as it is; fillets are fractions of what they round.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.study.optimize.space.choices import (
    LONGEST_CHAMBER,
    SHORTEST_CHAMBER,
    Bounds,
    Choice,
    room,
)
from printers import PrinterProfile
from solver.arrays import Reals

LEAST_ROUND, MOST_ROUND = 0.2, 0.92
"""Fractions of half of the chamber's length that an inner fillet may be short of a full round."""

INDENT_FILLET = 0.75
"""Fillet of an indent, as a fraction of its depth."""

MOST_BUBBLES = 100
"""That a design may have."""

SMALLEST_SHARE = 0.5
"""Of the room across that a bubble takes at least."""


@dataclass(frozen=True)
class Variables:
    """The variables of one choice, as vectors in the order of ``names``."""

    base: Design
    choice: Choice
    bounds: Bounds = field(default_factory=Bounds)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Those of the lengths they are, mm; ``inner_round`` is a fraction."""
        rounds = () if self.choice.full_round else ("inner_round",)
        indent = ("indent.width",) if self.choice.indent_layers else ()
        return (*_LENGTHS, *rounds, *indent)

    @cached_property
    def profile(self) -> PrinterProfile:
        """The base's printer, whose file is read once."""
        return self.base.profile()

    @cached_property
    def bubble_wall(self) -> float:
        """mm."""
        return self.choice.bubble_lines * self.profile.line_width

    @cached_property
    def tendon_wall(self) -> float:
        """mm."""
        return self.choice.tendon_lines * self.profile.line_width

    @cached_property
    def lower(self) -> Reals:
        """Least values."""
        return np.array([self._ranges[name][0] for name in self.names])

    @cached_property
    def upper(self) -> Reals:
        """Largest values."""
        return np.array([self._ranges[name][1] for name in self.names])

    @property
    def possible(self) -> bool:
        """Whether there is room for the least values."""
        return bool(
            np.all(self.lower <= self.upper)
            and self.tendon_wall <= self.base.bellows.offset + 1e-9
            and self.choice.bubbles <= MOST_BUBBLES
        )

    @cached_property
    def _ranges(self) -> dict[str, tuple[float, float]]:
        profile, limits = self.profile, self.base.limits
        gap = self.bounds.least_gap(profile)
        channel = self.bounds.least_passage(profile) + 2 * self.tendon_wall
        # The channel opens into the chamber above the thicker one of both floors.
        opening = channel + max(0.0, self.bubble_wall - self.tendon_wall)
        width = min(limits.cross_section_width, 200.0)
        height = min(limits.cross_section_height, 200.0)
        return {
            "chamber_length": (SHORTEST_CHAMBER, LONGEST_CHAMBER),
            "bubble_distance": (gap, max(gap, LONGEST_CHAMBER)),
            "tendon_width": (channel, width),
            "tendon_height": (opening, height - self.bubble_wall),
            "bubble_width": (SMALLEST_SHARE * width, width),
            "bubble_height": (SMALLEST_SHARE * height, height),
            "inner_round": (LEAST_ROUND, MOST_ROUND),
            "indent.width": (2 * profile.line_width, LONGEST_CHAMBER),
        }

    def design(self, values: Reals) -> Design:
        """The design of these values. Raises ``DesignError`` if they make none."""
        lengths = dict(zip(self.names, map(float, values), strict=True))
        table = self.base.model_dump()
        wall, fillet = self.bubble_wall, self._inner_fillet(lengths)
        table["bellows"] |= {name: lengths[name] for name in _LENGTHS} | {
            "bubble_thickness": wall,
            "tendon_thickness": self.tendon_wall,
            "inner_fillet": fillet,
            "outer_fillet": round(fillet + wall, 9),
            "number_of_bubbles": self.choice.bubbles,
        }
        table["indent"] = self._indent(lengths)
        return Design.of(table)

    def values(self, design: Design) -> Reals:
        """Those nearest to a design, within the bounds and the room along the length."""
        p, width = design.bellows, 2.0 * self.bubble_wall
        if design.indent is not None:
            width = design.indent.width
        found = {name: getattr(p, name) for name in _LENGTHS}
        found |= {"inner_round": 2 * p.inner_fillet / p.chamber_length, "indent.width": width}
        values = np.array([found[name] for name in self.names])
        return self.within_room(np.clip(values, self.lower, self.upper))

    def rounded(self, values: Reals) -> Reals:
        """The values with lengths of whole micrometres, those along the actuator rounded down."""
        found = dict(zip(self.names, values, strict=True))
        for name in self.names:
            down = name in ("chamber_length", "bubble_distance", "indent.width")
            if name != "inner_round":
                found[name] = _floor(found[name]) if down else round(float(found[name]), 3)
        if "inner_round" in found:
            half = found["chamber_length"] / 2
            found["inner_round"] = round(float(found["inner_round"] * half), 3) / half
        return np.array([found[name] for name in self.names])

    def within_room(self, values: Reals) -> Reals:
        """The values with chambers and gaps shortened alike until the bubbles fit.

        An indent is no wider than its bubble is long.
        """
        values = values.copy()
        excess = self.train_excess(values)
        spare = (values - self.lower) * self.train_gradient
        if excess > 0 and spare.sum() > 0:
            share = min(1.0, excess / spare.sum())
            values -= (values - self.lower) * (self.train_gradient > 0) * share
        if self.choice.indent_layers:
            place = self.names.index("indent.width")
            chamber = values[self.names.index("chamber_length")]
            values[place] = min(values[place], chamber + 2 * self.bubble_wall)
        return values

    def train_excess(self, values: Reals) -> float:
        """What bubbles and gaps take beyond the room there is, mm."""
        count = self.choice.bubbles
        walls = 2 * count * self.bubble_wall
        return float(self.train_gradient @ values) + walls - room(self.base)

    @cached_property
    def train_gradient(self) -> Reals:
        """Derivative of the train's length by the variables."""
        count = self.choice.bubbles
        parts = {"chamber_length": count, "bubble_distance": count - 1}
        return np.array([float(parts.get(name, 0)) for name in self.names])

    def gradient(self, values: Reals, derivatives: Mapping[str, float]) -> Reals:
        """Derivatives by the variables, of those by the design's lengths (per mm)."""
        lengths = dict(zip(self.names, map(float, values), strict=True))
        fillets = derivatives.get("inner_fillet", 0.0) + derivatives.get("outer_fillet", 0.0)
        found = {name: derivatives.get(name, 0.0) for name in self.names}
        if not self.choice.full_round:  # full rounds follow in the derivatives already
            found["chamber_length"] += fillets * lengths["inner_round"] / 2
            found["inner_round"] = fillets * lengths["chamber_length"] / 2
        return np.array([found[name] for name in self.names])

    def exists(self, values: Reals) -> str:
        """Why there is no such design; '' if there is."""
        if self.train_excess(values) > 1e-6:
            return "the bubbles do not fit into the length"
        try:
            self.design(values)
        except DesignError as error:
            return str(error)
        return ""

    def _inner_fillet(self, lengths: Mapping[str, float]) -> float:
        share = 1.0 if self.choice.full_round else lengths["inner_round"]
        return round(share * lengths["chamber_length"] / 2, 9)

    def _indent(self, lengths: Mapping[str, float]) -> dict[str, object] | None:
        if not self.choice.indent_layers:
            return None
        depth = round(self.choice.indent_layers * self.profile.layer_height, 6)
        return {
            "side": "outside",
            "shape": "rectangular",
            "depth": depth,
            "width": lengths["indent.width"],
            "fillet": INDENT_FILLET * depth,
        }


def _floor(length: float) -> float:
    """Down to a whole micrometre; a hair below one counts as that."""
    return math.floor(1000 * length + 1e-6) / 1000


_LENGTHS = (
    "chamber_length",
    "bubble_distance",
    "tendon_width",
    "tendon_height",
    "bubble_width",
    "bubble_height",
)
assert set(_LENGTHS) <= set(BellowsParameters.model_fields)
