"""Dimensions of a view, in mm of its plane: what is measured, between which points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Side = Literal["above", "below", "left", "right"]
Place = tuple[float, float]
"""Across and up, mm."""


@dataclass(frozen=True)
class Dimension:
    """A length between two points of the part, drawn on one side of the view.

    ``name`` and ``value`` (mm) are the parameter's; ``start`` and ``end`` the points that it lies
    between, of which the dimension shows the distance across (above, below) or up (left, right).
    """

    name: str
    value: float
    start: Place
    end: Place
    side: Side
    note: str = ""

    @property
    def label(self) -> str:
        """Name and value."""
        return f"{self.name} {self.value:g}{self.note}"

    @property
    def measured(self) -> float:
        """The length that is drawn, mm."""
        axis = 0 if self.side in ("above", "below") else 1
        return abs(self.end[axis] - self.start[axis])


@dataclass(frozen=True)
class Callout:
    """A parameter at a point of the part, such as a radius, with a leader to its label."""

    name: str
    value: float
    at: Place
    sign: str = "R "

    @property
    def label(self) -> str:
        """Name and value."""
        return f"{self.name} {self.sign}{self.value:g}"


@dataclass(frozen=True)
class View:
    """A section with its dimensions; ``across`` is the range that is shown of a longer part, mm."""

    title: str
    loops: tuple[tuple[Place, ...], ...]
    dimensions: tuple[Dimension, ...]
    callouts: tuple[Callout, ...] = ()
    across: tuple[float, float] | None = None
    frame: tuple[float, float, float, float] | None = None
    """Left, bottom, right and top of a dashed frame, mm: the room that the part may take."""
    behind: tuple[tuple[Place, ...], ...] = ()
    """What lies behind the section, as thin lines."""
