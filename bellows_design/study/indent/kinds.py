"""The kinds of indent there are, and the room that each has in a design."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.lengths import SMALLEST_FEATURE

SHALLOWEST, NARROWEST = 0.1, SMALLEST_FEATURE
"""mm. One layer, one line."""

SHARPEST = 0.1
"""mm. Stress beside sharper edges of an outside indent would not count, and flatter it."""


@dataclass(frozen=True)
class Kind:
    """Side and shape of an indent."""

    side: Literal["outside", "inside"]
    shape: Literal["arc", "rectangular"]

    @property
    def name(self) -> str:
        """In words."""
        return f"{self.shape}, {self.side}"

    def bounds(self, bellows: BellowsParameters) -> dict[str, tuple[float, float]]:
        """Least and greatest depth and width, mm, that leave a line of wall and keep its walls."""
        wall = bellows.bubble_thickness
        inside = self.side == "inside"
        bottom = wall if inside else min(wall, bellows.tendon_thickness)
        widest = bellows.chamber_length if inside else bellows.bubble_length
        return {
            "depth": (SHALLOWEST, bottom - SMALLEST_FEATURE),
            "width": (NARROWEST, widest),
        }

    def indent(self, bellows: BellowsParameters, place: Sequence[float]) -> Indent:
        """The one at a place of the unit cube: depth, width and fillet as fractions of their room.

        The deepest arc of its width is half as deep; a fillet ends where the profile is round.
        """
        bounds = self.bounds(bellows)
        width = _within(*bounds["width"], place[1])
        shallowest, deepest = bounds["depth"]
        depth = _within(shallowest, min(deepest, width / 2) if self._is_arc else deepest, place[0])
        most = self.most_fillet(depth, width)
        fillet = 0.0 if self._is_arc else _within(min(SHARPEST, most), most, place[2])
        return Indent(side=self.side, shape=self.shape, depth=depth, width=width, fillet=fillet)

    def most_fillet(self, depth: float, width: float) -> float:
        """Largest radius in the corners of a rectangular indent, mm."""
        return width / 2 if self.side == "inside" else min(depth, width / 2)

    @property
    def _is_arc(self) -> bool:
        return self.shape == "arc"


KINDS = (Kind("outside", "rectangular"), Kind("outside", "arc"), Kind("inside", "rectangular"))
"""All that a design may have."""


def kind_of(indent: Indent) -> Kind:
    """Side and shape of an indent."""
    return Kind(indent.side, indent.shape)


def with_indent(design: Design, indent: Indent | None) -> Design:
    """``design`` with another indent, or none. Raises ``DesignError`` if it does not fit."""
    return Design.of(design.model_dump() | {"indent": indent and indent.model_dump()})


def spread(kind: Kind, bellows: BellowsParameters, number: int) -> Iterator[Indent]:
    """So many indents of a kind, spread evenly over its room (a Halton sequence); none without."""
    from scipy.stats.qmc import Halton

    if any(least > most for least, most in kind.bounds(bellows).values()):
        return iter(())
    places = Halton(d=3, scramble=False).random(number + 1)[1:]
    return (kind.indent(bellows, place) for place in places)


def numbers(indent: Indent | None) -> Mapping[str, object] | None:
    """Its fields as plain values; None of none."""
    return None if indent is None else indent.model_dump()


def _within(least: float, most: float, share: float) -> float:
    """The length so far from least to most, mm."""
    return least + float(share) * (most - least)
