"""The wall around the bore of an opening, measured by itself.

The survey of walls leaves out what lies around a mouth, and elsewhere the part may have walls of
the same thickness; so a wall that is declared around an opening is measured from its bore outwards,
at right angles to the axis, and the narrowest place counts.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.box_tree import first_hits
from printers.measure.part import MeasuredPart
from printers.measure.samples import sample
from printers.measure.surface import Surface, label
from printers.model import DeclaredWall, Opening
from printers.profile import PrinterProfile
from printers.report import RuleResult, against, at_least, pass_or_fail
from printers.tolerances import FACET_TOLERANCE, ROUNDING, SMALLEST_AREA

SAMPLES_PER_SQUARE_MILLIMETRE = 40.0
SAMPLE_BOUNDS = (1_000, 20_000)
INWARDS = float(np.cos(np.radians(30.0)))  # facets of a bore look at its axis as closely as this
OFF_THE_SURFACE = 1e-6  # mm


def check_opening_walls(part: MeasuredPart) -> Iterator[RuleResult]:
    """The rules `wall_as_declared` and `minimum_lines` for every wall around an opening."""
    for wall in part.model.walls:
        if wall.around is not None:
            thickness = least_wall(part.surface, wall.around, 2 * wall.thickness + 1)
            yield _as_declared(wall, wall.around, thickness)
            yield _seals(wall, wall.around, thickness, part.profile)


def least_wall(surface: Surface, opening: Opening, reach: float) -> float | None:
    """Thickness, mm, that the wall around the bore exceeds on all but `SMALLEST_AREA`.

    Up to `reach` mm; None if there is no bore of that radius behind the mouth.
    """
    bore = np.flatnonzero(_of_bore(surface, opening))
    if not len(bore):
        return None
    points = sample(
        Surface(surface.vertices, surface.triangles[bore]),
        SAMPLES_PER_SQUARE_MILLIMETRE,
        SAMPLE_BOUNDS,
    )
    thickness = _outwards(surface, opening, points.points, bore[points.triangle], reach)
    needed = min(int(np.ceil(SMALLEST_AREA / points.area)), len(thickness))
    return float(np.partition(thickness, needed - 1)[needed - 1])


def _of_bore(surface: Surface, opening: Opening) -> Flags:
    """(m,): triangles of the bore, from its mouth on as far as it has the declared radius."""
    along, across = _frame(opening, surface.corners)
    radius = np.linalg.norm(across, axis=2)
    round_ = (np.abs(radius - opening.radius) <= 2 * FACET_TOLERANCE).all(axis=1)
    behind = (along <= opening.radius).all(axis=1)
    middle = across.mean(axis=1)
    looks_in = np.einsum("ij,ij->i", surface.normals, middle)
    inwards = looks_in <= -INWARDS * np.linalg.norm(middle, axis=1)
    chosen = np.asarray(round_ & behind & inwards)
    at_mouth = chosen & (along.max(axis=1) >= -FACET_TOLERANCE - ROUNDING)
    first, second, _ = surface.neighbours
    inside = chosen[first] & chosen[second]
    piece = label(len(chosen), first[inside], second[inside])
    return chosen & np.isin(piece, piece[at_mouth])


def _outwards(
    surface: Surface, opening: Opening, points: Floats, triangle: Ints, reach: float
) -> Floats:
    """(k,) mm of material from points (k, 3) of the bore at right angles to its axis."""
    across = _frame(opening, points)[1]
    direction = across / np.linalg.norm(across, axis=1)[:, None]
    start = points + OFF_THE_SURFACE * direction
    thickness = first_hits(surface.tree, start, start + reach * direction, triangle)[0]
    return np.where(np.isfinite(thickness), thickness, reach)


def _frame(opening: Opening, points: Floats) -> tuple[Floats, Floats]:
    """Of points (..., 3): their place (...) along the axis, from the mouth, and off it (..., 3)."""
    axis = np.asarray(opening.direction) / np.linalg.norm(opening.direction)
    offset = points - np.asarray(opening.centre)
    along = offset @ axis
    return along, offset - along[..., None] * axis


def _as_declared(wall: DeclaredWall, opening: Opening, thickness: float | None) -> RuleResult:
    where, required = wall.name, round(wall.thickness, 4)
    name = f"{wall.name} {wall.thickness:g} mm"
    if thickness is None:
        message = f"{name} was not found: no bore of that radius lies behind {opening.name}"
        return RuleResult("wall_as_declared", "fail", "none", required, "mm", where, message)
    found = abs(thickness - wall.thickness) <= FACET_TOLERANCE + ROUNDING
    message = (
        f"{name} {'was' if found else 'is not what was'} measured around {opening.name}: "
        f"{thickness:.3f} mm at the narrowest"
    )
    return RuleResult(
        "wall_as_declared",
        pass_or_fail(found),
        round(thickness, 3),
        required,
        "mm",
        where,
        message,
        FACET_TOLERANCE,
    )


def _seals(
    wall: DeclaredWall, opening: Opening, thickness: float | None, profile: PrinterProfile
) -> RuleResult:
    made_of = f"{profile.minimum_lines} lines of {profile.line_width:g} mm"
    required = round(profile.minimum_wall, 3)
    if thickness is None:
        message = f"{wall.name}: there is no wall around {opening.name} to seal"
        return RuleResult("minimum_lines", "fail", "none", required, "mm", wall.name, message)
    tolerance, needed = FACET_TOLERANCE + ROUNDING, profile.minimum_wall
    enough = thickness >= needed - tolerance
    message = (
        f"{wall.name}: the weakest place around {opening.name}, {thickness:.3f} mm, "
        f"{'has' if enough else 'has less than'} the {made_of} that seal, {needed:.3f} mm: "
        f"{against(thickness, needed, tolerance)}"
    )
    return at_least("minimum_lines", thickness, needed, tolerance, wall.name, message)
