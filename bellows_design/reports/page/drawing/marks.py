"""What a drawing is made of. Coordinates are pixels, x to the right and y down."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Point = tuple[float, float]

Anchor = Literal["start", "middle", "end"]

TEXT_HEIGHT = 12.0
"""px, from line to line."""

CHARACTER = 6.3
"""px, as wide as a character of a label is taken to be: a little more than it is on the mean."""


@dataclass(frozen=True)
class Area:
    """The inside of closed ``loops``, of which inner ones are holes (even-odd)."""

    loops: tuple[tuple[Point, ...], ...]
    kind: str = "material"


@dataclass(frozen=True)
class Line:
    """A line through ``points``; ``strength`` from 0 to 1 is how opaque it is."""

    points: tuple[Point, ...]
    kind: str = "edge"
    strength: float = 1.0


@dataclass(frozen=True)
class Dot:
    """A round mark of ``radius``."""

    centre: Point
    radius: float = 3.0
    kind: str = "dot"


@dataclass(frozen=True)
class Text:
    """A line of text; ``turned`` reads from below to above."""

    place: Point
    text: str
    anchor: Anchor = "middle"
    turned: bool = False
    kind: str = "label"

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom of the room that it takes."""
        x, y = self.place
        length = CHARACTER * len(self.text)
        before = {"start": 0.0, "middle": length / 2, "end": length}[self.anchor]
        if self.turned:
            low = y + before
            return x - 0.8 * TEXT_HEIGHT, low - length, x + 0.2 * TEXT_HEIGHT, low
        return x - before, y - 0.8 * TEXT_HEIGHT, x - before + length, y + 0.2 * TEXT_HEIGHT


Mark = Area | Line | Dot | Text


@dataclass(frozen=True)
class Drawing:
    """Marks on a sheet of ``width`` × ``height``, later ones above; ``title`` says what it shows.

    ``clip``: left, top, right and bottom of what is shown of areas of the kind ``material``.
    """

    width: float
    height: float
    marks: tuple[Mark, ...]
    title: str
    clip: tuple[float, float, float, float] | None = None

    @property
    def texts(self) -> tuple[Text, ...]:
        """All labels."""
        return tuple(each for each in self.marks if isinstance(each, Text))
