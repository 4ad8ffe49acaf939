"""Local thickness: at every point of the surface the largest ball of material that touches it there
and an opposite face.

It needs neither a cavity nor flat faces, and no result depends on how the faces are cut into
triangles. Between parallel faces, and between spheres or cylinders of one centre, the ball is as
thick as the wall. Faces that open by more than 30 degrees are no wall: at the edge of a box nothing
is thin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats
from printers.measure.box_tree import first_hits
from printers.measure.distance.nearest import OPPOSITE, inscribed_diameters
from printers.measure.samples import Samples
from printers.measure.slabs import OFF_THE_SURFACE
from printers.measure.surface import Surface


@dataclass(frozen=True)
class LocalThickness:
    """Thickness at sample points.

    `samples`: where, each standing for the same area; `thickness` (k,) mm, inf where the material
    is thicker than was looked for, or nothing lies opposite.
    """

    samples: Samples
    thickness: Floats

    def chosen(self, which: Flags) -> LocalThickness:
        """The samples picked by (k,) flags."""
        return LocalThickness(self.samples.chosen(which), self.thickness[which])

    def of_area(self, area: float) -> int | None:
        """Number of the sample whose thickness is not exceeded on `area` mm²; None without one."""
        needed = max(1, int(np.ceil(area / self.samples.area)))
        if np.isfinite(self.thickness).sum() < needed:
            return None
        return int(np.argsort(self.thickness, kind="stable")[needed - 1])

    def area_by_units(self, unit: float, tolerance: float) -> dict[int, float]:
        """mm² of surface by the whole number of units, such as lines, that fit below it.

        A thickness may miss a whole number by the `tolerance`. What is thicker than was looked for
        is left out.
        """
        counts = np.floor((self.thickness[np.isfinite(self.thickness)] + tolerance) / unit)
        whole, samples = np.unique(counts.astype(np.int64), return_counts=True)
        areas = samples * self.samples.area
        return {int(count): float(area) for count, area in zip(whole, areas, strict=True)}


def local_thickness(surface: Surface, samples: Samples, reach: float) -> LocalThickness:
    """Measure the thickness below the `samples`, up to `reach` mm."""
    inwards = -samples.normals
    start = samples.points + OFF_THE_SURFACE * inwards
    across, hit = first_hits(surface.tree, start, start + reach * inwards, samples.triangle)
    # What the ray hits is opposite only if it faces the start; else a ball must find something.
    faces = np.einsum("ij,ij->i", surface.normals[hit], inwards) >= OPPOSITE
    opposite = np.isfinite(across) & faces
    largest = np.where(np.isfinite(across), across, reach)
    found, shrank = inscribed_diameters(
        surface.tree, surface.normals, samples.points, samples.normals, largest
    )
    found = found + OFF_THE_SURFACE
    return LocalThickness(samples, np.where(opposite | shrank, found, np.inf))
