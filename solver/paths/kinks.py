"""Kinks of a path: loads at which a prescribed motion stops, starts or turns at once.

Or at which a plane that is led comes to the body.

The path turns there by any angle within a step of no length, and is no longer or shorter for it.
What is continuous is the load: it goes on as before, unless the stability of the body changes.
"""

from __future__ import annotations

from dataclasses import replace

from solver.paths.arcs import SHARPEST_TURN, Arc, Arcs

HALVINGS = 10
"""A path that still turns sharply within a step so many times halved has a kink."""


def over_kink(arcs: Arcs, arc: Arc, length: float) -> Arc | None:
    """The arc next behind a kink, if there is one within a step of a length (mm) from ``arc``."""
    if not arcs.whole_load:
        return None
    before, behind = arc, arcs.onward(arc, arc.load + arc.slope * length)
    if not _turned(arcs, before, behind):
        return None
    for _ in range(HALVINGS):
        middle = arcs.onward(before, (before.load + behind.load) / 2)
        if _turned(arcs, before, middle):
            behind = middle
        elif _turned(arcs, middle, behind):
            before = middle
        else:
            return None
    return replace(behind, length=arc.length)


def _turned(arcs: Arcs, a: Arc, b: Arc) -> bool:
    """Whether the path turns sharply between two arcs of the same stability."""
    if a.failure or b.failure or a.unstable_modes != b.unstable_modes:
        return False
    return arcs.product(a, b.tangent, b.slope) < SHARPEST_TURN
