"""What happens between two equilibria of a volume-controlled path: limit points, branches.

The pressure has an extremum where its slope over the volume changes sign: there stability at
constant pressure is lost or regained. Where the number of unstable modes at a held volume changes,
another branch crosses. A path that leaves its branch for a stable one keeps that number, but it
turns sharply: its direction changes by as much within a small part of a step as in all of it.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Literal, TypeAlias

from solver.nonlinear.newton import Newton
from solver.paths.volume.held import HeldVolume, at_volume

HALVINGS = 6
"""A bifurcation is located to this power of a half of the step."""

LOCATED = 1e-4
"""Of the step: the volume of an extremum of the pressure is located to it."""

MOST_TRIALS = 12
"""Equilibria that are tried for an extremum."""

LEAST_TURN = 0.03
"""rad. Less of a turn in one step is not looked into."""

UNUSUAL = 3.0
"""Nor is a step that turns no more than so many times as fast, per volume, as the one before."""

FIRST_HALVINGS = 3
SHARP = 0.6
"""A turn is sharp if this share of it happens within ``FIRST_HALVINGS`` halvings of the step."""


ChangeKind: TypeAlias = Literal["extremum", "bifurcation", "turn"]
"""An extremum of the pressure; another number of unstable modes at a held volume from there on; a
sharp turn of the path."""


@dataclass(frozen=True)
class Change:
    """An equilibrium ``at`` which something happens."""

    kind: ChangeKind
    at: HeldVolume


def changes_between(
    newton: Newton, a: HeldVolume, b: HeldVolume, turning: float | None
) -> tuple[Change, ...]:
    """Changes on the step from ``a`` to ``b``, in the order of the path.

    ``turning`` of the step before ``a``, rad/mm^3, None if there is none.
    """
    found: list[Change] = []
    if a.compliance * b.compliance < 0:
        found.append(Change("extremum", _extremum_between(newton, a, b)))
    if a.unstable_modes != b.unstable_modes:
        found.append(Change("bifurcation", _bifurcation_between(newton, a, b)))
    elif _is_unusual(a, b, turning) and not (_has_corners(newton, a) or _has_corners(newton, b)):
        turn = _sharp_turn_between(newton, a, b)
        found += [Change("turn", turn)] if turn is not None else []
    return tuple(sorted(found, key=lambda change: abs(change.at.volume - a.volume)))


def turning(a: HeldVolume, b: HeldVolume) -> float:
    """Turn of the path per volume between two of its equilibria, rad/mm^3."""
    return a.turn(b) / abs(b.volume - a.volume)


def _has_corners(newton: Newton, at: HeldVolume) -> bool:
    """Whether the branch itself may turn: where points begin to touch, or films to wrinkle."""
    if newton.wrinkling:
        return True
    return newton.assembly.contacts.touched(at.found.state, newton.loading.share(at.pressure))


def _is_unusual(a: HeldVolume, b: HeldVolume, before: float | None) -> bool:
    """Whether a step turns so much faster than the one before that it may hide a corner."""
    return a.turn(b) > LEAST_TURN and (before is None or turning(a, b) > UNUSUAL * before)


def _extremum_between(newton: Newton, a: HeldVolume, b: HeldVolume) -> HeldVolume:
    """Where the slope of the pressure vanishes; the best that was found if a trial fails."""
    from scipy.optimize import brentq

    tried = {a.volume: a, b.volume: b}

    def slope(volume: float) -> float:
        if volume not in tried:
            nearest = min(tried.values(), key=lambda held: abs(held.volume - volume))
            held = at_volume(newton, nearest, volume)
            if held.failure:
                raise _NoEquilibrium
            tried[volume] = held
        return tried[volume].slope

    width = LOCATED * abs(b.volume - a.volume)
    with suppress(_NoEquilibrium):
        brentq(slope, a.volume, b.volume, xtol=width, maxiter=MOST_TRIALS, disp=False)
    inner = [held for held in tried.values() if held is not a and held is not b]
    rising = a.slope * (b.volume - a.volume) > 0
    return (max if rising else min)(inner or [b], key=lambda held: held.pressure)


class _NoEquilibrium(Exception):
    """A trial failed."""


def _bifurcation_between(newton: Newton, a: HeldVolume, b: HeldVolume) -> HeldVolume:
    """The first equilibrium found with another number of unstable modes than ``a``.

    Each trial starts from the side with more of them, which has the branch that goes on: nearer to
    the bifurcation Newton's method may find the other branch from either side.
    """
    low, high = a, b
    onward = (b.unstable_modes or 0) > (a.unstable_modes or 0)
    for _ in range(HALVINGS):
        start = high if onward else low
        middle = at_volume(newton, start, (low.volume + high.volume) / 2)
        if middle.failure:
            break
        if middle.unstable_modes == a.unstable_modes:
            low = middle
        else:
            high = middle
    return high


def _sharp_turn_between(newton: Newton, a: HeldVolume, b: HeldVolume) -> HeldVolume | None:
    """The end of the first small part of a step that turns; None if the path turns all along."""
    low, high, whole = a, b, a.turn(b)
    for number in range(1, HALVINGS + 1):
        middle = _middle(newton, low, high)
        if middle.failure:
            break
        early = low.turn(middle) > SHARP * whole
        low, high = (low, middle) if early else (middle, high)
        if number == FIRST_HALVINGS and low.turn(high) < SHARP * whole:
            return None
    return high


def _middle(newton: Newton, low: HeldVolume, high: HeldVolume) -> HeldVolume:
    """An equilibrium halfway between two."""
    return at_volume(newton, low, (low.volume + high.volume) / 2)
