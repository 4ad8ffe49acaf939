"""The surface everything is measured on, split into the inside of the cavity and the outside."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from printers.arrays import Flags, Floats
from printers.measure.leakage.leaks import OpenCavity
from printers.measure.plugging import near_axis
from printers.measure.samples import Samples, sample
from printers.measure.shells import Shells
from printers.measure.surface import Surface
from printers.model import Opening

SAMPLES_PER_SQUARE_MILLIMETRE = 4.0
SAMPLE_BOUNDS = (4_000, 60_000)


@dataclass(frozen=True)
class Boundary:
    """A part with its openings plugged.

    `bore_depth` mm: how far behind its mouth an opening's bore is left out of every measurement,
    because the material around it ends at the mouth and is no wall. `opened` is the cavity where
    it leaks: its wall is told from the outside by the rims of the leaks, and what lies as near to
    these as a bore is deep is left out likewise.
    """

    shells: Shells
    openings: tuple[Opening, ...]
    bore_depth: float
    opened: OpenCavity | None = None

    @property
    def surface(self) -> Surface:
        """All of it, the plugs included."""
        return self.shells.surface

    @property
    def has_cavity(self) -> bool:
        """Whether the plugged part encloses any air, if need be with leaks."""
        return bool(self.shells.voids) or self.opened is not None

    @cached_property
    def of_cavity(self) -> Flags:
        """(m,): triangles of the cavity's wall."""
        if self.opened is not None:
            return self.opened.inside
        return np.isin(self.surface.shell_of_triangle, list(self.shells.voids))

    @cached_property
    def samples(self) -> Samples:
        """Points spread evenly over the whole surface but for the openings."""
        everywhere = sample(self.surface, SAMPLES_PER_SQUARE_MILLIMETRE, SAMPLE_BOUNDS)
        return everywhere.chosen(~self.at_openings(everywhere.points))

    @property
    def inside(self) -> Samples:
        """The samples on the cavity's wall."""
        return self.samples.chosen(self.of_cavity[self.samples.triangle])

    @property
    def outside(self) -> Samples:
        """The samples on the outside."""
        return self.samples.chosen(~self.of_cavity[self.samples.triangle])

    def at_openings(self, points: Floats) -> Flags:
        """(k,): which points (k, 3) lie on a plug, in a bore behind its mouth, or at a leak."""
        result = self.at_leaks(points)
        for opening in self.openings:
            result |= near_axis(points, opening, self.bore_depth)
        return result

    def at_leaks(self, points: Floats) -> Flags:
        """(k,): which points (k, 3) lie so near to a leak that walls end there."""
        from scipy.spatial import cKDTree

        if self.opened is None or not len(self.opened.rims):
            return np.zeros(len(points), dtype=bool)
        return np.asarray(cKDTree(self.opened.rims).query(points)[0] <= self.bore_depth)
