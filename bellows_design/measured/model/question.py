"""What is asked of the model: which quantity, how it is defined, and up to which pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.design.scenes.scene import Scene
from bellows_design.measured.quantities import TANGENT, Quantity
from solver.arrays import Reals

POINTS = 12
"""Pressures at which the model is solved. What cubics between them are off by is part of the
curve's error."""

WITHIN = 0.97
"""Of the pressure at which a load path ended: so far a second evaluation goes, which then reaches
its pressure on all meshes and has an error estimate."""

LEAST_PART = 1e-3
"""Of the highest pressure: where a curve begins that does not begin at nothing, because of
weight."""

FACTORS = (0.6, 1.0, 1.7)
"""Of the stiffness, at which a part is computed where one curve does not tell all of them."""

UNKNOWN_ERROR = (
    "its error by the mesh is not known, as one mesh was all that the time allowed (--seconds "
    "gives it more)"
)


def mesh_count(count: int) -> str:
    """How many meshes there are, in words."""
    return f"{count} mesh{'es' * (count > 1)}"


@dataclass(frozen=True)
class Question:
    """A curve that is asked of the model.

    Attributes:
        quantity: What is measured.
        angle: ``tangent`` or ``chord``, of a bending angle.
        scene: What stands around a bellows, of a force; None for the usual load cell.
        scene_name: What messages call it.
        sign: Of the pressures: -1 for a vacuum.
    """

    quantity: Quantity
    angle: str = TANGENT
    scene: Scene | None = None
    scene_name: str = "blocked"
    sign: float = 1.0

    def pressures(self, highest: float) -> Reals:
        """Pressures of a curve up to the size ``highest``, MPa, signed, without zero. *Shape:*
        (POINTS,).
        """
        return self.sign * highest * np.arange(1, POINTS + 1) / POINTS
