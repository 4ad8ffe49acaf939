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
from typing import Any, Literal, Protocol

from bellows_design.design.design import Design
from printers import PrintabilityReport

REQUIRED_RULES = ("watertight", "airtightness", "minimum_lines", "cross_section")
"""Rules a report must contain, else their silence would count as consent."""

Kind = Literal["printability", "convergence", "stress", "accuracy", "strain"]


class ErrorEstimate(Protocol):
    """Part of an evaluation: how far off its numbers may be, in percent of themselves."""

    @property
    def max_von_mises_percent(self) -> float | None: ...


class Strain(Protocol):
    """Part of an evaluation: how far the material is strained, as fractions."""

    @property
    def highest(self) -> float: ...
    @property
    def elongation_at_break(self) -> float | None: ...
    @property
    def breaks(self) -> bool: ...


class Evaluated(Protocol):
    """What approval needs to know of an evaluation."""

    @property
    def converged(self) -> bool: ...
    @property
    def message(self) -> str: ...
    @property
    def pressure_mpa(self) -> float: ...
    @property
    def max_von_mises_mpa(self) -> float: ...
    @property
    def error_estimate(self) -> ErrorEstimate: ...
    @property
    def strain(self) -> Strain: ...
    @property
    def warnings(self) -> tuple[str, ...]: ...


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
    """Approved, or refused for all of ``reasons``; ``warnings`` decide nothing."""

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


def decide(design: Design, report: PrintabilityReport, evaluation: Evaluated) -> Verdict:
    """The verdict on ``design`` from its printability report and its evaluation."""
    reasons = (*_print_reasons(report), *_load_reasons(design, evaluation))
    return Verdict(reasons, evaluation.warnings)


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


def _load_reasons(design: Design, evaluation: Evaluated) -> tuple[Reason, ...]:
    required, reached = design.load.pressure, evaluation.pressure_mpa
    if not evaluation.converged or not reached / required >= 1 - 1e-9:
        told = f": {evaluation.message}" if evaluation.message else "."
        message = f"The solver reached {reached:.4g} MPa of {required:g} MPa{told}"
        return (Reason("convergence", "pressure", reached, required, "MPa", message),)
    return (*_stress_reasons(design.max_von_mises, evaluation), *_strain_reasons(evaluation.strain))


def _strain_reasons(strain: Strain) -> tuple[Reason, ...]:
    limit = strain.elongation_at_break
    if limit is None or not strain.breaks:
        return ()
    reached, allowed = 100 * strain.highest, 100 * limit
    message = f"The material is strained to {reached:.3g} % but breaks at {allowed:.3g} %."
    return (Reason("strain", "elongation_at_break", reached, allowed, "%", message),)


def _stress_reasons(limit: float, evaluation: Evaluated) -> tuple[Reason, ...]:
    stress, percent = evaluation.max_von_mises_mpa, evaluation.error_estimate.max_von_mises_percent
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
