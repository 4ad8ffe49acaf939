"""Arcs as straight pieces."""

from __future__ import annotations

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError
from printers.gcode.machine import (
    CENTRE_X,
    CENTRE_Y,
    FED,
    TURN,
    X0,
    X1,
    Y0,
    Y1,
    Z0,
    Z1,
)

CHORD_ERROR = 0.005
"""mm: straight pieces leave the arc by no more. A hundredth of a line."""


def straightened(moves: Floats, most: int) -> Floats:
    """The moves with every arc parted into straight pieces of equal turn and plastic.

    Raises:
        PrintersError: There are more than `most` pieces.
    """
    arcs = moves[:, TURN] != 0
    if not arcs.any():
        return moves
    radius, angle, swept = _circles(moves[arcs])
    pieces = np.ones(len(moves), dtype=np.int64)
    pieces[arcs] = _pieces(radius[:, 0], swept)
    if pieces.sum() > most:
        raise PrintersError(f"the G-code has arcs of more than {most} straight pieces")
    parted = np.repeat(moves, pieces, axis=0)
    of_arc = np.repeat(arcs, pieces)
    place = np.arange(len(parted)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    arc, share = np.repeat(np.arange(arcs.sum()), pieces[arcs]), np.repeat(pieces, pieces)
    step, share = place[of_arc], share[of_arc]
    turned = parted[of_arc]
    for columns, fraction in (((X0, Y0, Z0), step / share), ((X1, Y1, Z1), (step + 1) / share)):
        points = _points(moves[arcs][arc], radius[arc], angle[arc], swept[arc], fraction)
        turned[:, columns] = points
    turned[:, FED] /= share
    turned[:, TURN] = 0
    parted[of_arc] = turned
    return parted


def _circles(arcs: Floats) -> tuple[Floats, Floats, Floats]:
    """(n, 2) radii at both ends, (n,) angle of the first end, (n,) signed angle swept."""
    from_centre = arcs[:, (X0, Y0, X1, Y1)] - arcs[:, (CENTRE_X, CENTRE_Y, CENTRE_X, CENTRE_Y)]
    radius = np.hypot(from_centre[:, 0::2], from_centre[:, 1::2])
    angle = np.arctan2(from_centre[:, 1::2], from_centre[:, 0::2])
    turn = arcs[:, TURN]
    swept = (turn * (angle[:, 1] - angle[:, 0])) % (2 * np.pi)
    closed = (arcs[:, X0] == arcs[:, X1]) & (arcs[:, Y0] == arcs[:, Y1])
    return radius, angle[:, 0], turn * np.where(closed, 2 * np.pi, swept)


def _pieces(radius: Floats, swept: Floats) -> Ints:
    """A chord leaves its arc by r (1 - cos(turn / 2))."""
    widest = 2 * np.arccos(np.clip(1 - CHORD_ERROR / radius, 0.0, 1.0))
    return np.maximum(np.ceil(np.abs(swept) / widest), 1).astype(np.int64)


def _points(arcs: Floats, radius: Floats, angle: Floats, swept: Floats, fraction: Floats) -> Floats:
    """(n, 3) points at the fraction of the arcs; their ends are the moves' own, to the bit."""
    where = angle + fraction * swept
    distance = radius[:, 0] + fraction * (radius[:, 1] - radius[:, 0])
    points = np.column_stack(
        (
            arcs[:, CENTRE_X] + distance * np.cos(where),
            arcs[:, CENTRE_Y] + distance * np.sin(where),
            arcs[:, Z0] + fraction * (arcs[:, Z1] - arcs[:, Z0]),
        )
    )
    points[fraction == 0] = arcs[fraction == 0][:, (X0, Y0, Z0)]
    points[fraction == 1] = arcs[fraction == 1][:, (X1, Y1, Z1)]
    return points
