"""The figures of a part's sheet, all from its design, its mesh and its evaluation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.print_sheet.air_loss import hole_of_loss
from bellows_design.printability import declared_walls

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.analysis.whole_actuator import Reading
    from bellows_design.design.design import Design
    from bellows_design.pipeline import Outcome
    from printers import PrinterProfile

HOLD_SECONDS = 60
ALLOWED_LOSS = 0.05
"""Fraction of the pressure that may be lost in that time: our choice. Printed TPU that counted as
airtight lost 10 of 220, 6 of 160 and 6 of 50 kPa in 120 s (arXiv 2609.24499), that is 4.5, 3.75 and
12 %."""


@dataclass(frozen=True)
class Wall:
    """A declared wall: its name, thickness in mm, and how many lines or layers it is made of."""

    name: str
    thickness: float
    count: float
    made_of: str


@dataclass(frozen=True)
class ExpectedAngle:
    """Bending angle at a pressure (MPa), degrees; ``error`` is None where it is not estimated."""

    pressure: float
    angle: float
    error: float | None


@dataclass(frozen=True)
class Figures:
    """All that stands on a sheet and is this part's own.

    Attributes:
        design: Names, load and limits.
        profile: Printer, filament and settings.
        extents: Of the part as it stands, mm.
        plastic: That is fed: the part's volume times the flow, mm³.
        walls: Declared walls.
        angles: At one or two pressures, the design's last.
        highest_stress: MPa, with its estimated error in percent.
        volume_at_rest: Of the cavity, mm³; None if the path does not begin there.
        volume_under_pressure: mm³.
        hole: Diameter of the hole through the thinnest wall by which the allowed loss is lost, mm;
            None if it is not known.
        warnings: Of the verdict.
        leak_test: Result of that on the G-code, and why it was not run.
    """

    design: Design
    profile: PrinterProfile
    extents: tuple[float, float, float]
    plastic: float
    walls: tuple[Wall, ...]
    angles: tuple[ExpectedAngle, ...]
    highest_stress: tuple[float, float | None]
    volume_at_rest: float | None
    volume_under_pressure: float
    hole: float | None
    warnings: tuple[str, ...]
    leak_test: tuple[str, str]

    @property
    def thinnest(self) -> Wall:
        """The thinnest of the declared walls."""
        return _thinnest(self.walls)

    @property
    def mass(self) -> float:
        """Of the plastic, g."""
        return self.plastic * self.profile.filament.density / 1000

    @property
    def filament_length(self) -> float:
        """Of the filament that is fed, m."""
        return self.plastic / (math.pi / 4 * self.profile.filament.diameter**2) / 1000

    @property
    def least_hours(self) -> float:
        """Time to feed it at the print speed, without travels and slower first layers, h."""
        return self.plastic / self.profile.volumetric_flow / 3600


def figures_of(found: Outcome, evaluation: Evaluation) -> Figures:
    """The figures of an evaluated design."""
    profile, mesh = found.design.profile(), found.part.mesh
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    path, error = evaluation.path, evaluation.error_estimate.max_von_mises_percent
    walls = _walls(found.design, profile)
    x, y, z = (high - low).tolist()
    return Figures(
        design=found.design,
        profile=profile,
        extents=(x, y, z),
        plastic=mesh.volume * profile.slicer.flow / 100,
        walls=walls,
        angles=_angles(evaluation),
        highest_stress=(evaluation.max_von_mises_mpa, error),
        volume_at_rest=next(
            (each.cavity_volume_mm3 for each in path if not each.pressure_mpa), None
        ),
        volume_under_pressure=evaluation.cavity_volume_mm3,
        hole=_hole(path, evaluation.pressure_mpa, _thinnest(walls).thickness),
        warnings=found.verdict.warnings,
        leak_test=(found.leak_test.result, found.leak_test.why),
    )


def _walls(design: Design, profile: PrinterProfile) -> tuple[Wall, ...]:
    one = {"lines": profile.line_width, "layers": profile.layer_height}
    return tuple(
        Wall(each.name, each.thickness, each.thickness / one[each.kind], each.kind)
        for each in declared_walls(design)
    )


def _thinnest(walls: tuple[Wall, ...]) -> Wall:
    return min(walls, key=lambda wall: wall.thickness)


def _angles(evaluation: Evaluation) -> tuple[ExpectedAngle, ...]:
    """The angle about half-way, as far as the path has such a place, and at the design pressure."""
    percent = evaluation.error_estimate.bending_angle_percent
    last = evaluation.pressure_mpa
    end = _expected(last, evaluation.bending_angle_deg, percent)
    between = [each for each in evaluation.path if 0 < each.pressure_mpa / last < 1 - 1e-9]
    if not between:
        return (end,)
    nearest = min(between, key=lambda each: round(abs(each.pressure_mpa / last - 0.5), 6))
    coarse = _coarseness(evaluation)
    wider = None if percent is None or coarse is None else percent + coarse
    return _expected(nearest.pressure_mpa, nearest.bending_angle_deg, wider), end


def _coarseness(evaluation: Evaluation) -> float | None:
    """By how much the coarsest mesh, which the path is on, is off from the finest, percent."""
    first, angle = evaluation.meshes[0].reading, evaluation.bending_angle_deg
    if first.pressure_mpa != evaluation.pressure_mpa or not angle:
        return None
    return 100 * abs(first.bending_angle_deg - angle) / abs(angle)


def _expected(pressure: float, angle: float, percent: float | None) -> ExpectedAngle:
    return ExpectedAngle(pressure, angle, None if percent is None else abs(angle) * percent / 100)


def _hole(path: tuple[Reading, ...], pressure: float, length: float) -> float | None:
    if len(path) < 2:
        return None
    return hole_of_loss(path, pressure, ALLOWED_LOSS, HOLD_SECONDS, length)
