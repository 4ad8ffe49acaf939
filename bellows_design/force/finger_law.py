"""The law of a finger's pieces, with what is known of it besides how they move."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from bellows_design.force.section_law import SectionLaw
from solver.arrays import Reals


@dataclass(frozen=True)
class Uncertainty:
    """Rotations that the law does not know of, rad.

    Attributes:
        interpolation: Of every piece, between the points of the law's table.
        mesh: Of every piece, by the cell's mesh.
        neighbours: Of every piece, by contact with a mirror image while the moment varies.
        root: Of the root's end.
        tip: Of the tip's end.
        shear: Fraction of the pieces' shear compliance.
    """

    interpolation: float = 0.0
    mesh: float = 0.0
    neighbours: float = 0.0
    root: float = 0.0
    tip: float = 0.0
    shear: float = 0.0


class Facts(Protocol):
    """What a law knows of a finger at a pressure (MPa).

    Its n half bubbles bear section loads (n, 3), from root to tip.
    """

    def touching(self, pressure: float, loads: Reals) -> bool:
        """Whether neighbouring bubbles touch."""
        ...

    def stress(self, pressure: float, loads: Reals) -> tuple[float, float] | None:
        """Highest von Mises stress, MPa, and its estimated error, percent; None if not known."""
        ...

    def unknown(self, pressure: float, loads: Reals) -> Uncertainty:
        """Rotations that the law does not know of."""
        ...

    def within(self, pressure: float, loads: Reals) -> bool:
        """Whether the law was computed for such moments; it is extrapolated beyond."""
        ...

    def ends_within(self, pressure: float, loads: Reals) -> bool:
        """Whether the laws of root and tip were, which cannot be extended."""
        ...


@dataclass(frozen=True)
class NoFacts:
    """Of a law that is exact by definition: a limit with a closed form."""

    def touching(self, pressure: float, loads: Reals) -> bool:
        """Nothing touches."""
        return False

    def stress(self, pressure: float, loads: Reals) -> None:
        """There is no stress."""
        return None

    def unknown(self, pressure: float, loads: Reals) -> Uncertainty:
        """Nothing is unknown."""
        return Uncertainty()

    def within(self, pressure: float, loads: Reals) -> bool:
        """It holds everywhere."""
        return True

    def ends_within(self, pressure: float, loads: Reals) -> bool:
        """They hold everywhere."""
        return True


@dataclass(frozen=True)
class FingerLaw:
    """The laws of a finger.

    Attributes:
        piece: Of half a bubble.
        root: Of the first half bubble with what the root adds; None for the same.
        tip: Of the last half bubble with what the tip adds, likewise.
        facts: What is known besides.
        warnings: Sentences on what makes it less reliable than it looks.
        complete: Whether it is as fine as asked for; else its time was over.
        from_cache: When it was computed (UTC), where it comes from the store; else empty.
        seconds: Time of its computation, s.
    """

    piece: SectionLaw
    root: SectionLaw | None = None
    tip: SectionLaw | None = None
    facts: Facts = field(default_factory=NoFacts)
    warnings: tuple[str, ...] = ()
    complete: bool = True
    from_cache: str = ""
    seconds: float = 0.0
