"""The leak test on G-code, appended to the geometric rules."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.cli.checking.options import CheckOptions
from bellows_design.cli.checking.subject import Subject

if TYPE_CHECKING:
    from bellows_design.progress import Progress
    from printers.leak_test.result import LeakTest
    from printers.orientation.turning import Turning
    from printers.report import PrintabilityReport
    from printers.slicing.finding import Slicer

Extended = tuple["PrintabilityReport", tuple[str, ...], "dict[str, Any] | None"]
"""Report with the rules of the leak test, notes, and what JSON says of the slicing."""

NOT_TESTED = "so no leak test was run: the verdict stands on the geometric rules"
RULE = "leak_test"


def with_leak_test(
    subject: Subject,
    report: PrintabilityReport,
    turning: Turning,
    options: CheckOptions,
    progress: Progress,
) -> Extended:
    """Slice the part and test the G-code, where there is a slicer."""
    from printers.errors import PrintersError
    from printers.slicing.finding import find_slicer

    why, slicer = "there is no slicer", None
    try:
        slicer = find_slicer()
    except PrintersError as error:
        why = str(error).rstrip(".")
    if slicer is None:
        if not options.require_slicer:
            return report, (f"{why}, {NOT_TESTED}",), None
        return _with_failure(report, f"{why}, but the leak test is required"), (), None
    if not subject.model.openings:
        return report, ("without an opening there is no leak test",), None
    try:
        return _tested(subject, report, turning, options, progress, slicer)
    except PrintersError as error:
        return _with_failure(report, f"the leak test could not be run: {error}"), (), None


def _tested(
    subject: Subject,
    report: PrintabilityReport,
    turning: Turning,
    options: CheckOptions,
    progress: Progress,
    slicer: Slicer,
) -> Extended:
    from printers.sliced_check import check_sliced
    from printers.slicing.working_folder import working_folder

    progress.stage(f"slice with {slicer.name} {slicer.version}, and leak test")
    with working_folder() as folder:
        found = check_sliced(subject.model, subject.profile, turning, slicer, folder)
        made = (folder / "part.gcode").read_bytes() if options.keep_gcode else b""
    if options.keep_gcode is not None:
        _keep(made, options.keep_gcode)
    said = (
        f"sliced with {found.sliced.slicer} {found.sliced.version}, profile "
        f"{found.sliced.profile_digest[:16]}",
        *found.notes,
        *drawn(found.leaks, options.picture),
    )
    return replace(report, rules=(*report.rules, *found.leaks.rules)), said, found.to_dict()


def drawn(leaks: LeakTest, path: Path | None) -> tuple[str, ...]:
    """Write the picture of the layer in question, if one is wanted; a note where there is none."""
    if path is None:
        return ()
    if leaks.view is None:
        return ("no picture was drawn: no path leads to the outside",)
    from bellows_design.files.atomic import replacing
    from printers.leak_test.picture import leak_picture

    content = leak_picture(leaks)
    with replacing(path) as temporary:
        temporary.write_bytes(content)
    return (f"{path}: the layer with {'the leak' if leaks.leaks else 'the thinnest seal'}",)


def _keep(made: bytes, path: Path) -> None:
    from bellows_design.files.atomic import replacing

    with replacing(path) as temporary:
        temporary.write_bytes(made)


def _with_failure(report: PrintabilityReport, message: str) -> PrintabilityReport:
    from printers.report import RuleResult

    failure = RuleResult(RULE, "fail", "not run", "sealed", "", "whole part", message)
    return replace(report, rules=(*report.rules, failure))
