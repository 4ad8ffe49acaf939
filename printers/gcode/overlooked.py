"""Commands that change where plastic goes or how much, and that are not followed: they are told."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_COMMANDS = (
    rb"M92|M290|M579|G53|G5[5-9](?:\.\d)?|G61|G68|"
    rb"SET_EXTRUDE_FACTOR|SET_EXTRUDER_ROTATION_DISTANCE|SET_EXTRUDER_STEP_DISTANCE|"
    rb"SET_GCODE_OFFSET|RESTORE_GCODE_STATE"
)
"""Steps per mm, scales, shifts and turns of coordinates, of Marlin, RepRapFirmware and Klipper."""

_OVERLOOKED = re.compile(rb"^[ \t]*(?:N\d+[ \t]*)?(%b)(?![\w.])" % _COMMANDS, re.M | re.I)


@dataclass(eq=False)
class Overlooked:
    """The commands of a file that are passed over though they matter, collected piece by piece."""

    names: set[str] = field(default_factory=set)

    def collect(self, piece: bytes) -> None:
        """Take in whole lines."""
        self.names.update(name.decode().upper() for name in _OVERLOOKED.findall(piece))

    def notes(self) -> Iterator[str]:
        """A sentence, if there is something to tell."""
        if self.names:
            yield (
                f"{', '.join(sorted(self.names))}: passed over, though the printer may then feed "
                f"more or less plastic, or lay it elsewhere"
            )
