"""The way into the leak test."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from printers.gcode.beads import Beads
from printers.leak_test.result import LeakTest
from printers.model import Opening
from printers.profile import PrinterProfile


def leak_test(
    beads: Beads,
    openings: Sequence[Opening],
    profile: PrinterProfile,
    *,
    voxel: float | None = None,
    solid_volume: float | None = None,
    transform: ArrayLike | tuple[ArrayLike, ArrayLike] | None = None,
) -> LeakTest:
    """Look for paths of air from the cavity behind the openings to the outside.

    Args:
        beads: Of the sliced part.
        openings: Mouths of the cavity, in the frame of the G-code; they are plugged.
        profile: The printer.
        voxel: Side of the grid's cells, mm; an eighth of a line by default.
        solid_volume: Of the solid that was sliced, mm³.
        transform: From the frame of the G-code to the part's own: a (4, 4) matrix or (rotation,
            translation). Places are reported in the part's coordinates. None: they are the same.
    """
    raise NotImplementedError
