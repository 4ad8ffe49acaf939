"""Where a part stands on the bed: as it is printed, in the middle.

Slicers measure the bed from its front left corner, and 3MF wants everything in the positive octant.
A part that fits only so is turned by a right angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.export.part import Part
from printers.slicing.placing import turned_to_fit


@dataclass(frozen=True)
class Placement:
    """A turn about the vertical and a move that follows it.

    Attributes:
        turned: By a right angle, anticlockwise seen from above.
        move: mm along x, y and z.
    """

    turned: bool
    move: tuple[float, float, float]

    @property
    def rows(self) -> list[list[float]]:
        """(4, 3): what x, y and z become, and the move; a point is a row before them."""
        turn = (
            [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]
            if self.turned
            else [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        )
        return [*turn, [0.0, 0.0, 1.0], list(self.move)]

    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """``points``, (n, 3) mm, placed."""
        rows = np.array(self.rows)
        return np.asarray(points @ rows[:3] + rows[3])


STANDING_AS_MADE = Placement(False, (0.0, 0.0, 0.0))


def placement(part: Part) -> Placement:
    """In the middle of the bed of the part's printer; as it was made if it has none."""
    if part.profile is None:
        return STANDING_AS_MADE
    low, high = part.mesh.vertices.min(axis=0), part.mesh.vertices.max(axis=0)
    bed, turned = part.profile.build_volume, turned_to_fit(part.mesh.vertices, part.profile)
    extent = Placement(turned, (0.0, 0.0, 0.0))(np.array([low, high]))
    middle = extent.mean(axis=0)
    move = (bed[0] / 2 - middle[0], bed[1] / 2 - middle[1], -low[2])
    return Placement(turned, tuple(round(float(each), 6) + 0.0 for each in move))  # type: ignore[arg-type]
