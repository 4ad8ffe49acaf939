"""What takes its time: CAD and the rules measured on it, the ordinary evaluation, derivatives."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.studio.choices.changed import changed, design_of_text
from bellows_design.studio.tasks.answers import REFINED, answer_of
from bellows_design.studio.tasks.places import solving, store_at
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from collections.abc import Callable

    from bellows_design.analysis.evaluation import Evaluation
    from printers import PrintabilityReport

    Values = dict[str, Any]
    Task = Callable[[Values, Values, Report], None]


@dataclass
class Known:
    """What this process found last: the print check and the evaluation, of which designs."""

    reports: dict[str, PrintabilityReport] = field(default_factory=dict)
    evaluations: dict[str, Evaluation] = field(default_factory=dict)

    def keep(self, kind: dict[str, Any], design: Design, found: Any) -> None:
        """Keep the last one only."""
        kind.clear()
        kind[design.digest] = found


def tasks() -> dict[str, Task]:
    """By their names."""
    from bellows_design.studio.tasks.making import run
    from bellows_design.studio.tasks.scenes import scene

    known = Known()
    return {
        "part": lambda values, _, report: _part(known, values, report),
        "refine": lambda values, _, report: _refine(known, values, report),
        "sensitivities": lambda values, _, report: _sensitivities(known, values, report),
        "scene": scene,
        "run": run,
    }


def _part(known: Known, values: Values, report: Report) -> None:
    """The printed part's shape, and the rules measured on it."""
    from bellows_design.pipeline import build_part, check
    from bellows_design.studio.display.declared import light
    from bellows_design.studio.tasks.looks import part as look

    design = changed(design_of_text(values["base"]), values["values"])
    report.stage("geometry")
    part = build_part(design)
    report.shown("shape", look(part.mesh), source="cad")
    report.stage("print check")
    found = check(design, part)
    known.keep(known.reports, design, found)
    report("lights", source="measured", lights=[light(result) for result in found.rules])


def _refine(known: Known, values: Values, report: Report) -> None:
    """The ordinary evaluation, which ``bellows evaluate`` gives too."""
    from bellows_design.deformed import deformed_surface
    from bellows_design.store.lookup import evaluated
    from bellows_design.store.records import record_of
    from bellows_design.studio.tasks.looks import deformed
    from solver.errors import SolverError

    design, began = changed(design_of_text(values["base"]), values["values"]), time.perf_counter()
    with solving(report):
        found = evaluated(design, progress=report, store=store_at(values))
    known.keep(known.evaluations, design, found)
    checked, seconds = known.reports.get(design.digest), time.perf_counter() - began
    count = len(found.meshes)
    how = f"evaluated by itself on {count} {'mesh' if count == 1 else 'meshes'}"
    report("answer", **answer_of(design, found, REFINED, how, seconds, checked))
    record, arrays = record_of(found)
    report("evaluated", arrays, record=record)
    try:
        report.shown("deformed", deformed(deformed_surface(found)), state=REFINED)
    except (BellowsError, SolverError) as error:
        report("failed", what="deformed", message=str(error))


def _sensitivities(known: Known, values: Values, report: Report) -> None:
    """Derivatives of angle and stress by every parameter."""
    from bellows_design.neighbours.sensitivities import ANGLE, STRESS, sensitivities
    from bellows_design.store.lookup import evaluated

    design = changed(design_of_text(values["base"]), values["values"])
    found = known.evaluations.get(design.digest)
    if found is None:
        found = evaluated(design, progress=report, store=store_at(values))
    report.stage("sensitivities")
    rows = [
        {
            "parameter": row.parameter,
            "unit": row.unit,
            "angle_per_unit": row.derivatives[ANGLE],
            "stress_per_unit": row.derivatives[STRESS],
        }
        for row in sensitivities(found).parameters
    ]
    report("sensitivities", sensitivities=rows)
