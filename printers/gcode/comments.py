"""What slicers say in comments on the beads that follow: their kind, width and height, layers."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.gcode.beads import (
    BRIDGE,
    EXTERNAL_PERIMETER,
    GAP_FILL,
    INFILL,
    OTHER,
    PERIMETER,
    SKIRT,
    SOLID_INFILL,
    SUPPORT,
)
from printers.gcode.facts import Facts
from printers.gcode.words import COMMENT, Lines

FEATURES = {
    EXTERNAL_PERIMETER: "external perimeter, outer wall, wall-outer, thin wall, outer perimeter",
    PERIMETER: "perimeter, internal perimeter, inner wall, wall-inner, overhang perimeter, "
    "overhang wall, inner perimeter",
    INFILL: "internal infill, infill, sparse infill, fill",
    SOLID_INFILL: "solid infill, top solid infill, internal solid infill, top surface, "
    "bottom surface, skin, solid-fill",
    BRIDGE: "bridge infill, internal bridge infill, bridge, internal bridge",
    GAP_FILL: "gap fill, gap infill, gap-fill",
    SUPPORT: "support material, support material interface, support, support interface, "
    "support transition, support-interface, raft",
    SKIRT: "skirt, skirt/brim, brim, custom, wipe tower, prime tower, prime-tower, purge, flush",
    OTHER: "ironing, mixed, multiple, undefined, none, unknown",
}
"""What PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura call each kind."""

KINDS = {name: kind for kind, names in FEATURES.items() for name in names.split(", ")}

MOST_COMMENTS = 1_000_000
"""Lines; they take some seconds. The shipped finger has 38 000."""

MOST_UNKNOWN = 20
"""Names of features that are kept to be told."""

_STATED = re.compile(rb" ?([A-Za-z_]+):? ?([^\r\n]*)")
_MEANINGS = {
    b"TYPE": "kind",
    b"FEATURE": "kind",
    b"WIDTH": "width",
    b"LINE_WIDTH": "width",
    b"HEIGHT": "height",
    b"LAYER_HEIGHT": "height",
    b"LAYER_CHANGE": "layer",
    b"CHANGE_LAYER": "layer",
    b"LAYER": "layer",
}


@dataclass(eq=False)
class Statements:
    """Values of one thing, each from the line on that states it."""

    lines: list[int] = field(default_factory=list)
    values: list[float] = field(default_factory=list)

    def at(self, lines: Ints, otherwise: float) -> Floats:
        """(n,) what is stated last before each of the lines."""
        which = np.searchsorted(np.array(self.lines, dtype=np.int64), lines)
        return np.array([otherwise, *self.values])[which]


@dataclass(eq=False)
class Comments:
    """What the comments of a file say, collected piece by piece."""

    kind: Statements = field(default_factory=Statements)
    width: Statements = field(default_factory=Statements)
    height: Statements = field(default_factory=Statements)
    layer: Statements = field(default_factory=Statements)
    facts: Facts = field(default_factory=Facts)
    unknown_features: set[str] = field(default_factory=set)
    count: int = 0

    def collect(self, piece: bytes, lines: Lines) -> None:
        """Take in the comments of the piece that the lines were read from.

        Raises:
            PrintersError: There are too many.
        """
        chosen = lines.command == COMMENT
        self.count += int(chosen.sum())
        if self.count > MOST_COMMENTS:
            raise PrintersError(f"it has more than {MOST_COMMENTS} lines of comments")
        numbers = lines.number[chosen].tolist()
        for number, (start, end) in zip(numbers, lines.comment[chosen].tolist(), strict=True):
            comment = piece[start:end]
            stated = _STATED.fullmatch(comment)
            meaning = _MEANINGS.get(stated[1]) if stated else None
            if stated is None or meaning is None or not self._state(meaning, number, stated[2]):
                self.facts.take(comment)

    def _state(self, meaning: str, number: int, text: bytes) -> bool:
        """Whether the text is understood as what the word before it means."""
        value = self._kind(text) if meaning == "kind" else _number(text, meaning)
        if value is None:
            return False
        statements: Statements = getattr(self, meaning)
        statements.lines.append(number)
        statements.values.append(value)
        return True

    def _kind(self, text: bytes) -> float:
        name = text.decode("ascii", "replace").strip().lower()
        if name not in KINDS and len(self.unknown_features) < MOST_UNKNOWN:
            self.unknown_features.add(name[:60])
        return KINDS.get(name, OTHER)


def _number(text: bytes, meaning: str) -> float | None:
    if meaning == "layer":
        return 1.0
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) and 0 < value < 100 else None
