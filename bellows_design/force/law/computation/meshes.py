"""What finer meshes of the same cell say of a table that was computed on the coarsest one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.force.law.computation.continuation import Continuation
from bellows_design.force.law.interpolation.points import SectionPoint
from bellows_design.force.law.interpolation.rows import Row

if TYPE_CHECKING:
    from bellows_design.analysis.computation import Computation


@dataclass(frozen=True)
class Correction:
    """Of what was computed on the coarsest mesh.

    Attributes:
        softening: ratio of the free rotations of the finest and of the coarsest mesh.
        error: of the corrected rotation, rad: what the last mesh changed, and by how much the
            correction fails where the half bubble is pressed back.
        stress_factor: ratio of their highest stresses.
    """

    softening: float
    error: float
    stress_factor: float

    @staticmethod
    def of(computation: Computation, row: Row) -> Correction:
        """By the meshes of an evaluation; ``row``: at its pressure on the coarsest one."""
        peaks = computation.peaks
        turned = [float(np.radians(solution.rotation)) for solution in computation.solutions]
        if len(turned) < 2:
            return Correction(1.0, abs(turned[0]), 1.0)
        misfit = _misfit(computation, row) * abs((turned[-1] - turned[0]) / (turned[1] - turned[0]))
        return Correction(
            softening=turned[-1] / turned[0],
            error=abs(turned[-1] - turned[-2]) + misfit,
            stress_factor=peaks[-1].value / peaks[0].value,
        )


def _misfit(computation: Computation, row: Row) -> float:
    """By how much the second mesh's correction fails at a moment that presses back, rad."""
    second = computation.solutions[1]
    cell = Continuation.of(computation.design, second.problem.mesh)
    free = cell.known(second)
    pressed, at_rest = _pressed_back(row), row.nearest(0.0)
    found = cell.beside(free, pressed.pressure, pressed.moment)
    if isinstance(found, str):
        return abs(free.point.rotation - at_rest.rotation)
    softening = free.point.rotation / at_rest.rotation
    return abs(found.point.rotation - softening * pressed.rotation)


def _pressed_back(row: Row) -> SectionPoint:
    """The point that has lost half of the free rotation, about."""
    half = row.nearest(0.0).rotation / 2
    return min(row.points, key=lambda point: abs(point.rotation - half))
