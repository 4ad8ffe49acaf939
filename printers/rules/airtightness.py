"""One connected cavity with exactly the declared openings, decided by topology.

With every declared opening plugged, an airtight part has two shells: its outside and its cavity.
Each plug in an opening caps one circle of the surface and so raises the Euler characteristic by two
per opening it closes; that counts the openings exactly, even two under one plug.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from printers.measure.leaks import Leak, find_leaks
from printers.measure.plugging import plugged
from printers.measure.shells import Shells, split_shells
from printers.measure.surface import Surface
from printers.model import Opening
from printers.report import RuleResult, Verdict, place


@dataclass(frozen=True)
class Sealing:
    """The part as it is (`part`) and with its declared openings plugged (`closed`)."""

    part: Shells
    closed: Shells
    openings: tuple[Opening, ...]

    @property
    def openings_closed(self) -> int:
        """Openings the plugs really closed; each one added two to the Euler characteristic."""
        before = self.part.surface.euler_characteristic()
        return (self.closed.surface.euler_characteristic() - before) // 2


def seal(surface: Surface, openings: Sequence[Opening]) -> Sealing:
    """Plug the openings of a closed surface; ValueError if it bounds no solid."""
    closed = plugged(surface, openings)
    return Sealing(split_shells(surface), split_shells(closed), tuple(openings))


def check_airtightness(sealing: Sealing) -> RuleResult:
    """Name what is wrong with the cavity, or report its volume."""
    verdict, measured, where, message = _diagnose(sealing)
    count = len(sealing.openings)
    required = f"1 cavity, {max(count, 1)} opening{'s' if count > 1 else ''}"
    return RuleResult("airtightness", verdict, measured, required, "", where, message)


def _diagnose(sealing: Sealing) -> tuple[Verdict, str, str, str]:
    sealed, cavities = sealing.part.voids, sealing.closed.voids
    names = " and ".join(opening.name for opening in sealing.openings)
    mouths = ", ".join(place(opening.centre) for opening in sealing.openings) or "whole part"
    if sealed and len(cavities) <= len(sealed):
        message = f"no opening leads into the sealed cavity of {_volumes(sealed)} mm³"
        return "fail", f"{_cavities(sealed)}, 0 openings", mouths, message
    if sealed:
        reached = max(set(cavities.values()) - set(sealed.values()), default=0.0)
        message = (
            f"{names} does not reach the sealed cavity of {_volumes(sealed)} mm³; "
            f"it opens into a pocket of {reached:.1f} mm³"
        )
        return "fail", _cavities(cavities), mouths, message
    if not sealing.openings:
        message = "no opening is declared, so no cavity can be pressurised"
        return "fail", "0 cavities, 0 openings", mouths, message
    if len(sealing.closed.bodies) > len(sealing.part.bodies):
        message = f"{names} is declared at {mouths}, where the part has no material to seal against"
        return "fail", "0 cavities, 0 openings", mouths, message
    if not cavities:
        return _open_cavity(sealing, names, mouths)
    return _closed_cavities(sealing, names, mouths)


def _open_cavity(sealing: Sealing, names: str, mouths: str) -> tuple[Verdict, str, str, str]:
    closed = sealing.openings_closed
    if closed <= 0:
        message = f"there is no opening at {names}, declared at {mouths}"
        return "fail", "0 cavities, 0 openings", mouths, message
    leaks = find_leaks(sealing.closed.surface, sealing.openings)
    where = "; ".join(place(leak.centre) for leak in leaks[:5])
    message = f"the cavity leaks: with {names} plugged it is still open{_sizes(leaks)}"
    measured = f"0 closed cavities, {closed + max(len(leaks), 1)} openings"
    return "fail", measured, where or "leak not located", message


def _sizes(leaks: Sequence[Leak]) -> str:
    if not leaks:
        return " somewhere, more widely than at the declared opening"
    named = [f"near {place(leak.centre)} ({leak.width:.2f} mm wide)" for leak in leaks[:5]]
    rest = [f"and in {len(leaks) - 5} more places"] if len(leaks) > 5 else []
    return " " + ", ".join(named + rest)


def _closed_cavities(sealing: Sealing, names: str, mouths: str) -> tuple[Verdict, str, str, str]:
    cavities, closed = sealing.closed.voids, sealing.openings_closed
    measured = f"{_cavities(cavities)}, {closed} opening{'s' if closed != 1 else ''}"
    if len(cavities) > 1:
        message = f"the part has {len(cavities)} unconnected cavities of {_volumes(cavities)} mm³"
        return "fail", measured, mouths, message
    if closed != len(sealing.openings):
        message = f"{closed} openings lie at {names}, where {len(sealing.openings)} is declared"
        return "fail", measured, mouths, message
    message = f"one cavity of {_volumes(cavities)} mm³ behind {names}, closed everywhere else"
    return "pass", measured, mouths, message


def _volumes(voids: Mapping[int, float]) -> str:
    values = sorted(voids.values(), reverse=True)
    return " + ".join(f"{volume:.1f}" for volume in values)


def _cavities(voids: Mapping[int, float]) -> str:
    return f"{len(voids)} cavit{'y' if len(voids) == 1 else 'ies'}"
