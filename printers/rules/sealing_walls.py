"""Between the cavity and the outside there must be enough material to seal, everywhere.

Sideways the air crosses lines, upright layers, and obliquely both: lengths are counted in
`minimum_wall` along the bed and in `minimum_floor` across it, and the nearest outside in that count
must be at least 1 away. Where cavity and outside touch, the way has no direction but that in which
the outside looks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats
from printers.measure.part import MeasuredPart
from printers.measure.thickness.ways_out import WaysOut, ways_out
from printers.profile import PrinterProfile
from printers.report import RuleResult, against, at_least, place
from printers.tolerances import FACET_TOLERANCE, ROUNDING

UPRIGHT = float(np.cos(np.radians(30.0)))  # ways out this close to the vertical cross layers


@dataclass(frozen=True)
class Thinnest:
    """The weakest way out: `thickness` mm from `point` (3,) mm, of the `required` mm that way."""

    thickness: float
    required: float
    point: Floats


def check_sealing_walls(part: MeasuredPart) -> Iterator[RuleResult]:
    """The rules `minimum_lines`, and `minimum_layers` for ways out nearly upright."""
    profile = part.profile
    ways, scale = _ways_out(part), _scale(profile)
    sideways = np.abs(ways.direction[:, 2]) <= UPRIGHT
    lines = f"{profile.minimum_lines} lines of {profile.line_width:g} mm"
    layers = f"{profile.minimum_solid_layers} layers of {profile.layer_height:g} mm"
    for rule, which, made_of in (
        ("minimum_lines", sideways, lines),
        ("minimum_layers", ~sideways, layers),
    ):
        thinnest = _thinnest(ways.chosen(which), scale)
        yield _judge(rule, thinnest, part.boundary.has_cavity, made_of)


def _ways_out(part: MeasuredPart) -> WaysOut:
    """From every sampled point of the cavity's wall.

    Without a cavity only the parallel walls of the survey are left, each crossed at its middle.
    """
    if part.boundary.has_cavity:
        return ways_out(part.boundary, part.surface, _scale(part.profile))
    slabs = part.walls.slabs.chosen(part.walls.slabs.parallel)
    return WaysOut(slabs.middle, slabs.thickness, slabs.normal)


def _scale(profile: PrinterProfile) -> Floats:
    return np.array([profile.minimum_wall, profile.minimum_wall, profile.minimum_floor])


def _thinnest(ways: WaysOut, scale: Floats) -> Thinnest | None:
    if not len(ways.points):
        return None
    required = 1 / np.linalg.norm(ways.direction / scale, axis=1)
    weakest = int((ways.thickness / required).argmin())
    thickness = float(ways.thickness[weakest])
    return Thinnest(thickness, float(required[weakest]), ways.points[weakest])


def _judge(rule: str, thinnest: Thinnest | None, has_cavity: bool, made_of: str) -> RuleResult:
    scope = "" if has_cavity else "; only parallel walls, as no cavity closes"
    if thinnest is None:
        message = "no wall lies this way" + scope
        return RuleResult(rule, "pass", "none", made_of, "mm", "whole part", message)
    thickness, required = thinnest.thickness, thinnest.required
    tolerance, where = FACET_TOLERANCE + ROUNDING, place(thinnest.point)
    enough = thickness >= required - tolerance
    message = (
        f"the weakest place, {thickness:.3f} mm at {where}, "
        f"{'has' if enough else 'has less than'} the {made_of} that seal, {required:.3f} mm "
        f"that way: {against(thickness, required, tolerance)}{scope}"
    )
    return at_least(rule, thickness, required, tolerance, where, message).at(thinnest.point)
