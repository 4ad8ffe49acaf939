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

from printers.arrays import Floats, Ints
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

    def quantile_area(self, area: float) -> int | None:
        """Number of the sample whose thickness is not exceeded on `area` mm²; None without one."""
        needed = max(1, int(np.ceil(area / self.samples.area)))
        if np.isfinite(self.thickness).sum() < needed:
            return None
        return int(np.argsort(self.thickness, kind="stable")[needed - 1])

    def area_by_lines(self, line_width: float, tolerance: float, most: int) -> Floats:
        """(most + 2,) mm² of surface by the number of whole lines that fit below it, from none.

        A thickness may miss a whole number by the `tolerance`; the last entry holds all that is
        thicker than `most` lines.
        """
        counts = np.floor((self.thickness + tolerance) / line_width)
        whole: Ints = np.where(np.isfinite(counts), counts, most + 1).clip(max=most + 1).astype(int)
        return np.bincount(whole, minlength=most + 2) * self.samples.area


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
