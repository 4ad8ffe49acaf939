"""From the options of ``bellows check`` to its answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, REFUSED, Answer
from bellows_design.cli.checking.options import CheckOptions
from bellows_design.cli.checking.subject import Subject, of_design, of_file
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.surroundings.memory import CHECK, require_address_space

if TYPE_CHECKING:
    from bellows_design.progress import Progress
    from printers.orientation.compare import JudgedStance
    from printers.orientation.turning import Turning


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
    from bellows_design.reports.check import report_table
    from printers import check_printability
    from printers.orientation.turning import in_file, parse_up, turned

    chosen = parse_up(options.up or "Z")
    with on_stderr() as progress:
        subject = (of_design if options.is_design else of_file)(options, progress)
        compared: tuple[JudgedStance, ...] = ()
        if options.orientation:
            compared = _compared(subject, progress)
            chosen = compared[0].stance.turning
        if compared and compared[0].is_whole:
            report = compared[0].report
        else:
            progress.stage("check")
            standing = turned(subject.model, chosen)
            report = in_file(check_printability(standing, subject.profile), chosen)
        notes, slicing = subject.notes, None
        if options.slice:
            report, more, slicing = with_leak_test(subject, report, chosen, options, progress)
            notes = (*notes, *more)
    if not options.is_design:
        notes = (*notes, _stands(chosen))
    content = {**subject.identity, **report.to_dict()}
    if not options.is_design:
        content |= {"up": chosen.name, "notes": list(notes)}
    if compared:
        content |= {"orientations": [each.to_dict() for each in compared]}
    if options.slice:
        content |= {"notes": list(notes), "slicing": slicing}
    status = DONE if report.verdict == "pass" else REFUSED
    return Answer(content, report_table(subject.title, report, notes, compared), status)


def _compared(subject: Subject, progress: Progress) -> tuple[JudgedStance, ...]:
    from printers import check_printability
    from printers.orientation.compare import compare_orientations

    progress.stage("compare orientations")
    profile = subject.profile
    return compare_orientations(
        subject.model, profile, lambda model: check_printability(model, profile)
    )


def _stands(turning: Turning) -> str:
    if turning.is_none:
        return "stands on the bed as in its file, z upwards"
    return (
        f"stands with {turning.name} of its file upwards; places are in the file's coordinates, "
        "heights z above the bed"
    )
