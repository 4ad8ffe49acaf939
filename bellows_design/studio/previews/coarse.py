"""A first answer where nothing evaluated before has the same faces: the cell on a coarse mesh.

What the finer meshes and the ends would add is taken from the nearest evaluation, and the estimated
error is as wide as that is uncertain. Without any evaluation the error is not known. Designs with
the same faces are then continued from it, until the ordinary evaluation takes its place.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluate import evaluation_of
from bellows_design.analysis.mesh_sequence import begun, refined
from bellows_design.analysis.models import UNIT_CELL, choose
from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.errors import UnreachedError
from bellows_design.neighbours.carried import Carried
from bellows_design.studio.previews.continuation import Anchors
from bellows_design.studio.previews.light import LightNeighbourhood, TakenOver
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from solver import Mesh

BUDGET = Budget(seconds=60.0)

OTHER_FACES, OTHER_STRESS = 0.02, 0.05
"""Fractions of angle and stress that other faces may make besides."""

COARSE_STRESS = 0.35
"""Fraction by which the highest stress of another coarse mesh may be off, at least: where elements
lie at a fillet decides more than the design does (`tests/benchmarks/preview_errors.py`)."""


@dataclass(frozen=True)
class Coarse:
    """A preview on a coarse mesh, that mesh, and how it was found."""

    state: Evaluation
    mesh: Mesh
    how: str


def coarse(anchors: Anchors, design: Design, report: Report) -> Coarse:
    """The design's cell by itself on its coarsest mesh; others may be continued from it.

    Raises ``UnreachedError`` if the design has too few bubbles for a cell, or its load cannot be
    reached soon; and what meshing and CAD raise.
    """
    model, why = choose(design)
    if model is not UNIT_CELL:
        raise UnreachedError(f"no preview: {why}; the evaluation follows")
    computation = refined(begun(design, UNIT_CELL, why, (), report, BUDGET), report)
    if not computation.converged:
        message = computation.message.rstrip(".")
        raise UnreachedError(f"no preview: {message}; the evaluation follows")
    found, mesh = evaluation_of(computation), computation.finest.problem.mesh
    nearest = anchors.nearest(design)
    if nearest is None or nearest.anchor.model is not UNIT_CELL:
        return Coarse(found, mesh, "the unit cell on a coarse mesh, without the ends")
    how = "the unit cell on a coarse mesh; ends and mesh error from an earlier design"
    state, taken_over = _completed(found, nearest)
    anchors.add_provisional(found, taken_over)
    return Coarse(state, mesh, how)


def _completed(found: Evaluation, nearest: LightNeighbourhood) -> tuple[Evaluation, TakenOver]:
    """With what finer meshes and ends made of another design, and that."""
    more = nearest.taken_over
    angle = found.bending_angle_deg * more.rotation + more.ends.angle
    errors = _errors(nearest, more.ends, angle)
    state = replace(
        found,
        bending_angle_deg=angle,
        max_von_mises_mpa=found.max_von_mises_mpa * more.stress,
        cavity_volume_mm3=found.cavity_volume_mm3 * more.volume + more.ends.volume,
        error_estimate=errors,
    )
    return state, replace(more, errors=errors)


def _errors(nearest: LightNeighbourhood, ends: Carried, angle: float) -> ErrorEstimate:
    """Those of the other design, what it took over, and what other faces may make."""
    more, former = nearest.taken_over, nearest.taken_over.errors
    if former is not None:  # itself a coarse mesh: its errors hold all that
        return former
    turned, stressed = abs(more.rotation - 1), max(abs(more.stress - 1), COARSE_STRESS)
    return ErrorEstimate(
        _percent(turned, ends.angle_error, angle),
        100 * (stressed + (ends.stress_error or 0.0) + OTHER_STRESS),
    )


def _percent(mesh: float, ends: float | None, angle: float) -> float | None:
    if ends is None or not angle:
        return None
    return 100 * (mesh + ends / abs(angle) + OTHER_FACES)
