"""The whole run: check, evaluate, decide, and files of what is approved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.design.overrides import renamed_if_changed
from bellows_design.studio.choices.changed import changed, design_of_text
from bellows_design.studio.tasks.places import store_at
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from collections.abc import Iterable

    Values = dict[str, Any]


FIRST = (".stl", ".3mf", ".step", "_report.html", "_sheet.html")
"""Endings of the files that most people want, in this order."""


def run(values: Values, _: Values, report: Report) -> None:
    """``bellows run`` of the page's design; a changed one is named after its digest as well."""
    from bellows_design import pipeline
    from bellows_design.reports.page.make import run_report

    base = design_of_text(values["base"])
    design = renamed_if_changed(changed(base, values["values"]), base)
    output, store = Path(values["output"]), store_at(values)
    outcome = pipeline.run(design, output, report, store=store, reporter=run_report)
    folder = outcome.folder
    report(
        "ran",
        name=design.name,
        approved=outcome.verdict.approved,
        reasons=[reason.message for reason in outcome.verdict.reasons],
        warnings=list(outcome.verdict.warnings),
        not_judged=[
            f"not judged: {each.rule}, as {each.why}" for each in outcome.verdict.not_judged
        ],
        folder=None if folder is None else str(folder),
        files=[] if folder is None else in_order_of_use(each.name for each in folder.iterdir()),
    )


def in_order_of_use(names: Iterable[str]) -> list[str]:
    """Names of an export's files: those that most people want, then the others by name."""

    def place(name: str) -> int:
        return next((n for n, ending in enumerate(FIRST) if name.endswith(ending)), len(FIRST))

    return sorted(names, key=lambda name: (place(name), name))
