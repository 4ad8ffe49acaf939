"""The whole printability check of one part for one printer: the list of rules, applied in turn.

A new rule is a row of `printers/rule_table.py`, a file in `printers/rules` and a line in one of the
two lists here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from printers.errors import PrintersError
from printers.measure.part import MeasuredPart
from printers.model import PrintedModel
from printers.profile import PrinterProfile
from printers.profile.judging import judged
from printers.report import PrintabilityReport, RuleResult
from printers.rules.airtightness import check_airtightness
from printers.rules.envelope import check_bed_contact, check_build_volume, check_cross_section
from printers.rules.gaps import check_declared_gaps, check_measured_gaps
from printers.rules.integrity import (
    check_one_body,
    check_self_intersection,
    check_slivers,
    check_watertight,
)
from printers.rules.opening_walls import check_opening_walls
from printers.rules.openings import check_openings
from printers.rules.overhangs import check_overhangs
from printers.rules.passage import check_air_passage
from printers.rules.printing import check_layer_height, check_plastic
from printers.rules.sealing_walls import check_sealing_walls
from printers.rules.thickness import check_thickness
from printers.rules.walls import (
    check_declared_walls,
    check_measured_walls,
    check_walls_as_declared,
)

Rule = Callable[[MeasuredPart], Iterator[RuleResult]]

RULES_FOR_ANY_MESH: tuple[Rule, ...] = (
    check_watertight,
    check_self_intersection,
    check_slivers,
    check_layer_height,
    check_build_volume,
    check_cross_section,
    check_bed_contact,
    check_declared_walls,
    check_declared_gaps,
    check_one_body,
)
RULES_FOR_SOLIDS: tuple[Rule, ...] = (
    check_airtightness,
    check_measured_walls,
    check_walls_as_declared,
    check_sealing_walls,
    check_opening_walls,
    check_measured_gaps,
    check_overhangs,
    check_openings,
    check_thickness,
    check_air_passage,
    check_plastic,
)
"""They measure within the material, and need a mesh that bounds some."""

NEVER_SILENT = (
    "airtightness",
    "wall_multiple_measured",
    "minimum_lines",
    "minimum_layers",
    "thinnest_place",
)
"""Rules that fail where nothing can be measured: a report without them could pass for good."""


def check_printability(model: PrintedModel, profile: PrinterProfile) -> PrintabilityReport:
    """Apply every rule; see `printers.check_printability`."""
    part = MeasuredPart(model, profile)
    if not part.surface.areas.sum() > 0:
        raise PrintersError("the mesh has no triangle with an area")
    results = (judged(result, profile) for result in _results(part))
    return PrintabilityReport(profile.name, tuple(results))


def _results(part: MeasuredPart) -> Iterator[RuleResult]:
    for rule in RULES_FOR_ANY_MESH:
        yield from rule(part)
    try:
        for rule in RULES_FOR_SOLIDS:
            yield from rule(part)
    except PrintersError as error:  # the mesh bounds no solid
        yield from _not_measured(str(error))


def _not_measured(reason: str) -> Iterator[RuleResult]:
    for rule in NEVER_SILENT:
        message = f"cannot be measured: {reason}"
        yield RuleResult(rule, "fail", "not measured", "closed mesh", "", "whole mesh", message)
