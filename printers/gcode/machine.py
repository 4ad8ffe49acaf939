"""What a printer does at each command: where the nozzle goes, and what plastic leaves it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from printers.arrays import Floats
from printers.compilation import njit
from printers.errors import PrintersError
from printers.gcode.words import Lines

LARGEST = 10_000.0
"""mm: no printer is larger, and no coordinate."""

LARGEST_FEED = 1e8
"""mm of filament: 100 km."""

X0, Y0, Z0, X1, Y1, Z1, FED, CENTRE_X, CENTRE_Y, TURN, PATH, LINE, VOLUMETRIC, TOOL = range(14)
"""Columns of a move that lays down plastic. FED is filament in mm, or plastic in mm³ where
VOLUMETRIC is 1; TURN is 1 for an arc anticlockwise, -1 clockwise, 0 for a straight line."""

COLUMNS = 14

_FAULTS: dict[int, str] = {
    1: f"leads farther than {LARGEST / 1000:g} m",
    2: "feeds more than 100 km of filament",
    3: "has an arc that is not in the plane of the bed (after G18 or G19)",
    4: "has an arc without a centre (I, J) or a radius (R)",
    5: "has an arc whose end does not lie on its circle",
    6: "has an arc of several turns (P), which is not understood",
    7: "has a spline (G5), which is not understood",
}


def _start() -> Floats:
    state = np.zeros(18)
    state[6], state[11] = 1.0, 1.0
    return state


@dataclass(eq=False)
class Machine:
    """A printer that reads line after line. Its state changes; everything else here is frozen.

    Coordinates are of the bed, also after G92, which only renames the place of the nozzle. As in
    slicers and Klipper, E is relative after M83, and also after G91.
    """

    state: Floats = field(default_factory=_start)

    def follow(self, lines: Lines) -> Floats:
        """(n, 14) moves that lay down plastic, with the columns above.

        Raises:
            PrintersError: A command leads beyond a printer's size, or is not understood.
        """
        moves = np.empty((len(lines.command), COLUMNS))
        count, fault, line = _follow(self.state, lines.number, lines.command, lines.words, moves)
        if fault:
            raise PrintersError(f"line {line} of the G-code {_FAULTS[fault]}")
        return np.array(moves[:count])  # what was not needed is given back

    @property
    def fed(self) -> float:
        """Filament that left the nozzle so far, mm, blobs and purge too, where E is a length."""
        return float(self.state[16])

    @property
    def fed_volume(self) -> float:
        """Likewise where E is a volume, mm³."""
        return float(self.state[17])


@njit(cache=True)
def _follow(state, number, command, words, moves):  # type: ignore[no-untyped-def]
    """Fill the moves; their count, and the kind and line of a fault."""
    place, offset = state[0:3].copy(), state[3:6].copy()  # bed = what G-code says + offset
    scale, extruder = state[6], state[7]  # mm a unit; E as G-code says
    relative, relative_feed, volumetric = state[8], state[9], state[10]
    broken, retracted, path = state[11], state[12], state[13]
    plane, tool, fed, fed_volume = state[14], state[15], state[16], state[17]
    count = 0
    for row in range(len(command)):
        kind = command[row]
        word = words[row]
        if kind == 1:
            tool = word[8]
        elif kind == 100_050:
            return count, 7, number[row]
        elif kind == 100_170:
            plane = 0.0
        elif kind == 100_180 or kind == 100_190:
            plane = 1.0
        elif kind == 100_200:
            scale = 25.4
        elif kind == 100_210:
            scale = 1.0
        elif kind == 100_900:
            relative = 0.0
        elif kind == 100_910:
            relative = 1.0
        elif kind == 200_820:
            relative_feed = 0.0
        elif kind == 200_830:
            relative_feed = 1.0
        elif kind == 200_2000:
            if not np.isnan(word[9]):
                volumetric = 1.0 if word[9] > 0 else 0.0
            if not np.isnan(word[8]):
                volumetric = 1.0 if word[8] > 0 else 0.0
        elif kind == 100_280:  # home
            every = np.isnan(word[0]) and np.isnan(word[1]) and np.isnan(word[2])
            for axis in range(3):
                if every or not np.isnan(word[axis]):
                    place[axis], offset[axis] = 0.0, 0.0
            broken = 1.0
        elif kind == 100_920:  # the nozzle's place gets another name
            every = True
            for axis in range(4):
                every = every and np.isnan(word[axis])
            for axis in range(3):
                if every:
                    offset[axis] = place[axis]
                elif not np.isnan(word[axis]):
                    offset[axis] = place[axis] - word[axis] * scale
                if not abs(offset[axis]) <= 10_000.0:
                    return count, 1, number[row]
            if every:
                extruder = 0.0
            elif not np.isnan(word[3]):
                extruder = word[3]
        elif kind == 100_100 or kind == 100_110:
            if np.isnan(word[10]):  # with P it sets a tool's temperature
                broken = 1.0
        elif 100_000 <= kind <= 100_030:
            x, y, z = place[0], place[1], place[2]
            for axis in range(3):
                if not np.isnan(word[axis]):
                    start = place[axis] if relative == 1.0 else offset[axis]
                    place[axis] = start + word[axis] * scale
                    if not abs(place[axis]) <= 10_000.0:
                        return count, 1, number[row]
            feed = 0.0
            if not np.isnan(word[3]):
                is_relative = relative == 1.0 or relative_feed == 1.0
                feed = word[3] if is_relative else word[3] - extruder
                extruder = extruder + feed if is_relative else word[3]
                feed *= scale**3 if volumetric == 1.0 else scale
                if not abs(feed) <= 1e8:
                    return count, 2, number[row]
            if feed < 0:
                retracted -= feed
                broken, feed = 1.0, 0.0
            elif retracted > 0:
                returned = min(feed, retracted)
                retracted -= returned
                feed -= returned
            turn, centre_x, centre_y = 0.0, 0.0, 0.0
            if kind >= 100_020 and feed > 0:
                if plane == 1.0:
                    return count, 3, number[row]
                if word[10] > 0:
                    return count, 6, number[row]
                turn = -1.0 if kind == 100_020 else 1.0
                dx, dy = place[0] - x, place[1] - y
                if not np.isnan(word[7]):
                    radius = word[7] * scale
                    chord = np.hypot(dx, dy)
                    if chord == 0.0 or chord > 2 * abs(radius) + 0.1:
                        return count, 5, number[row]
                    rise = np.sqrt(max(radius**2 - chord**2 / 4, 0.0)) / chord
                    side = turn if radius > 0 else -turn  # R < 0: the longer way round
                    centre_x, centre_y = (
                        x + dx / 2 - side * rise * dy,
                        y + dy / 2 + side * rise * dx,
                    )
                elif np.isnan(word[5]) and np.isnan(word[6]):
                    return count, 4, number[row]
                else:
                    centre_x = x + (0.0 if np.isnan(word[5]) else word[5] * scale)
                    centre_y = y + (0.0 if np.isnan(word[6]) else word[6] * scale)
                    first = np.hypot(x - centre_x, y - centre_y)
                    last = np.hypot(place[0] - centre_x, place[1] - centre_y)
                    if not first <= 10_000.0:
                        return count, 1, number[row]
                    if first == 0.0 or abs(first - last) > 0.1:
                        return count, 5, number[row]
            moved = place[0] != x or place[1] != y
            if feed > 0:
                if volumetric == 1.0:
                    fed_volume += feed
                else:
                    fed += feed
            if feed > 0 and (moved or turn != 0.0):
                if broken == 1.0:
                    path += 1
                    broken = 0.0
                move = moves[count]
                move[0], move[1], move[2] = x, y, z
                move[3], move[4], move[5] = place[0], place[1], place[2]
                move[6], move[7], move[8], move[9] = feed, centre_x, centre_y, turn
                move[10], move[11], move[12], move[13] = path - 1, number[row], volumetric, tool
                count += 1
            elif moved or place[2] != z:
                broken = 1.0
    state[0:3], state[3:6] = place, offset
    state[6], state[7] = scale, extruder
    state[8], state[9], state[10] = relative, relative_feed, volumetric
    state[11], state[12], state[13] = broken, retracted, path
    state[14], state[15], state[16], state[17] = plane, tool, fed, fed_volume
    return count, 0, 0
