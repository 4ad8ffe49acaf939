"""What a printer does at each command: where the nozzle goes, and what plastic leaves it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from printers.arrays import Floats, Ints
from printers.compilation import njit
from printers.errors import PrintersError
from printers.gcode.words import Lines

LARGEST = 10_000.0
"""mm: no printer is larger, and no coordinate."""

SHORTEST = 1e-6
"""mm: plastic on less way is a blob, and no bead."""

LARGEST_FEED = 1e8
"""mm of filament in one move, or mm³: 100 km."""

OFF_CIRCLE = 0.1
"""mm by which the end of an arc may miss its circle: coordinates and centres are rounded."""

X0, Y0, Z0, X1, Y1, Z1, FED, CENTRE_X, CENTRE_Y, TURN, PATH, LINE, VOLUMETRIC, TOOL, FLOW = range(
    15
)
"""Columns of a move that lays down plastic. FED is the filament that is asked for in mm, or plastic
in mm³ where VOLUMETRIC is 1; FLOW is what share of it leaves the nozzle, after M221. TURN is 1 for
an arc anticlockwise, -1 clockwise, 0 for a straight line."""

COLUMNS = 15

LARGEST_FLOW = 100.0
"""Times what is asked for: printers take ten at most."""

# What the machine remembers: places in its state. X, Y, Z of the nozzle on the bed come first;
# what G-code calls a place is that less the offset.
_OFFSET = 3
_E, _SCALE, _RELATIVE, _RELATIVE_E, _VOLUMETRIC = range(6, 11)  # E in its unit; mm a unit
_BROKEN, _RETRACTED, _PATHS, _PLANE, _TOOL, _LENGTH, _VOLUME = range(11, 18)
_FLOW, _FIXED_CENTRE = 18, 19

# As in words.py. They stand here too, since the cache of compiled functions looks at one file.
_X, _Y, _Z, _E_WORD, _I, _J, _R, _S, _D, _P = 0, 1, 2, 3, 5, 6, 7, 8, 9, 10
_WORD_TOOL, _G, _M, _HOME = 1, 100_000, 200_000, 100_280
_CLOCKWISE, _ANTICLOCKWISE, _SPLINE = _G + 20, _G + 30, _G + 50
_RETRACT, _RECOVER, _PLANE_XY, _PLANE_ZX, _PLANE_YZ = (_G + 10 * n for n in (10, 11, 17, 18, 19))
_INCHES, _MILLIMETRES, _ABSOLUTE, _INCREMENTAL, _RENAME = (
    _G + 10 * n for n in (20, 21, 90, 91, 92)
)
_ABSOLUTE_E, _INCREMENTAL_E, _FILAMENT, _SET_FLOW = (_M + 10 * n for n in (82, 83, 200, 221))
_ABSOLUTE_CENTRE, _INCREMENTAL_CENTRE = _G + 901, _G + 911

_TOO_FAR, _TOO_MUCH, _OTHER_PLANE, _NO_CENTRE, _NO_CIRCLE, _TURNS, _NO_SPLINE = range(1, 8)
_NO_FLOW = 8
_FAULTS: dict[int, str] = {
    _TOO_FAR: f"leads farther than {LARGEST / 1000:g} m",
    _TOO_MUCH: "feeds more than 100 km of filament",
    _OTHER_PLANE: "has an arc that is not in the plane of the bed (after G18 or G19)",
    _NO_CENTRE: "has an arc without a centre (I, J) or a radius (R)",
    _NO_CIRCLE: "has an arc whose end does not lie on its circle",
    _TURNS: "has an arc of several turns (P), which is not understood",
    _NO_SPLINE: "has a spline (G5), which is not understood",
    _NO_FLOW: f"sets the flow (M221) beyond 0 to {100 * LARGEST_FLOW:g} %",
}


def _start() -> Floats:
    state = np.zeros(20)
    state[_SCALE], state[_BROKEN], state[_FLOW] = 1.0, 1.0, 1.0
    return state


@dataclass(eq=False)
class Machine:
    """A printer that reads line after line. Its state changes; what it hands out does not.

    Coordinates are of the bed, also after G92, which only renames the place of the nozzle. As in
    slicers and Klipper, E is relative after M83, and also after G91.
    """

    state: Floats = field(default_factory=_start)

    def follow(self, lines: Lines) -> Floats:
        """(n, 15) moves that lay down plastic, with the columns above.

        Raises:
            PrintersError: A command leads beyond a printer's size, or is not understood.
        """
        moves = np.empty((len(lines.command), COLUMNS))
        count, fault, line = _follow(self.state, lines.number, lines.command, lines.words, moves)
        if fault:
            raise PrintersError(f"line {line} of the G-code {_FAULTS[fault]}")
        return np.array(moves[:count])  # what was not needed is given back

    @property
    def length(self) -> float:
        """Filament that left the nozzle so far, mm, blobs and purge too, where E is a length."""
        return float(self.state[_LENGTH])

    @property
    def volume(self) -> float:
        """Likewise where E is a volume, mm³."""
        return float(self.state[_VOLUME])


@njit(cache=True)
def _set_mode(state: Floats, kind: int, word: Floats) -> int:
    """Commands that change what later ones mean: 0 or the kind of a fault."""
    if kind in (_INCHES, _MILLIMETRES):
        state[_SCALE] = 25.4 if kind == _INCHES else 1.0
    elif kind in (_ABSOLUTE, _INCREMENTAL):
        state[_RELATIVE] = 1.0 if kind == _INCREMENTAL else 0.0
    elif kind in (_ABSOLUTE_E, _INCREMENTAL_E):
        state[_RELATIVE_E] = 1.0 if kind == _INCREMENTAL_E else 0.0
    elif kind in (_ABSOLUTE_CENTRE, _INCREMENTAL_CENTRE):
        state[_FIXED_CENTRE] = 1.0 if kind == _ABSOLUTE_CENTRE else 0.0
    elif kind == _SET_FLOW and not np.isnan(word[_S]):
        state[_FLOW] = word[_S] / 100
        return 0 if 0 <= state[_FLOW] <= LARGEST_FLOW else _NO_FLOW
    elif kind in (_PLANE_XY, _PLANE_ZX, _PLANE_YZ):
        state[_PLANE] = 0.0 if kind == _PLANE_XY else 1.0
    elif kind == _WORD_TOOL:
        state[_TOOL] = word[_S]
    elif kind == _FILAMENT:  # D0 or S0: E is a length
        for column in (_S, _D):
            if not np.isnan(word[column]):
                state[_VOLUMETRIC] = 1.0 if word[column] > 0 else 0.0
    elif kind in (_RETRACT, _RECOVER) and np.isnan(word[_P]):
        state[_BROKEN] = 1.0  # with P, G10 sets a tool's temperature
    return 0


@njit(cache=True)
def _home(state: Floats, word: Floats) -> None:
    every = np.isnan(word[_X]) and np.isnan(word[_Y]) and np.isnan(word[_Z])
    for axis in range(3):
        if every or not np.isnan(word[axis]):
            state[axis], state[_OFFSET + axis] = 0.0, 0.0
    state[_BROKEN] = 1.0


@njit(cache=True)
def _rename(state: Floats, word: Floats) -> int:
    """G92: the nozzle stays where it is, which is called otherwise. 0 or the kind of a fault."""
    every = np.isnan(word[_X]) and np.isnan(word[_Y])
    every = every and np.isnan(word[_Z]) and np.isnan(word[_E_WORD])
    for axis in range(3):
        if every or not np.isnan(word[axis]):
            called = 0.0 if every else word[axis] * state[_SCALE]
            state[_OFFSET + axis] = state[axis] - called
            if not abs(state[_OFFSET + axis]) <= LARGEST:
                return _TOO_FAR
    if every or not np.isnan(word[_E_WORD]):
        state[_E] = 0.0 if every else word[_E_WORD]
    return 0


@njit(cache=True)
def _go(state: Floats, word: Floats) -> int:
    """The nozzle to its new place: 0 or the kind of a fault."""
    for axis in range(3):
        if not np.isnan(word[axis]):
            start = state[axis] if state[_RELATIVE] == 1.0 else state[_OFFSET + axis]
            state[axis] = start + word[axis] * state[_SCALE]
            if not abs(state[axis]) <= LARGEST:
                return _TOO_FAR
    return 0


@njit(cache=True)
def _fed(state: Floats, word: Floats) -> float:
    """What leaves the nozzle, in mm or mm³: nothing until what was pulled back is back again."""
    if np.isnan(word[_E_WORD]):
        return 0.0
    relative = state[_RELATIVE] == 1.0 or state[_RELATIVE_E] == 1.0
    feed = word[_E_WORD] if relative else word[_E_WORD] - state[_E]
    state[_E] = state[_E] + feed if relative else word[_E_WORD]
    feed *= state[_SCALE] ** 3 if state[_VOLUMETRIC] == 1.0 else state[_SCALE]
    if feed < 0:
        state[_RETRACTED] -= feed
        state[_BROKEN] = 1.0
        return 0.0
    returned = min(feed, state[_RETRACTED])
    state[_RETRACTED] -= returned
    return feed - returned


@njit(cache=True)
def _centre(
    state: Floats, word: Floats, x: float, y: float, turn: float
) -> tuple[float, float, int]:
    """The centre of the arc from (x, y) to where the nozzle is, and 0 or the kind of a fault."""
    scale = state[_SCALE]
    if state[_PLANE] == 1.0:
        return 0.0, 0.0, _OTHER_PLANE
    if word[_P] > 0:
        return 0.0, 0.0, _TURNS
    if not np.isnan(word[_R]):
        return _centre_by_radius(x, y, state[_X], state[_Y], word[_R] * scale, turn)
    fixed = state[_FIXED_CENTRE] == 1.0  # I and J are then a place, and both are needed
    missing = np.isnan(word[_I]) + np.isnan(word[_J])
    if missing == 2 or (fixed and missing > 0):
        return 0.0, 0.0, _NO_CENTRE
    from_x, from_y = (state[_OFFSET], state[_OFFSET + 1]) if fixed else (x, y)
    centre_x = from_x + (0.0 if np.isnan(word[_I]) else word[_I] * scale)
    centre_y = from_y + (0.0 if np.isnan(word[_J]) else word[_J] * scale)
    first = np.hypot(x - centre_x, y - centre_y)
    last = np.hypot(state[_X] - centre_x, state[_Y] - centre_y)
    if not first <= LARGEST:
        return centre_x, centre_y, _TOO_FAR
    on_circle = first > 0 and abs(first - last) <= OFF_CIRCLE
    return centre_x, centre_y, 0 if on_circle else _NO_CIRCLE


@njit(cache=True)
def _centre_by_radius(
    x: float, y: float, end_x: float, end_y: float, radius: float, turn: float
) -> tuple[float, float, int]:
    """R > 0 is the shorter way round, R < 0 the longer one."""
    dx, dy = end_x - x, end_y - y
    chord = np.hypot(dx, dy)
    if not abs(radius) <= LARGEST:
        return x, y, _TOO_FAR
    if chord == 0.0 or chord > 2 * abs(radius) + OFF_CIRCLE:
        return x, y, _NO_CIRCLE
    rise = np.sqrt(max(radius**2 - chord**2 / 4, 0.0)) / chord
    side = turn if radius > 0 else -turn
    return x + dx / 2 - side * rise * dy, y + dy / 2 + side * rise * dx, 0


@njit(cache=True)
def _move(state: Floats, kind: int, word: Floats, move: Floats) -> tuple[bool, int]:
    """Fill the move: whether it lays down plastic, and 0 or the kind of a fault."""
    x, y, z = state[_X], state[_Y], state[_Z]
    fault = _go(state, word)
    feed = _fed(state, word)
    if fault or not feed <= LARGEST_FEED or not state[_RETRACTED] <= LARGEST_FEED:
        return False, fault if fault else _TOO_MUCH
    state[_VOLUME if state[_VOLUMETRIC] == 1.0 else _LENGTH] += feed * state[_FLOW]
    turn, centre_x, centre_y = 0.0, 0.0, 0.0
    if feed > 0 and kind in (_CLOCKWISE, _ANTICLOCKWISE):
        turn = -1.0 if kind == _CLOCKWISE else 1.0
        centre_x, centre_y, fault = _centre(state, word, x, y, turn)
        if fault:
            return False, fault
    moved = turn != 0.0 or np.hypot(state[_X] - x, state[_Y] - y) > SHORTEST
    if feed * state[_FLOW] == 0 or not moved:
        if moved or state[_Z] != z:
            state[_BROKEN] = 1.0
        return False, 0
    state[_PATHS] += state[_BROKEN]
    state[_BROKEN] = 0.0
    move[X0], move[Y0], move[Z0] = x, y, z
    move[X1], move[Y1], move[Z1] = state[_X], state[_Y], state[_Z]
    move[FED], move[CENTRE_X], move[CENTRE_Y], move[TURN] = feed, centre_x, centre_y, turn
    move[PATH], move[VOLUMETRIC], move[TOOL] = state[_PATHS] - 1, state[_VOLUMETRIC], state[_TOOL]
    move[FLOW] = state[_FLOW]
    return True, 0


@njit(cache=True)
def _follow(
    state: Floats, number: Ints, command: Ints, words: Floats, moves: Floats
) -> tuple[int, int, int]:
    """Fill the moves; their count, and the kind and line of a fault."""
    count, fault = 0, 0
    for row in range(len(command)):
        kind, word = command[row], words[row]
        if _G <= kind <= _ANTICLOCKWISE:
            laid, fault = _move(state, kind, word, moves[count])
            moves[count, LINE] = number[row]
            count += laid
        elif kind == _HOME:
            _home(state, word)
        elif kind == _RENAME:
            fault = _rename(state, word)
        elif kind == _SPLINE:
            fault = _NO_SPLINE
        else:
            fault = _set_mode(state, kind, word)
        if fault:
            return count, fault, number[row]
    return count, 0, 0
