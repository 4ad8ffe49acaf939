"""What is counted and not measured: lines of the walls, bubbles, layers of the indent, full rounds.

There are a few dozen combinations. Each has variables of its own, which are continuous.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

from bellows_design.design.design import Design
from printers import PrinterProfile


@dataclass(frozen=True, order=True)
class Choice:
    """One combination.

    Attributes:
        bubbles: Number of bubbles.
        bubble_lines: Lines in the wall of a bubble.
        tendon_lines: Lines in the wall of the tendon.
        indent_layers: Depth of a rectangular indent outside, in layers; 0 without one.
        full_round: Whether the chambers' fillets are half of the chamber's length.
    """

    bubbles: int
    bubble_lines: int
    tendon_lines: int
    indent_layers: int = 0
    full_round: bool = False

    @property
    def text(self) -> str:
        """In a few words."""
        indent = f", indent of {self.indent_layers} layers" if self.indent_layers else ""
        rounds = ", fully rounded" if self.full_round else ""
        return (
            f"{self.bubbles} bubbles, walls of {self.bubble_lines} and {self.tendon_lines} lines"
            f"{indent}{rounds}"
        )


@dataclass(frozen=True)
class Bounds:
    """Which choices are looked at.

    Attributes:
        lines: Of a wall, from the fewest that seal.
        bubbles: Number of bubbles; empty for all that may fit.
        indents: Whether indents are tried.
        gap: Least distance of bubbles, mm; None for the printer's least gap.
        passage: Least width and height of the air channel, mm; None for two lines.
    """

    lines: tuple[int, ...] = ()
    bubbles: tuple[int, ...] = ()
    indents: bool = True
    gap: float | None = None
    passage: float | None = None

    def least_gap(self, profile: PrinterProfile) -> float:
        """mm."""
        return profile.minimum_gap if self.gap is None else self.gap

    def least_passage(self, profile: PrinterProfile) -> float:
        """mm."""
        return 2 * profile.line_width if self.passage is None else self.passage


SHORTEST_CHAMBER, LONGEST_CHAMBER = 0.8, 6.0
"""mm. Lengths of chambers that are looked at."""

MORE_LINES = 2
"""So many more lines than the fewest are tried."""


def choices(design: Design, bounds: Bounds) -> tuple[Choice, ...]:
    """All combinations that fit into the design's length."""
    profile = design.profile()
    lines = bounds.lines or tuple(
        range(profile.minimum_lines, profile.minimum_lines + MORE_LINES + 1)
    )
    combinations = itertools.product(
        lines, lines, _indents(bounds, profile, min(lines)), (False, True)
    )
    return tuple(
        Choice(count, bubble, tendon, indent, full)
        for bubble, tendon, indent, full in combinations
        for count in _counts(design, bubble * profile.line_width, bounds)
    )


def room(design: Design) -> float:
    """What the bubbles and the gaps between them may take of the length, mm."""
    return design.bellows.length - design.bellows.offset


def _counts(design: Design, wall: float, bounds: Bounds) -> Iterator[int]:
    """Numbers of bubbles for which there is a chamber of a usual length."""
    gap = bounds.least_gap(design.profile())
    shortest, longest = SHORTEST_CHAMBER + 2 * wall + gap, LONGEST_CHAMBER + 2 * wall + gap
    most = math.floor((room(design) + gap) / shortest + 1e-9)
    fewest = max(1, math.ceil((room(design) + gap) / longest - 1e-9))
    for count in range(fewest, most + 1):
        if not bounds.bubbles or count in bounds.bubbles:
            yield count


def _indents(bounds: Bounds, profile: PrinterProfile, lines: int) -> tuple[int, ...]:
    """None, and the deepest that leaves the least floor of the thinnest wall."""
    wall = lines * profile.line_width
    deepest = math.floor((wall - profile.minimum_floor) / profile.layer_height + 1e-9)
    return (0, deepest) if bounds.indents and deepest > 0 else (0,)
