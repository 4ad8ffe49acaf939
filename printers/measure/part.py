"""The part on its printer, and what the rules measure of it in common."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from printers.arrays import Flags
from printers.measure.boundary import Boundary
from printers.measure.leakage.leaks import OpenCavity, find_leaks
from printers.measure.passage.air_passage import AirPassage, narrowest_passage
from printers.measure.plugging import Sealing, seal
from printers.measure.shells import Shells, split_shells
from printers.measure.surface import Surface, merged_surface
from printers.measure.thickness.local_thickness import LocalThickness, local_thickness
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
    def opened(self) -> OpenCavity | None:
        """The cavity, where it leaks although the openings are plugged, and the leaks are found."""
        if not self.sealing.may_leak:
            return None
        return find_leaks(self.sealing.closed.surface, self.sealing.openings)

    @cached_property
    def boundary(self) -> Boundary:
        """The plugged surface, parted into the cavity's wall and the outside."""
        depth = BORE_DEPTH * max(self.profile.minimum_wall, self.profile.minimum_floor)
        return Boundary(self.sealing.closed, self.sealing.openings, depth, self.opened)

    @cached_property
    def thickness(self) -> LocalThickness:
        """Of the material below all of the surface, up to the thickest wall of perimeters alone."""
        boundary, reach = self.boundary, self.profile.thickest_wall_of_lines + 0.1
        return local_thickness(boundary.surface, boundary.samples, reach)

    @cached_property
    def passage(self) -> AirPassage | None:
        """The narrowest passage of the cavity's air, which there must be; None if it has none."""
        boundary, sealing = self.boundary, self.sealing
        triangles = boundary.surface.triangles[boundary.of_cavity]
        cavity = merged_surface(boundary.surface.vertices, triangles)
        return narrowest_passage(
            cavity, sealing.part.surface, boundary.openings, self.profile.minimum_gap
        )

    @cached_property
    def walls(self) -> WallSurvey:
        """Every wall of the cavity, or of the whole part if it has none."""
        return survey_walls(self.boundary, self.model.walls, self.profile)
