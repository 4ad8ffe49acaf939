"""Faces printed over air: roofs that must bridge, and overhangs that hang free.

Half a layer below a face that looks down, horizontal rays look for material that carries it; half a
layer above, they make sure that a printed strand reaches that far. A strand carried on two opposite
sides is a bridge, any other hangs free. Where each layer reaches out by less than one line over the
one below, the layers still carry each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from printers.arrays import Flags, Floats
from printers.measure.boundary import Boundary
from printers.measure.box_tree import first_hits
from printers.measure.curved_walls import facet_turn
from printers.measure.part import MeasuredPart
from printers.measure.samples import Samples
from printers.profile import PrinterProfile
from printers.report import RuleResult, Verdict, place
from printers.tolerances import SMALLEST_AREA

DIRECTIONS = 12  # every 15 degrees: a span is overestimated by 1 % at most
OF_FLAT, OF_CURVED = 0.01, 0.75  # of a span: what it may be off by under flat and round roofs
MOST_POINTS = 2_000  # rays go out in every direction from each


@dataclass(frozen=True)
class Overhangs:
    """Points on faces beyond the printer's overhang limit.

    `span` (k,) mm between material on opposite sides, at its narrowest, inf without; `roof` (k,):
    too level for one layer to carry the next; `in_cavity` (k,); `curved` (k,): on facets.
    `doubtful` mm² of facets have a true angle that may lie on the limit's other side.
    """

    samples: Samples
    span: Floats
    roof: Flags
    in_cavity: Flags
    curved: Flags
    doubtful: float

    @property
    def sampling(self) -> float:
        """mm². By how much an area may be off for being counted in samples."""
        return self.samples.area * float(np.sqrt(max(1, len(self.span))))


def measure_overhangs(boundary: Boundary, profile: PrinterProfile) -> Overhangs:
    """Find the faces beyond the limit that do not lie on the bed, and what carries them."""
    chosen = _thinned(boundary.samples.chosen(_steep(boundary, profile)))
    step = np.arctan2(profile.line_width, profile.layer_height)
    turn = facet_turn(boundary.surface)
    return Overhangs(
        chosen,
        _spans(boundary, chosen, profile),
        np.asarray(chosen.normals[:, 2] < -np.sin(step)),
        boundary.of_cavity[chosen.triangle],
        turn[chosen.triangle] > 0,
        _doubtful(boundary.samples, turn, profile),
    )


def check_overhangs(part: MeasuredPart) -> Iterator[RuleResult]:
    """Three rules.

    `bridge`: roofs inside fail when they span more than the printer bridges, those outside warn;
    `overhang` warns of faces that hang free; `support` says what is printed over air inside, where
    no support can be taken out.
    """
    overhangs = measure_overhangs(part.boundary, part.profile)
    yield _check_bridges(overhangs, part.profile)
    yield _check_free(overhangs, part.profile)
    yield _check_inside(overhangs)


def _check_bridges(overhangs: Overhangs, profile: PrinterProfile) -> RuleResult:
    limit = profile.maximum_bridge
    roofs = np.flatnonzero(overhangs.roof & np.isfinite(overhangs.span))
    if not len(roofs):
        message = "no roof spans air"
        return RuleResult("bridge", "pass", 0.0, limit, "mm", "whole part", message, 0.0)
    widest = roofs[overhangs.span[roofs].argmax()]
    span, where = float(overhangs.span[widest]), place(overhangs.samples.points[widest])
    too_wide = roofs[overhangs.span[roofs] > limit]
    inside = bool(overhangs.in_cavity[too_wide].any())
    message = f"the widest roof spans {span:.1f} mm at {where}; up to {limit:g} mm are bridged"
    verdict: Verdict = "fail" if inside else "warn" if len(too_wide) else "pass"
    share = OF_CURVED if overhangs.curved[widest] else OF_FLAT
    return RuleResult(
        "bridge", verdict, round(span, 2), limit, "mm", where, message, round(share * span, 2)
    ).at(overhangs.samples.points[widest])


def _check_free(overhangs: Overhangs, profile: PrinterProfile) -> RuleResult:
    free = ~np.isfinite(overhangs.span)
    area = float(free.sum() * overhangs.samples.area)
    angle, unsure = profile.maximum_overhang_angle, overhangs.doubtful + overhangs.sampling
    if area < SMALLEST_AREA:
        message = f"no face beyond {angle:g}° from the vertical hangs free"
        return RuleResult(
            "overhang", "pass", 0.0, 0.0, "mm²", "whole part", message, round(unsure, 1)
        )
    points = overhangs.samples.points[free]
    middle = points[np.linalg.norm(points - np.median(points, axis=0), axis=1).argmin()]
    where = place(middle)
    message = (
        f"{area:.0f} mm² beyond {angle:g}° from the vertical hang free, such as at {where}: "
        "expect a rough underside"
    )
    return RuleResult(
        "overhang", "warn", round(area, 1), 0.0, "mm²", where, message, round(unsure, 1)
    ).at(middle)


def _check_inside(overhangs: Overhangs) -> RuleResult:
    area = float(overhangs.in_cavity.sum() * overhangs.samples.area)
    message = "no face inside the cavity needs support"
    if area:
        message = (
            f"{area:.0f} mm² inside the cavity are printed over air: switch supports off, "
            "they could not be removed"
        )
    unsure = round(overhangs.doubtful + overhangs.sampling, 1)
    return RuleResult(
        "support",
        "info" if area else "pass",
        round(area, 1),
        "no support",
        "mm²",
        "cavity",
        message,
        unsure,
    )


def _doubtful(samples: Samples, turn: Floats, profile: PrinterProfile) -> float:
    """Area, mm², of facets that lie as near to the limit as half of their turn."""
    angle = np.degrees(np.arcsin(np.clip(-samples.normals[:, 2], -1, 1)))
    off = np.abs(angle - profile.maximum_overhang_angle)
    return float((off < turn[samples.triangle] / 2).sum() * samples.area)


def _steep(boundary: Boundary, profile: PrinterProfile) -> Flags:
    samples = boundary.samples
    limit = np.sin(np.radians(profile.maximum_overhang_angle)) + 1e-6
    above_bed = samples.points[:, 2] > boundary.surface.bounds[0, 2] + profile.layer_height / 2
    return np.asarray((samples.normals[:, 2] < -limit) & above_bed)


def _thinned(samples: Samples) -> Samples:
    step = -(-len(samples.points) // MOST_POINTS) or 1
    every = np.arange(len(samples.points)) % step == 0
    kept = samples.chosen(every)
    return Samples(kept.points, kept.normals, kept.triangle, samples.area * step)


def _spans(boundary: Boundary, samples: Samples, profile: PrinterProfile) -> Floats:
    """Narrowest distance between supports on two opposite sides of each point, mm."""
    half_layer = np.array([0.0, 0.0, profile.layer_height / 2])
    reach = 1.5 * profile.maximum_bridge
    spans = np.full(len(samples.points), np.inf)
    for angle in np.arange(DIRECTIONS) * np.pi / DIRECTIONS:
        ray = reach * np.array([np.cos(angle), np.sin(angle), 0.0])
        ahead = _support(boundary, samples.points, half_layer, ray)
        spans = np.minimum(spans, ahead + _support(boundary, samples.points, half_layer, -ray))
    return spans


def _support(boundary: Boundary, points: Floats, half_layer: Floats, ray: Floats) -> Floats:
    """Distance to the support below each point's strand; inf if the strand ends before it."""
    tree, below, above = boundary.surface.tree, points - half_layer, points + half_layer
    support = first_hits(tree, below, below + ray)[0]
    strand = first_hits(tree, above, above + ray)[0]
    return np.where(strand < support, np.inf, support)
