"""From the options of ``bellows check`` to its answer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bellows_design.cli.answer import DONE, REFUSED, Answer
from bellows_design.cli.checking.options import CheckOptions
from bellows_design.cli.checking.subject import Subject, of_design, of_file
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.surroundings.memory import CHECK, require_address_space

if TYPE_CHECKING:
    from bellows_design.progress import Progress
    from printers import PrintabilityReport
    from printers.orientation.compare import JudgedStance
    from printers.orientation.turning import Turning


@dataclass(frozen=True, eq=False)
class _Judged:
    """A report, the way the part stands for it, and the ways that were compared."""

    report: PrintabilityReport
    turning: Turning
    compared: tuple[JudgedStance, ...] = ()


def check(options: CheckOptions) -> Answer:
    """Apply the rules of a printer to a design, a file or G-code."""
    options.require_consistent()
    require_address_space(CHECK)
    require_plot(options.picture)
    require_file(options.keep_gcode, ".gcode")
    if options.is_gcode:
        from bellows_design.cli.checking.gcode import check_gcode

        return check_gcode(options)
    return _check_part(options)


def _check_part(options: CheckOptions) -> Answer:
    from bellows_design.cli.checking.sliced import with_leak_test
    from bellows_design.progress import on_stderr

    up = options.turning()
    with on_stderr() as progress:
        subject = (of_design if options.is_design else of_file)(options, progress)
        found = (_best if options.orientation else _standing)(subject, up, progress)
        notes, report = _notes(subject, found.turning, options), found.report
        more: dict[str, Any] = {}
        if options.slice:
            report, said, slicing = with_leak_test(
                subject, report, found.turning, options, progress
            )
            notes, more = (*notes, *said), {"slicing": slicing}
    return _answer(subject, found, report, notes, _content(found, notes, options) | more)


def _standing(subject: Subject, up: Turning, progress: Progress) -> _Judged:
    """The part with a direction upwards, its places in the coordinates of its file."""
    from printers import check_printability
    from printers.orientation.turning import in_file, turned

    progress.stage("check")
    report = check_printability(turned(subject.model, up), subject.profile)
    return _Judged(in_file(report, subject.model, up), up)


def _best(subject: Subject, _: Turning, progress: Progress) -> _Judged:
    """The part in the best of all ways to stand."""
    from printers import check_printability
    from printers.orientation.compare import compare_orientations

    progress.stage("compare orientations")
    profile = subject.profile
    compared = compare_orientations(
        subject.model, profile, lambda model: check_printability(model, profile)
    )
    best = compared[0]
    if best.is_whole:
        return _Judged(best.report, best.stance.turning, compared)
    return replace(_standing(subject, best.stance.turning, progress), compared=compared)


def _notes(subject: Subject, turning: Turning, options: CheckOptions) -> tuple[str, ...]:
    if options.is_design:
        return subject.notes
    if turning.is_none:
        return (*subject.notes, "stands on the bed as in its file, z upwards")
    stands = f"stands with {turning.name} of its file upwards; places are in the file's coordinates"
    return (*subject.notes, f"{stands}, heights z above the bed")


def _content(found: _Judged, notes: tuple[str, ...], options: CheckOptions) -> dict[str, Any]:
    """What JSON says beside the part's identity and the report."""
    content: dict[str, Any] = {}
    if not options.is_design:
        content["up"] = found.turning.name
    if notes or not options.is_design:
        content["notes"] = list(notes)
    if found.compared:
        content["orientations"] = [each.to_dict() for each in found.compared]
    return content


def _answer(
    subject: Subject,
    found: _Judged,
    report: PrintabilityReport,
    notes: tuple[str, ...],
    more: dict[str, Any],
) -> Answer:
    from bellows_design.reports.check import report_table

    content = {**subject.identity, **report.to_dict(), **more}
    status = DONE if report.verdict == "pass" else REFUSED
    return Answer(content, report_table(subject.title, report, notes, found.compared), status)
