"""A declared opening must be as wide as declared, and wide enough to stay open when printed.

Airtightness counts openings whatever their width, and no other rule measures at a mouth. The radius
of the widest pin that enters along the declared axis is the distance from the axis to the
projection along it of the material around the mouth, one line deep: the tube has to enter there,
and behind it may lie a narrower hole. Projections of a mesh have straight sides, so the distance is
exact.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from printers.arrays import Floats
from printers.measure.closest_point import closest_on_segments
from printers.measure.part import MeasuredPart
from printers.measure.plugging import PLUG_MARGIN, PLUG_SIDES, frame_of, solid_of
from printers.model import Opening
from printers.report import RuleResult, at_least, place
from printers.tolerances import FACET_TOLERANCE

if TYPE_CHECKING:
    from manifold3d import Manifold


def check_openings(part: MeasuredPart) -> Iterator[RuleResult]:
    """The rule `opening_width`: one result for every declared opening."""
    solid, profile = solid_of(part.surface), part.profile
    for opening in part.model.openings:
        diameter = free_diameter(solid, opening, profile.line_width)
        yield _judge(opening, diameter, profile.minimum_gap)


def free_diameter(solid: Manifold, opening: Opening, depth: float) -> float | None:
    """Diameter, mm, of the widest pin that enters the opening by `depth` mm along its axis.

    None if no material lies around the mouth, up to the radius of the plug.
    """
    start, end = _outline(solid, opening, depth)
    if not len(start):
        return None
    if _surrounds_axis(start, end):
        return 0.0
    nearest = closest_on_segments(start, end, np.zeros_like(start))
    return 2 * float(np.linalg.norm(nearest, axis=1).min())


def _outline(solid: Manifold, opening: Opening, depth: float) -> tuple[Floats, Floats]:
    """Start and end (k, 2), from the axis, of the segments around the projected material."""
    from manifold3d import Manifold

    frame = frame_of(opening)
    upright = solid.transform(np.column_stack([frame.T, -frame.T @ np.asarray(opening.centre)]))
    radius = opening.plug_radius + PLUG_MARGIN
    mouth = Manifold.cylinder(depth, radius, radius, PLUG_SIDES).translate((0.0, 0.0, -depth))
    polygons = (upright ^ mouth).project().to_polygons()
    start = np.concatenate([np.zeros((0, 2)), *polygons])
    ends = [np.roll(polygon, -1, axis=0) for polygon in polygons]
    return start, np.concatenate([np.zeros((0, 2)), *ends])


def _surrounds_axis(start: Floats, end: Floats) -> bool:
    """Whether material lies on the axis: then the outline winds around it once."""
    across = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
    turns = np.arctan2(across, np.einsum("ij,ij->i", start, end)).sum() / (2 * np.pi)
    return bool(abs(turns) > 0.5)


def _judge(opening: Opening, diameter: float | None, minimum_gap: float) -> RuleResult:
    required = max(2 * opening.radius, minimum_gap)
    where, needed = place(opening.centre), round(required, 3)
    if diameter is None:
        message = (
            f"no material lies within {opening.plug_radius + PLUG_MARGIN:g} mm of the axis of "
            f"{opening.name} at {where}: there is no mouth, or one wider than the "
            f"{2 * opening.radius:g} mm declared"
        )
        return RuleResult("opening_width", "fail", "none", needed, "mm", where, message)
    good = diameter >= required - 2 * FACET_TOLERANCE
    message = (
        f"the widest pin that enters {opening.name} measures {diameter:.3f} mm, "
        f"{'enough for' if good else 'less than'} the {required:g} mm "
        f"{'declared' if required > minimum_gap else 'that stay open when printed'} "
        f"(facets may take {FACET_TOLERANCE:g} mm on either side)"
    )
    return at_least("opening_width", diameter, required, 2 * FACET_TOLERANCE, where, message)
