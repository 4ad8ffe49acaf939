"""What is measured over pressure: angles, displacements of the tip, and forces."""

from __future__ import annotations

from typing import NamedTuple


class Quantity(NamedTuple):
    """What a curve shows.

    Attributes:
        name: As ``--quantity`` and the columns have it.
        unit: That it is counted in.
        words: What sentences call it.
        by_force: True of a force, which grows with the stiffness by itself.
    """

    name: str
    unit: str
    words: str
    by_force: bool = False

    @property
    def label(self) -> str:
        """Words and unit, for tables and pictures."""
        return f"{self.words}, {self.unit}"


ANGLE = Quantity("angle", "°", "bending angle")
DISPLACEMENT = Quantity("displacement", "mm", "displacement of the tip")
DISPLACEMENT_X = Quantity("displacement_x", "mm", "displacement of the tip along x")
DISPLACEMENT_Z = Quantity("displacement_z", "mm", "displacement of the tip along z")
FORCE = Quantity("force", "N", "force", by_force=True)

QUANTITIES = {
    each.name: each for each in (ANGLE, DISPLACEMENT, DISPLACEMENT_X, DISPLACEMENT_Z, FORCE)
}
"""Name -> quantity."""

TANGENT, CHORD = "tangent", "chord"
ANGLES = (TANGENT, CHORD)
"""Definitions of the bending angle: of the tip's rotation, or of the line from base to tip."""
