"""A first answer where nothing evaluated before has the same faces: the cell on a coarse mesh.

What the finer meshes and the ends would add is taken from the nearest evaluation, and the estimated
error is as wide as that is uncertain. Without any evaluation the error is not known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluate import evaluation_of
from bellows_design.analysis.mesh_sequence import begun, refined
from bellows_design.analysis.models import UNIT_CELL, choose
from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.errors import UnreachedError
from bellows_design.neighbours.carried import Carried
from bellows_design.studio.previews.continuation import Anchors
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from solver import Mesh

BUDGET = Budget(seconds=30.0)

OTHER_FACES = 0.05
"""Fraction of angle and stress that other faces may make besides."""


@dataclass(frozen=True)
class Coarse:
    """A preview on a coarse mesh, that mesh, and how it was found."""

    state: Evaluation
    mesh: Mesh
    how: str


def coarse(anchors: Anchors, design: Design, report: Report) -> Coarse:
    """The design's cell by itself on its coarsest mesh.

    Raises ``UnreachedError`` if the design has too few bubbles for a cell, or its load cannot be
    reached soon; and what meshing and CAD raise.
    """
    model, why = choose(design)
    if model is not UNIT_CELL:
        raise UnreachedError(f"no preview: {why}; the evaluation follows")
    computation = refined(begun(design, UNIT_CELL, why, (), report, BUDGET), report)
    if not computation.converged:
        raise UnreachedError(
            f"no preview: {computation.message.rstrip('.')}; the evaluation follows"
        )
    nearest = anchors.nearest(design)
    found = evaluation_of(computation)
    mesh = computation.finest.problem.mesh
    if nearest is None:
        return Coarse(found, mesh, "the unit cell on a coarse mesh, without the ends")
    how = "the unit cell on a coarse mesh; ends and mesh error from an earlier design"
    return Coarse(_corrected(found, computation, nearest.anchor), mesh, how)


def _corrected(found: Evaluation, computation: Computation, before: Evaluation) -> Evaluation:
    """With what finer meshes and ends made of another design."""
    if before.model is not UNIT_CELL:
        return found
    carried, former = Carried.of(before), before.computation
    turned = former.finest.path[-1].rotation / former.solutions[0].path[-1].rotation
    stressed = former.peaks[-1].value / former.peaks[0].value
    angle = found.bending_angle_deg * turned + carried.angle
    return replace(
        found,
        bending_angle_deg=angle,
        max_von_mises_mpa=found.max_von_mises_mpa * stressed * carried.stress,
        cavity_volume_mm3=found.cavity_volume_mm3 + carried.volume,
        error_estimate=ErrorEstimate(
            _percent(abs(turned - 1), carried.angle_error, angle),
            100 * (abs(stressed - 1) + (carried.stress_error or 0.0) + OTHER_FACES),
        ),
    )


def _percent(mesh: float, ends: float | None, angle: float) -> float | None:
    if ends is None or not angle:
        return None
    return 100 * (mesh + ends / abs(angle) + OTHER_FACES)
