"""Openings that nobody named: the one mouth of the one cavity, or a sentence on why there is none.

A pin hole beside the port is no second opening: the widest mouth is the opening where it is
`CLEARLY_WIDER` than the next, and what else is open is left to the rule `airtightness`, which names
it as a leak. Likewise holes are left aside, such as those of screws, where they are no wider behind
than at their mouth and hold less than `MINOR` of the air; a chamber of its own never is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from printers.errors import PrintersError
from printers.measure.shells import split_shells
from printers.measure.surface import Surface
from printers.model import Opening
from printers.openings.inner_surface import Cavity, find_cavities
from printers.openings.mouth import Mouth, mouths_of
from printers.tolerances import FACET_TOLERANCE

CLEARLY_WIDER = 2.0
"""Ratio from which the widest mouth is the opening, and the others are leaks.

Of the pins that enter: a slit has the area of a port and lets no tube in.
"""

MINOR = 0.1
"""Share of the largest cavity's air below which a hole is left aside, such as a screw's. A
convention: a larger one is asked about."""

MOST_NAMED = 8
NAME = "opening"


@dataclass(frozen=True)
class Mouths:
    """All mouths of a surface.

    Attributes:
        of_cavities: Those of each cavity, the widest first; the largest cavity first.
        volumes: Of their air, mm³.
        sealed: mm³ of air without any mouth.
        bodies: How many pieces of material there are.
    """

    of_cavities: tuple[tuple[Mouth, ...], ...]
    volumes: tuple[float, ...]
    sealed: float
    bodies: int

    @property
    def all(self) -> tuple[Mouth, ...]:
        """The mouths of all cavities."""
        return tuple(mouth for mouths in self.of_cavities for mouth in mouths)


@dataclass(frozen=True)
class FoundOpenings:
    """Openings, and what a reader should know about how they were found."""

    openings: tuple[Opening, ...]
    notes: tuple[str, ...]


def find_mouths(surface: Surface) -> Mouths:
    """The mouths of a closed surface's cavities, mm.

    Raises:
        PrintersError: The surface does not close, so that there is no inside.
    """
    if not (surface.is_closed and surface.volume() > 0):
        raise PrintersError(
            "openings cannot be looked for: the mesh is not closed with its normals outwards"
        )
    cavities: tuple[Cavity, ...] = find_cavities(surface)
    pairs = [(mouths_of(surface, cavity), cavity.volume) for cavity in cavities]
    open_ones = [pair for pair in pairs if pair[0]]
    mouths, volumes = tuple(pair[0] for pair in open_ones), tuple(pair[1] for pair in open_ones)
    shells = split_shells(surface)
    return Mouths(mouths, volumes, sum(shells.voids.values()), len(shells.bodies))


def only_opening(mouths: Mouths) -> FoundOpenings:
    """The one opening among `mouths`; none, with a note on it, where no cavity is open.

    Raises:
        PrintersError: More than one may be meant; the sentence lists them.
    """
    if not mouths.of_cavities:
        sealed = f", one of {mouths.sealed:.1f} mm³ is sealed" if mouths.sealed else ""
        return FoundOpenings((), (f"no cavity with a mouth to the outside was found{sealed}",))
    _require_one_cavity(mouths)
    first, *others = mouths.of_cavities[0]
    if others and first.radius < CLEARLY_WIDER * others[0].radius:
        raise PrintersError(
            f"the cavity has {1 + len(others)} mouths: {_listed([first, *others])}; name what is "
            "meant to be open with --opening X,Y,Z, once for each"
        )
    first.require_port()
    return FoundOpenings((first.opening(NAME),), _notes(mouths, first, others))


def _require_one_cavity(mouths: Mouths) -> None:
    first, *others = mouths.of_cavities
    shares = [volume / mouths.volumes[0] for volume in mouths.volumes[1:]]
    pairs = zip(others, shares, strict=True)
    major = [first, *(each for each, share in pairs if not _is_minor(each, share))]
    if len(major) > 1 and mouths.bodies == 1:  # several bodies fail for that by a rule
        places = _listed([each[0] for each in major])
        raise PrintersError(
            f"{len(major)} cavities are open to the outside: {places}; name what is meant to be "
            "open with --opening X,Y,Z, once for each"
        )


def _is_minor(mouths: Sequence[Mouth], share: float) -> bool:
    """Whether a cavity with that share of the largest one's air is a small hole, such as a screw's:
    no wider behind than at one of its mouths."""
    return share < MINOR and any(mouth.beyond <= 2 * FACET_TOLERANCE for mouth in mouths)


def _notes(mouths: Mouths, first: Mouth, others: Sequence[Mouth]) -> tuple[str, ...]:
    notes = [f"opening found at {first.described()}"]
    if not first.is_plane:
        notes.append("its rim lies in no plane: the axis is that of its area")
    if others:
        notes.append(
            f"also open, and taken for leaks as the opening is {CLEARLY_WIDER:g} times as wide: "
            f"{_listed(others)}"
        )
    if len(mouths.of_cavities) > 1:
        blind = [each[0] for each in mouths.of_cavities[1:]]
        notes.append(f"holes without a chamber left aside: {_listed(blind)}")
    return tuple(notes)


def _listed(mouths: Sequence[Mouth]) -> str:
    named = [mouth.described() for mouth in mouths[:MOST_NAMED]]
    rest = [f"and {len(mouths) - MOST_NAMED} more"] if len(mouths) > MOST_NAMED else []
    return ", ".join(named + rest)
