"""What the ordinary evaluation of the free actuator says about its cell's law."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.analysis.error_estimate import ENDS_ERROR, FREE_REACH_ERROR, REACH_ERROR
from bellows_design.analysis.whole_actuator import added_by_ends
from bellows_design.errors import BellowsError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation


@dataclass(frozen=True)
class FreeFinger:
    """The free actuator at its design pressure, against which a coarse cell's law is held.

    Attributes:
        mesh_error: Fraction of a rotation by which the coarsest mesh is off, estimated.
        ends_rotation: What both ends add to the bubbles' rotation, rad.
        ends_error: What of that is uncertain, rad.
        stress: Highest von Mises stress, MPa.
        stress_error_percent: Its estimated error.
    """

    mesh_error: float
    ends_rotation: float
    ends_error: float
    stress: float
    stress_error_percent: float

    @classmethod
    def of(cls, evaluation: Evaluation) -> FreeFinger:
        """Of an evaluation on two meshes or more.

        Raises:
            BellowsError: It did not reach its pressure, or has no error estimate.
        """
        errors, computation = evaluation.error_estimate, evaluation.computation
        angle, stress = errors.bending_angle_percent, errors.max_von_mises_percent
        if not evaluation.converged or angle is None or stress is None:
            why = evaluation.message or "there was no second mesh within the budget"
            raise BellowsError(f"the free finger has no result with an estimated error: {why}")
        added, _ = added_by_ends(computation, computation.finest.path[-1])
        short = computation.ends is not None and computation.ends.problem.moving_plane is None
        bubble = abs(evaluation.bending_angle_deg) / evaluation.design.bellows.bubble_count
        reach = (REACH_ERROR if short else FREE_REACH_ERROR) * bubble
        return cls(
            mesh_error=_mesh_error(evaluation),
            ends_rotation=math.radians(added),
            ends_error=math.radians(ENDS_ERROR * abs(added) + reach),
            stress=evaluation.max_von_mises_mpa,
            stress_error_percent=stress,
        )


def _mesh_error(evaluation: Evaluation) -> float:
    """The first mesh beside the last one, and what the last two differ by."""
    angles = [mesh.reading.bending_angle_deg for mesh in evaluation.meshes]
    last = abs(angles[-1])
    if not last or len(angles) < 2:
        return 0.0
    return (abs(angles[0] - angles[-1]) + abs(angles[-2] - angles[-1])) / last
