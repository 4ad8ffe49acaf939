"""The whole printability check of one part for one printer."""

from __future__ import annotations

from collections.abc import Iterator

from printers.measure.boundary import Boundary
from printers.measure.shells import split_shells
from printers.measure.surface import Surface, merged_surface
from printers.model import PrintedModel
from printers.profile import PrinterProfile
from printers.report import PrintabilityReport, RuleResult
from printers.rules.airtightness import Sealing, check_airtightness, seal
from printers.rules.envelope import check_bed_contact, check_build_volume, check_cross_section
from printers.rules.gaps import check_declared_gaps, check_measured_gaps
from printers.rules.integrity import check_one_body, check_self_intersection, check_watertight
from printers.rules.overhangs import check_overhangs, measure_overhangs
from printers.rules.sealing_walls import check_sealing_walls
from printers.rules.walls import (
    check_declared_against_measured,
    check_declared_walls,
    check_measured_walls,
    survey_walls,
)

NEEDS_A_SOLID = ("airtightness", "wall_multiple_measured", "minimum_lines", "minimum_layers")
BORE_DEPTH = 1.5  # least walls: as deep as the bore of an opening is left out of the measurements


def check_printability(model: PrintedModel, profile: PrinterProfile) -> PrintabilityReport:
    """Apply every rule to the part, standing as it is modelled, on this printer.

    Deterministic: the same mesh always gives the same report, and another triangulation of the same
    faces the same verdicts. Raises ValueError if no triangle of the mesh has an area.
    """
    surface = merged_surface(model.vertices, model.triangles)
    if not surface.areas.sum() > 0:
        raise ValueError("the mesh has no triangle with an area")
    return PrintabilityReport(profile.name, tuple(_all_rules(model, surface, profile)))


def _all_rules(
    model: PrintedModel, surface: Surface, profile: PrinterProfile
) -> Iterator[RuleResult]:
    watertight = check_watertight(surface)
    yield watertight
    yield check_self_intersection(surface)
    yield from _envelope_rules(model, surface, profile)
    yield from check_declared_walls(model.walls, profile)
    yield from check_declared_gaps(model.gaps, profile)
    if watertight.verdict == "pass" and surface.volume() > 0:
        yield from _solid_rules(model, surface, profile)
    else:
        yield check_one_body(split_shells(surface))
        yield from _not_measured("the mesh is not closed with its normals pointing outwards")


def _envelope_rules(
    model: PrintedModel, surface: Surface, profile: PrinterProfile
) -> Iterator[RuleResult]:
    yield check_build_volume(surface, profile)
    if model.cross_section_limit is not None:
        yield check_cross_section(surface, model.cross_section_limit)
    yield check_bed_contact(surface, profile)


def _solid_rules(
    model: PrintedModel, surface: Surface, profile: PrinterProfile
) -> Iterator[RuleResult]:
    yield check_one_body(split_shells(surface))
    try:
        sealing = seal(surface, model.openings)
    except ValueError as error:
        yield from _not_measured(str(error))
        return
    yield check_airtightness(sealing)
    boundary = _boundary(sealing, profile)
    survey = survey_walls(boundary, model.walls, profile)
    yield from check_measured_walls(survey, profile)
    yield from check_declared_against_measured(model.walls, survey)
    yield from check_sealing_walls(boundary, survey, profile)
    yield from check_measured_gaps(boundary, model.gaps, profile)
    yield from check_overhangs(measure_overhangs(boundary, profile), profile)


def _boundary(sealing: Sealing, profile: PrinterProfile) -> Boundary:
    depth = BORE_DEPTH * max(profile.minimum_wall, profile.minimum_floor)
    return Boundary(sealing.closed, sealing.openings, depth)


def _not_measured(reason: str) -> Iterator[RuleResult]:
    for rule in NEEDS_A_SOLID:
        message = f"cannot be measured: {reason}"
        yield RuleResult(rule, "fail", "not measured", "closed mesh", "", "whole mesh", message)
