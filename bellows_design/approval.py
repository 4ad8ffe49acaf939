"""The verdict: may this design be printed and pressurised?

Approved is a design for which every printability rule passes, the solver reached the design
pressure, the highest von Mises stress keeps its limit *including its estimated error*, and the
material is not strained beyond its elongation at break. Where the error reaches across the limit
nothing is decided: the answer is no, and the remedy is a finer mesh, not another design. A missing
rule or a missing error estimate is never taken for a pass. Strains outside of the range the
material was tested in are a warning: the range is that of the tests, not of the material.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Literal

from bellows_design.design.design import Design
from printers import PrintabilityReport

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import LoadedState
    from bellows_design.analysis.material_range import ReachedStrain

REQUIRED_RULES = ("watertight", "airtightness", "minimum_lines", "cross_section")
"""Rules a report must contain: one that was not checked is not a pass."""

Kind = Literal["printability", "convergence", "stress", "accuracy", "strain"]


@dataclass(frozen=True)
class Reason:
    """One reason against a design: the rule, what was found, what is required, and a sentence."""

    kind: Kind
    rule: str
    measured: float | int | str
    required: float | int | str
    unit: str
    message: str


@dataclass(frozen=True)
class Verdict:
    """Approved, or refused for all of its reasons.

    Attributes:
        reasons: What speaks against the design, from printability and evaluation; empty if it is
            approved.
        warnings: Sentences that decide nothing.
    """

    reasons: tuple[Reason, ...]
    warnings: tuple[str, ...] = ()

    @property
    def approved(self) -> bool:
        """True if nothing speaks against the design."""
        return not self.reasons

    @property
    def undecided(self) -> bool:
        """True if only the accuracy of the evaluation stands in the way: refine, decide again."""
        return bool(self.reasons) and all(reason.kind == "accuracy" for reason in self.reasons)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "approved": self.approved,
            "reasons": [asdict(reason) for reason in self.reasons],
            "warnings": list(self.warnings),
        }


def decide(design: Design, report: PrintabilityReport, state: LoadedState) -> Verdict:
    """The verdict on ``design``.

    Args:
        design: States the pressure to be reached (MPa) and the limit of the von Mises stress (MPa).
        report: Printability of its part.
        state: The actuator under pressure; an ``Evaluation`` is one.

    Returns:
        All reasons against the design; approval where there is none.
    """
    return Verdict((*_print_reasons(report), *_load_reasons(design, state)), state.warnings)


def _print_reasons(report: PrintabilityReport) -> tuple[Reason, ...]:
    failed = tuple(
        Reason("printability", rule.rule, rule.measured, rule.required, rule.unit, rule.message)
        for rule in report.rules
        if rule.verdict == "fail"
    )
    checked = {rule.rule for rule in report.rules}
    missing = tuple(
        Reason("printability", name, "not checked", "pass", "", f"{name} was not checked.")
        for name in REQUIRED_RULES
        if name not in checked
    )
    return failed + missing


def _load_reasons(design: Design, state: LoadedState) -> tuple[Reason, ...]:
    required, reached = design.load.pressure, state.pressure_mpa
    if not state.converged or not reached / required >= 1 - 1e-9:
        why = f": {state.message}" if state.message else "."
        message = f"The solver reached {reached:.4g} MPa of {required:g} MPa{why}"
        return (Reason("convergence", "pressure", reached, required, "MPa", message),)
    return (*_stress_reasons(design.max_von_mises, state), *_strain_reasons(state.strain))


def _strain_reasons(strain: ReachedStrain) -> tuple[Reason, ...]:
    limit = strain.elongation_at_break
    if limit is None or not strain.breaks:
        return ()
    reached, allowed = 100 * strain.highest, 100 * limit
    message = f"The material is strained to {reached:.3g} % but breaks at {allowed:.3g} %."
    return (Reason("strain", "elongation_at_break", reached, allowed, "%", message),)


def _stress_reasons(limit: float, state: LoadedState) -> tuple[Reason, ...]:
    stress, percent = state.max_von_mises_mpa, state.error_estimate.max_von_mises_percent
    if not math.isfinite(stress) or percent is None or not math.isfinite(percent):
        message = f"The highest von Mises stress, {stress:.3f} MPa, has no error estimate."
        return (Reason("accuracy", "max_von_mises", stress, limit, "MPa", message),)
    error = stress * abs(percent) / 100
    if stress + error <= limit:
        return ()
    if stress - error > limit:
        message = (
            f"The highest von Mises stress is {stress:.3f} ± {error:.3f} MPa, "
            f"{stress - limit:.3f} MPa above the limit of {limit:g} MPa."
        )
        return (Reason("stress", "max_von_mises", stress, limit, "MPa", message),)
    message = (
        f"The highest von Mises stress is {stress:.3f} MPa, and its estimated error of "
        f"{error:.3f} MPa reaches across the limit of {limit:g} MPa: refine the mesh."
    )
    return (Reason("accuracy", "max_von_mises", stress, limit, "MPa", message),)
