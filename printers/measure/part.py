"""The part on its printer, and what the rules measure of it in common."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from printers.arrays import Flags
from printers.measure.boundary import Boundary
from printers.measure.plugging import Sealing, seal
from printers.measure.shells import Shells, split_shells
from printers.measure.surface import Surface, merged_surface
from printers.measure.wall_survey import WallSurvey, survey_walls
from printers.model import PrintedModel
from printers.profile import PrinterProfile
from printers.tolerances import ROUNDING

BORE_DEPTH = 1.5  # least walls: as deep as the bore of an opening is left out of the measurements


@dataclass(frozen=True, eq=False)
class MeasuredPart:
    """A part standing on the bed of a printer; everything else is measured when first asked for.

    `sealing`, `boundary` and `walls` raise PrintersError if the mesh bounds no solid.
    """

    model: PrintedModel
    profile: PrinterProfile

    @cached_property
    def surface(self) -> Surface:
        """The mesh, its vertices merged."""
        return merged_surface(self.model.vertices, self.model.triangles)

    @cached_property
    def on_bed(self) -> Flags:
        """(m,): triangles that lie flat on the bed, which is under the lowest point."""
        low = self.surface.corners[:, :, 2] <= self.surface.bounds[0, 2] + ROUNDING
        return np.asarray(low.all(axis=1) & (self.surface.normals[:, 2] < 0))

    @cached_property
    def bed_rim(self) -> float:
        """Length, mm, of the rim of what lies on the bed."""
        edges = self.surface.half_edges[np.repeat(self.on_bed, 3)]
        number = self.surface.edge_number[np.repeat(self.on_bed, 3)]
        once = np.bincount(number)[number] == 1
        ends = self.surface.vertices[edges[once]]
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())

    @cached_property
    def shells(self) -> Shells:
        """The connected pieces of the surface."""
        return split_shells(self.surface)

    @cached_property
    def sealing(self) -> Sealing:
        """The part with its declared openings plugged."""
        return seal(self.shells, self.model.openings)

    @cached_property
    def boundary(self) -> Boundary:
        """The plugged surface, parted into the cavity's wall and the outside."""
        depth = BORE_DEPTH * max(self.profile.minimum_wall, self.profile.minimum_floor)
        return Boundary(self.sealing.closed, self.sealing.openings, depth)

    @cached_property
    def walls(self) -> WallSurvey:
        """Every wall of the cavity, or of the whole part if it has none."""
        return survey_walls(self.boundary, self.model.walls, self.profile)
