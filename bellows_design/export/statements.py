"""What an outcome states in the files of its export: in the manifest, beside it, and of the run."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from bellows_design.export.companions import leak_test_file, settings_files
from bellows_design.export.contents import contents
from bellows_design.geometry.tessellation import TOLERANCE
from bellows_design.machine import machine
from bellows_design.print_sheet import sheet_files
from bellows_design.printability import check_dict

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.pipeline import Outcome
    from printers import PrintabilityReport


DIGITS = 8
"""Significant digits of an evaluation's numbers in a manifest. Between one thread and two they were
seen to differ by 3e-13 at most: what is left out is the noise of the linear solver."""


def files_of(found: Outcome) -> dict[str, bytes]:
    """Name -> content of the files of an approved design, but for that of times and machine.

    They follow from what was found alone: the same findings give the same bytes.
    """
    return contents(found.part, found.verdict, grounds(found), companions(found))


def grounds(found: Outcome) -> dict[str, Any]:
    """What an approval rests on, as plain values for the manifest: no times, no machine."""
    evaluation = {} if found.evaluation is None else found.evaluation.to_dict()
    return {
        **plain_statement(found.design, found.report),
        "leak_test": found.leak_test.summary(),
        "evaluation": rounded({key: evaluation[key] for key in evaluation if key != "seconds"}),
        **rounded(scene_statements(found)),
    }


def scene_statements(found: Outcome) -> dict[str, Any]:
    """What a statement says of scenes; nothing for a design that names none."""
    if not found.design.limits.scenes:
        return {}
    return {"scenes": [each.to_dict() for each in found.scenes]}


def plain_statement(design: Design, report: PrintabilityReport) -> dict[str, Any]:
    """What of that needs neither evaluation nor slicer."""
    return {
        "design": design.model_dump(mode="json", exclude_none=True),
        "printer": design.profile().model_dump(mode="json"),
        "mesh_tolerance_mm": TOLERANCE,
        "check": check_dict(design, report),
    }


def rounded(value: Any) -> Any:
    """Plain values whose numbers have ``DIGITS`` significant digits."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS - 1}e}")
    if isinstance(value, dict):
        return {key: rounded(inner) for key, inner in value.items()}
    return [rounded(inner) for inner in value] if isinstance(value, list | tuple) else value


def companions(found: Outcome) -> dict[str, bytes]:
    """The files that go with the part."""
    return leak_test_file(found.leak_test) | settings_files(found.part) | sheet_files(found)


def run_statement(found: Outcome) -> dict[str, Any]:
    """What differs between two runs of one design: when, where, and how long."""
    evaluation = found.evaluation
    here = machine().to_dict()
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "from_cache": None if evaluation is None else evaluation.from_cache or None,
        "seconds": None if evaluation is None else evaluation.seconds.to_dict(),
        "leak_test": found.leak_test.measured(),
        "machine": {key: value for key, value in here.items() if key != "versions"},
    }
