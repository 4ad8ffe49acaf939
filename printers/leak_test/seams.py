"""How much each path may lose at both its ends before a leak opens.

Where a path begins or ends plastic may be missing: pressure in a soft filament builds up and falls
slowly, and no slicer shows that in its G-code. So the ends are cut back until the widest path is
air. The answer is a property of how seams lie beside each other, not of any one seam.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from printers.gcode.beads import Beads
from printers.leak_test.field import paint
from printers.leak_test.result import SeamTolerance
from printers.leak_test.widest_path import widest_path
from printers.model import Opening

LOSSES = (0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5)
"""mm that are tried, by bisection: three of them."""

CELLS_A_LINE = 5
"""With fewer, the loss that opens a leak moves by more than one step."""


def seam_tolerance(beads: Beads, openings: Sequence[Opening], line_width: float) -> SeamTolerance:
    """Bisect the losses for the largest that opens no leak, on cells of a fifth of a line."""
    voxel = line_width / CELLS_A_LINE
    low, high, tried = -1, len(LOSSES), []
    while high - low > 1:
        middle = (low + high) // 2
        field = paint(shortened(beads, LOSSES[middle]), voxel, line_width, far=False)
        path = widest_path(field, openings)
        tried.append((LOSSES[middle], path.ratio))
        low, high = (low, middle) if path.is_open else (middle, high)
    holds = LOSSES[low] if low >= 0 else 0.0
    leaks_at = LOSSES[high] if high < len(LOSSES) else None
    return SeamTolerance(holds, leaks_at, tuple(sorted(tried)))


def shortened(beads: Beads, loss: float) -> Beads:
    """The beads without the first and the last `loss` mm of every path."""
    if loss == 0 or not len(beads):
        return beads
    first = np.concatenate([[True], np.diff(beads.path) != 0])
    path = np.cumsum(first) - 1
    total = np.bincount(path, beads.length)
    before = np.concatenate([[0.0], np.cumsum(beads.length)])
    begins = before[:-1] - before[:-1][first][path]
    low = np.maximum(begins, loss)
    high = np.minimum(begins + beads.length, total[path] - loss)
    along = (beads.end - beads.start) / np.maximum(beads.length, 1e-12)[:, None]
    start = beads.start + along * (low - begins)[:, None]
    end = beads.start + along * (high - begins)[:, None]
    rest = [getattr(beads, name) for name in tuple(beads.__dataclass_fields__)[2:]]
    return Beads(start, end, *rest).chosen(high - low > 1e-9)
