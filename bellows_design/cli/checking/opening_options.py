"""The openings that ``--opening`` names, or that are found."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from bellows_design.cli.checking.options import AUTO
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    from printers.measure.surface import Surface
    from printers.model import Opening
    from printers.openings.near import Named

LARGEST = 1e5  # mm, of a coordinate
DIAMETERS = (0.05, 200.0)  # mm: what is narrower than the least `minimum_gap` prints shut
Found = tuple[tuple["Opening", ...], tuple[str, ...]]


def parse_openings(texts: Sequence[str]) -> tuple[Named, ...]:
    """Points and diameters, mm; none of them for ``auto`` or nothing. Raises ``DesignError``."""
    if not texts or list(texts) == [AUTO]:
        return ()
    return tuple(_parsed(text) for text in texts)


def _parsed(text: str) -> Named:
    try:
        numbers = [float(word) for word in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (3, 4) or not all(abs(number) <= LARGEST for number in numbers):
        raise DesignError(
            f"--opening is {quoted(text)}; it must be X,Y,Z or X,Y,Z,DIAMETER in mm, or auto alone."
        )
    x, y, z, *rest = numbers
    if rest and not DIAMETERS[0] <= rest[0] <= DIAMETERS[1]:
        raise DesignError(
            f"the diameter of --opening {quoted(text)} is {rest[0]:g} mm; it must lie between "
            f"{DIAMETERS[0]:g} and {DIAMETERS[1]:g} mm."
        )
    return x, y, z, rest[0] if rest else None


def openings_of(surface: Surface, named: Sequence[Named]) -> Found:
    """Openings of a surface and notes on them; none of a surface that does not close.

    Raises ``PrintersError`` where it is not clear what is meant to be open.
    """
    from printers.openings.find import find_mouths, only_opening
    from printers.openings.near import named_opening, require_apart

    if not surface.is_closed or surface.volume() <= 0:
        return (), ("openings are looked for in meshes that close, with their normals outwards",)
    mouths = find_mouths(surface)
    if not named:
        found = only_opening(mouths)
        return found.openings, found.notes
    each = [
        named_opening(surface, mouths, point, f"opening {number}" if len(named) > 1 else "opening")
        for number, point in enumerate(named, 1)
    ]
    openings = tuple(opening for one in each for opening in one.openings)
    require_apart(openings)
    return openings, tuple(note for one in each for note in one.notes)
