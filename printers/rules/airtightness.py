"""One connected cavity with exactly the declared openings, decided by topology.

With every declared opening plugged, an airtight part has two shells: its outside and its cavity.
Each plug in an opening caps one circle of the surface and so raises the Euler characteristic by two
per opening it closes; that counts the openings exactly, even two under one plug.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from printers.measure.leakage.leaks import Leak
from printers.measure.part import MeasuredPart
from printers.measure.plugging import Sealing
from printers.measure.widths import shown
from printers.report import RuleResult, Verdict, place


@dataclass(frozen=True)
class Diagnosis:
    """The verdict on the cavity: what was `found`, `where`, and one sentence."""

    verdict: Verdict
    found: str
    where: str
    message: str


def check_airtightness(part: MeasuredPart) -> Iterator[RuleResult]:
    """Name what is wrong with the cavity, or report its volume."""
    leaks = part.sealing.leaks or part.opened is not None
    found = _open_cavity(part) if leaks else _diagnose(part.sealing)
    required = f"1 cavity, {_openings(max(len(part.sealing.openings), 1))}"
    yield RuleResult(
        "airtightness", found.verdict, found.found, required, "", found.where, found.message
    ).at(*_places(part))


def _places(part: MeasuredPart) -> Iterator[Iterable[float]]:
    """That a diagnosis may name, beside the openings: sealed cavities and leaks."""
    sealed = part.sealing.part
    yield from (sealed.middle(shell) for shell in sealed.voids)
    yield from (leak.centre for leak in (part.opened.leaks if part.opened is not None else ()))


def _diagnose(sealing: Sealing) -> Diagnosis:
    names = " and ".join(opening.name for opening in sealing.openings)
    mouths = ", ".join(place(opening.centre) for opening in sealing.openings) or "whole part"
    nothing = "0 cavities, 0 openings"
    if sealing.part.voids:
        return _sealed_cavity(sealing, names, mouths)
    if not sealing.openings:
        message = "no opening is declared, so no cavity can be pressurised"
        return Diagnosis("fail", nothing, mouths, message)
    if len(sealing.closed.bodies) > len(sealing.part.bodies):
        message = f"{names} is declared at {mouths}, where the part has no material to seal against"
        return Diagnosis("fail", nothing, mouths, message)
    if sealing.closed.voids:
        return _closed_cavities(sealing, names, mouths)
    message = f"there is no opening at {names}, declared at {mouths}"
    return Diagnosis("fail", nothing, mouths, message)


def _sealed_cavity(sealing: Sealing, names: str, mouths: str) -> Diagnosis:
    sealed, cavities = sealing.part.voids, sealing.closed.voids
    if len(cavities) <= len(sealed):
        message = f"no opening leads into the sealed cavity of {_volumes(sealed)} mm³"
        return Diagnosis("fail", f"{_cavities(sealed)}, 0 openings", mouths, message)
    reached = max(set(cavities.values()) - set(sealed.values()), default=0.0)
    where = "; ".join(place(sealing.part.middle(shell)) for shell in sealed)
    message = (
        f"{names} does not reach the sealed cavity of {_volumes(sealed)} mm³ at {where}; "
        f"it opens into a pocket of {reached:.1f} mm³"
    )
    return Diagnosis("fail", _cavities(cavities), where, message)


def _open_cavity(part: MeasuredPart) -> Diagnosis:
    names = " and ".join(opening.name for opening in part.sealing.openings)
    leaks = part.opened.leaks if part.opened is not None else ()
    where = "; ".join(place(leak.centre) for leak in leaks[:5])
    message = f"the cavity leaks: with {names} plugged it is still open{_sizes(leaks)}"
    found = f"0 closed cavities, {_openings(part.sealing.openings_closed + max(len(leaks), 1))}"
    return Diagnosis("fail", found, where or "leak not located", message)


def _sizes(leaks: Sequence[Leak]) -> str:
    if not leaks:
        return " somewhere, more widely than at the declared opening"
    named = [f"near {place(leak.centre)} ({shown(leak.width)} mm wide)" for leak in leaks[:5]]
    rest = [f"and in {len(leaks) - 5} more places"] if len(leaks) > 5 else []
    return " " + ", ".join(named + rest)


def _closed_cavities(sealing: Sealing, names: str, mouths: str) -> Diagnosis:
    cavities, closed, count = (sealing.closed.voids, sealing.openings_closed, len(sealing.openings))
    found = f"{_cavities(cavities)}, {_openings(closed)}"
    if len(cavities) > 1:
        message = f"the part has {len(cavities)} unconnected cavities of {_volumes(cavities)} mm³"
        return Diagnosis("fail", found, mouths, message)
    if closed != count:
        message = (
            f"{_openings(closed)} {'lies' if closed == 1 else 'lie'} at {names}, where "
            f"{count} {'is' if count == 1 else 'are'} declared"
        )
        return Diagnosis("fail", found, mouths, message)
    message = f"one cavity of {_volumes(cavities)} mm³ behind {names}, closed everywhere else"
    return Diagnosis("pass", found, mouths, message)


def _volumes(voids: Mapping[int, float]) -> str:
    values = sorted(voids.values(), reverse=True)
    return " + ".join(f"{volume:.1f}" for volume in values)


def _cavities(voids: Mapping[int, float]) -> str:
    return f"{len(voids)} cavit{'y' if len(voids) == 1 else 'ies'}"


def _openings(count: int) -> str:
    return f"{count} opening{'' if count == 1 else 's'}"
