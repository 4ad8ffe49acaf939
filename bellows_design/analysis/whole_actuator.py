"""From an equilibrium of the body that was solved to the whole actuator, its ends included."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.models import HALF, UNIT_CELL

if TYPE_CHECKING:
    from solver import PathPoint, Peak, Solution


ENDS_NOISE = 1.15
"""Ratio of the highest stresses of ends and cell, both on coarse meshes, that the meshes alone may
make: up to 1.12 where the half model finds its highest stress in the middle."""


@dataclass(frozen=True)
class Reading:
    """What one equilibrium says about the whole actuator.

    The rotation of the tip against the root passes 360° where it curls on; ``cavity_volume_mm3`` is
    the air inside the deformed actuator.
    """

    pressure_mpa: float
    bending_angle_deg: float
    max_von_mises_mpa: float
    cavity_volume_mm3: float


@dataclass(frozen=True)
class FoldedElements:
    """Elements that the load folds: their volume ratio is negative somewhere.

    ``position_mm``: centre of the one nearest to the highest stress, in the undeformed actuator;
    None without any. ``at_highest_stress``: one of them has the node of the highest stress, or
    touches an element that has it.
    """

    count: int = 0
    position_mm: tuple[float, float, float] | None = None
    at_highest_stress: bool = False

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence if there are any away from the highest stress; there they are a refusal."""
        if not self.count or self.at_highest_stress:
            return ()
        return (f"{self.text}, away from the highest stress.",)

    @property
    def text(self) -> str:
        """How many there are and where, without a full stop."""
        place = ", ".join(f"{x:.1f}" for x in self.position_mm or ())
        if self.count == 1:
            return f"1 element of the mesh folds under the load, at ({place}) mm"
        return f"{self.count} elements of the mesh fold under the load, the nearest at ({place}) mm"


NO_FOLDS = FoldedElements()


def reading(computation: Computation, point: PathPoint) -> Reading:
    """The whole actuator at a point on the path of one of the solutions."""
    angle, volume = point.rotation, computation.model.share * point.volume
    if computation.model is UNIT_CELL:
        count = computation.design.bellows.bubble_count
        turned, more = added_by_ends(computation, point)
        angle, volume = count * 2 * angle + turned, count * volume + more
    stress = ends_factor(computation) * point.max_von_mises
    return Reading(point.pressure + 0.0, angle, stress, volume)  # never -0


def ends_factor(computation: Computation) -> float:
    """How many times more the ends are stressed than the bubbles between them; 1 if not more."""
    if computation.ends_peak is None or not computation.peaks[0].value:
        return 1.0
    ratio = computation.ends_peak.value / computation.peaks[0].value
    return ratio if ratio > ENDS_NOISE else 1.0


def highest_stress(computation: Computation) -> tuple[float, tuple[float, float, float]]:
    """Highest von Mises stress of the whole actuator, MPa, and its place when undeformed, mm.

    Where the ends are stressed more, it is the cell's on the finest mesh times ``ends_factor``.
    """
    factor, peak = ends_factor(computation), computation.peaks[-1]
    if factor == 1.0 or computation.ends_peak is None:
        return peak.value, position(computation, peak)
    return factor * peak.value, _place_at_ends(computation, computation.ends_peak)


def _place_at_ends(computation: Computation, peak: Peak) -> tuple[float, float, float]:
    """Where a peak of the ends lies: in the first bubble or before it, else in the last or behind.

    Half bubbles without neighbours say of neither which; there it is the first.
    """
    x, y, z = peak.position
    middles = computation.design.bellows.bubble_middles
    ends = computation.ends
    if ends is not None and ends.problem.moving_plane is not None:
        return x + middles[0], y, z
    return (x + middles[-1] - middles[0] if x > middles[0] else x), y, z


def folded_elements(computation: Computation) -> FoldedElements:
    """Elements that the load folds, on the mesh whose highest stress counts.

    That is the finest, or the ends' where these are stressed more.
    """
    if ends_factor(computation) != 1.0 and computation.ends and computation.ends_peak:
        solution, peak, place = computation.ends, computation.ends_peak, _place_at_ends
    else:
        solution, peak, place = computation.finest, computation.peaks[-1], position
    found = folds_near(solution, peak)
    if found.position_mm is None:
        return found
    nearest = place(computation, replace(peak, position=found.position_mm))
    return replace(found, position_mm=nearest)


def folds_near(solution: Solution, peak: Peak) -> FoldedElements:
    """Elements that the load folds, with the place of the one nearest to the highest stress."""
    from solver import folded_elements as folds_in
    from solver.results.folds import folded_around

    folds = folds_in(solution)
    if not len(folds.elements):
        return NO_FOLDS
    distances = np.linalg.norm(folds.positions - np.array(peak.position), axis=1)
    x, y, z = (float(each) for each in folds.positions[distances.argmin()])
    near = folded_around(solution.problem.mesh, folds, peak.node)
    return FoldedElements(len(folds.elements), (x, y, z), near)


def final_readings(computation: Computation) -> tuple[Reading, ...]:
    """The end of the path of every mesh, the finest last."""
    return _readings(computation, (solution.path[-1] for solution in computation.solutions))


def path_readings(computation: Computation) -> tuple[Reading, ...]:
    """The load path of the coarsest mesh, with its end on the finest."""
    points = (*computation.solutions[0].path[:-1], computation.finest.path[-1])
    return _readings(computation, points)


def curve_readings(computation: Computation) -> tuple[Reading, ...]:
    """Readings at the pressures asked for: on the finest mesh, where its solve stopped at them.

    That on a mesh which is only a step to a finer one goes straight to the load. Where it stays the
    finest, as the budget ends the refinement, the points before its own come from a coarser mesh.
    """
    finest = _asked_points(computation, computation.finest)
    on_meshes = [_asked_points(computation, each) for each in reversed(computation.solutions)]
    most = max(on_meshes, key=len)  # the finest of those with as many
    before = [p for p in most if not finest or abs(p.pressure) < abs(finest[0].pressure)]
    return _readings(computation, [*before, *finest])


def _asked_points(computation: Computation, solution: Solution) -> list[PathPoint]:
    """The points of a solution's path that were asked for and that the finest mesh reached."""
    asked, end = computation.pressures, abs(computation.finest.pressure) * (1 + 1e-9)
    return [
        point
        for point in solution.path
        if abs(point.pressure) <= end and np.isclose(point.pressure, asked, atol=1e-12).any()
    ]


def added_by_ends(computation: Computation, point: PathPoint) -> tuple[float, float]:
    """Rotation (°) and volume (mm³) by which both ends differ from one bubble more.

    They are a short actuator's, or a bubble's without neighbours. Cell and ends have meshes of the
    same size, so that the mesh's own error drops out. Exact at the pressures asked for; between
    them in proportion to the cell's rotation.
    """
    ends, coarsest = computation.ends, computation.solutions[0]
    if ends is None:
        return 0.0, 0.0
    short, cell = _nearest(ends, point.pressure), _nearest(coarsest, point.pressure)
    if not np.isclose(short.pressure, point.pressure):
        short, cell = ends.path[-1], coarsest.path[-1]
    part = point.rotation / cell.rotation if short.pressure != point.pressure else 1.0
    if ends.problem.moving_plane is not None:  # a quarter of a bubble as well
        turned, more = 2 * short.rotation, UNIT_CELL.share * short.volume
    else:
        turned, more = short.rotation, HALF.share * short.volume
    return part * (turned - 2 * cell.rotation), more - UNIT_CELL.share * cell.volume


def position(computation: Computation, peak: Peak) -> tuple[float, float, float]:
    """Where a peak lies in the undeformed actuator, mm; of all bubbles alike, in the middle one."""
    x, y, z = peak.position
    middles = computation.design.bellows.bubble_middles
    return (x + middles[len(middles) // 2] if computation.model is UNIT_CELL else x), y, z


def _readings(computation: Computation, points: Iterable[PathPoint]) -> tuple[Reading, ...]:
    return tuple(reading(computation, point) for point in points)


def _nearest(solution: Solution, pressure: float) -> PathPoint:
    """The point of a solution's path nearest to a pressure."""
    return min(solution.path, key=lambda point: abs(point.pressure - pressure))
