"""What was found for a design as the page shows it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from bellows_design.design.design import Design
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import LoadedState
    from bellows_design.approval import Reason
    from printers import PrintabilityReport

    Values = dict[str, Any]

PREVIEW, REFINED = "preview", "refined"

NOT_OF_A_PREVIEW = "history"
"""The rule that a preview breaks by being one."""


def answer_of(
    design: Design,
    found: LoadedState,
    state: str,
    how: str,
    seconds: float,
    report: PrintabilityReport | None = None,
) -> Values:
    """Figures, and what speaks against the design under its load; with its print check if given."""
    errors, reasons = found.error_estimate, _reasons(design, found, report)
    return {
        "state": state,
        "pressure_mpa": found.pressure_mpa,
        "bending_angle_deg": found.bending_angle_deg,
        "angle_error_percent": errors.bending_angle_percent,
        "max_von_mises_mpa": found.max_von_mises_mpa,
        "stress_error_percent": errors.max_von_mises_percent,
        "stress_limit_mpa": design.max_von_mises,
        "cavity_volume_mm3": found.cavity_volume_mm3,
        "converged": found.converged,
        "message": found.message,
        "verdict": _verdict(reasons),
        "reasons": [reason.message for reason in reasons],
        "warnings": list(dict.fromkeys(_warnings(design, found))),
        "how": how,
        "seconds": seconds,
    }


def _warnings(design: Design, found: LoadedState) -> Iterator[str]:
    """What makes the figures less reliable, and what they say nothing of."""
    yield from design.material.warnings
    yield from found.warnings
    for name in design.limits.scenes:
        yield f"whether it holds the scene {quoted(name)} is judged by the whole run only."


def _reasons(
    design: Design, found: LoadedState, report: PrintabilityReport | None
) -> tuple[Reason, ...]:
    from bellows_design.approval import decide
    from printers import PrintabilityReport

    checked = report or PrintabilityReport("", ())
    return tuple(
        reason
        for reason in decide(design, checked, found).reasons
        if reason.rule != NOT_OF_A_PREVIEW
        and reason.kind != "scene"
        and (report is not None or reason.kind != "printability")
    )


def _verdict(reasons: Iterable[Reason]) -> str:
    """``pass``, ``fail``, or ``undecided`` where only the accuracy leaves it open."""
    kinds = {reason.kind for reason in reasons}
    return "pass" if not kinds else "undecided" if kinds == {"accuracy"} else "fail"
