"""What a slicer makes of a part, tested for leaks; places in the coordinates of the part's file."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from printers.arrays import Floats
from printers.leak_test.result import LeakTest
from printers.leak_test.run import leak_test
from printers.measure.surface import merged_surface
from printers.model import Opening, PrintedModel
from printers.orientation.turning import Turning, turned
from printers.profile import PrinterProfile
from printers.slicing.finding import Slicer
from printers.slicing.making import Sliced, slice_mesh
from printers.slicing.placing import Placement, turned_to_fit


@dataclass(frozen=True, eq=False)
class SlicedCheck:
    """G-code of a part, and the leak test on it."""

    sliced: Sliced
    leaks: LeakTest

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what limits the answer, the slicer's warnings among them."""
        warnings = tuple(f"the slicer warns: {text}" for text in self.sliced.warnings)
        return (*self.sliced.notes, *warnings, *self.leaks.notes)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        sliced = self.sliced
        return {
            "slicer": sliced.slicer,
            "version": sliced.version,
            "profile_sha256": sliced.profile_digest,
            "seconds": sliced.seconds,
            "print_seconds": sliced.gcode.estimated_time,
            "filament_mm": sliced.gcode.filament_length,
            "notes": list(self.notes),
            "leak_test": self.leaks.figures(),
        }


def check_sliced(
    model: PrintedModel,
    profile: PrinterProfile,
    turning: Turning,
    slicer: Slicer,
    folder: Path | None = None,
) -> SlicedCheck:
    """Slice a part with the airtight settings of its printer and test the G-code for leaks.

    Args:
        model: The part as its file has it, with its openings.
        profile: The printer.
        turning: How it stands on the bed.
        slicer: The program.
        folder: Where the G-code is kept, as `part.gcode`; None for nowhere.

    Raises:
        PrintersError: It does not fit the bed, or the slicer fails, drops settings, or leaves
            something out; one sentence.
    """
    standing = turned(model, turning)
    rotation = 90.0 if turned_to_fit(standing.vertices, profile) else 0.0
    sliced = slice_mesh(standing.vertices, standing.triangles, profile, slicer, rotation, folder)
    openings = [_on_bed(opening, sliced.placement) for opening in standing.openings]
    volume = merged_surface(standing.vertices, standing.triangles).volume()
    back = _to_file(sliced.placement, turning)
    leaks = leak_test(sliced.gcode.beads, openings, profile, solid_volume=volume, transform=back)
    return SlicedCheck(sliced, leaks)


def _on_bed(opening: Opening, placement: Placement) -> Opening:
    """The opening in the frame of the G-code."""
    centre = np.array(opening.centre)
    start, end = placement.to_gcode(np.array([centre, centre + opening.direction])).tolist()
    direction = np.subtract(end, start)
    x, y, z = (direction / np.linalg.norm(direction)).tolist()
    return replace(opening, centre=tuple(start), direction=(x, y, z))


def _to_file(placement: Placement, turning: Turning) -> Floats:
    """(4, 4): from the frame of the G-code to that of the part's file."""
    corners = placement.to_part(np.vstack([np.zeros(3), np.eye(3)])) @ turning.matrix
    matrix = np.eye(4)
    matrix[:3, :3] = (corners[1:] - corners[0]).T
    matrix[:3, 3] = corners[0]
    return matrix
