"""Do bubbles touch under pressure? Contact is reported here; it is not modelled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.geometry import OUTSIDE, ROOT, SYMMETRY, TIP
from bellows_design.parameters import BellowsParameters
from solver import Mesh
from solver.proximity import facing_gaps


@dataclass(frozen=True)
class Contact:
    """How near walls come to each other outside.

    ``detected``: neighbouring bubbles touch or run into each other. ``min_gap_mm``: narrowest air
    between them, None if they face nothing. ``overlaps_itself``: distant parts of the actuator
    run through each other, as they do past a full turn.
    """

    detected: bool
    min_gap_mm: float | None
    overlaps_itself: bool


def contact_of(bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray) -> Contact:
    """Contact in an actuator, full or half, after ``displacement`` (n, 3), mm."""
    closed = (name for name in (OUTSIDE, ROOT, TIP, SYMMETRY) if name in mesh.surfaces)
    gaps = facing_gaps(mesh, displacement, *closed)
    apart = np.abs(_bubble(bellows, gaps.starts) - _bubble(bellows, gaps.ends))
    # in the notch where a bubble stands on the tendon, facets face each other at any small distance
    notch = np.linalg.norm(gaps.starts - gaps.ends, axis=1) < bellows.bubble_distance / 2
    near = gaps.distances[(apart <= 1) & ~notch]
    narrowest = float(near.min()) if near.size else None
    return Contact(
        detected=narrowest is not None and narrowest <= 0,
        min_gap_mm=narrowest,
        overlaps_itself=bool((gaps.distances[apart > 1] < 0).any()),
    )


def _bubble(bellows: BellowsParameters, places: np.ndarray) -> np.ndarray:
    """Number of the bubble each place (k, 3) is nearest to along x, (k,)."""
    nearest = np.rint((places[:, 0] - bellows.bubble_middles[0]) / bellows.pitch)
    return np.clip(nearest, 0, bellows.bubble_count - 1)
