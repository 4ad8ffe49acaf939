"""The verdict: may this design be printed and pressurised?

Approved is a design for which every printability rule passes, the solver reached the design
pressure, the highest von Mises stress keeps its limit *including its estimated error*, and the
material is not strained beyond its elongation at break. Where the error reaches across the limit
nothing is decided: the answer is no, and the remedy is a finer mesh, not another design. A result
that walls run through each other in, elements that fold at the highest stress, a missing rule or
error estimate, or a result that depends on another design's, are never taken for a pass. Strains
outside of the range the material was tested in are a warning: the range is that of the tests, not
of the material. What cannot be judged is listed, with the reason.

A design may name scenes that it must hold as well (``limits.scenes``): each must be reached and
stable, keep the limit of the stress under its own load, and a grip must hold its object, errors
included. Nothing is approved by a law of the bubbles that is extrapolated or unfinished, or past a
jump from one equilibrium to another.

Where nothing speaks against a design, the leak test on a slicer's G-code may still (``leak_test``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

from bellows_design.analysis.error_estimate import LEAST_STRESS_ERROR
from bellows_design.design.conditions import LEAST_PRESSURE
from bellows_design.design.design import Design
from bellows_design.leak_test.record import RULE, LeakTest, Unavailable
from printers import PrintabilityReport, RuleResult

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import LoadedState
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.force.result import ForceCurve, SceneResult

REQUIRED_RULES = ("watertight", "airtightness", "minimum_lines", "cross_section")
"""Rules a report must contain: one that was not checked is not a pass."""

Kind = Literal["printability", "convergence", "contact", "stress", "accuracy", "strain", "scene"]


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
class NotJudged:
    """A rule that the verdict says nothing about, and why."""

    rule: str
    why: str


@dataclass(frozen=True)
class Verdict:
    """Approved, or refused for all of its reasons.

    Attributes:
        reasons: What speaks against the design, from printability and evaluation; empty if it is
            approved.
        warnings: Sentences that decide nothing.
        not_judged: Rules that nothing is said about, for want of data.
    """

    reasons: tuple[Reason, ...]
    warnings: tuple[str, ...] = ()
    not_judged: tuple[NotJudged, ...] = ()

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
            "not_judged": [asdict(rule) for rule in self.not_judged],
        }


def decide(
    design: Design,
    report: PrintabilityReport,
    state: LoadedState,
    scenes: Sequence[SceneResult] = (),
) -> Verdict:
    """The verdict on ``design``.

    Args:
        design: States the pressure to be reached (MPa) and the limit of the von Mises stress (MPa).
        report: Printability of its part.
        state: The actuator under pressure; an ``Evaluation`` is one.
        scenes: Results of the scenes that the design must hold; one that is missing is a reason.

    Returns:
        All reasons against the design; approval where there is none.
    """
    verdict = _by_itself(design, report, state)
    known = {each.scene: each for each in scenes}
    reasons = tuple(
        reason
        for name in design.limits.scenes
        for reason in _scene_reasons(design, name, known.get(name))
    )
    noted = (text for each in scenes if each.found is not None for text in each.found.warnings)
    warnings = tuple(dict.fromkeys((*verdict.warnings, *noted)))
    return replace(verdict, reasons=verdict.reasons + reasons, warnings=warnings)


def _by_itself(design: Design, report: PrintabilityReport, state: LoadedState) -> Verdict:
    """The verdict without any scene."""
    reasons = (
        *_print_reasons(report),
        *_history_reasons(state),
        *_load_reasons(design, state),
    )
    warnings = dict.fromkeys((*design.material.warnings, *state.warnings))
    return Verdict(reasons, tuple(warnings), _not_judged(design, state))


def refused_for_want_of_a_slicer(
    design: Design, report: PrintabilityReport, unavailable: Unavailable
) -> Verdict:
    """The verdict on a design that requires a leak test where none can be made.

    No evaluation could change it, so none is needed for it.
    """
    missing = _missing_leak_test(f"no leak test can be made: {unavailable.why}")
    return Verdict((*_print_reasons(report), missing), tuple(design.material.warnings))


def without_evaluation(report: PrintabilityReport) -> Verdict:
    """What the printability alone says: no approval, as nothing else is judged."""
    left_out = (NotJudged("evaluation", "it was left out"), NotJudged(RULE, "it was left out"))
    return Verdict(_print_reasons(report), not_judged=left_out)


def with_leak_test(verdict: Verdict, test: LeakTest) -> Verdict:
    """The verdict once the leak test is over, or was left out.

    Warnings name rules alone: their figures are those of one run of the slicer.
    """
    if test.outcome is None:
        return _without_leak_test(verdict, test)
    failed = tuple(_failed(rule) for rule in test.rules if rule.verdict == "fail")
    failed += tuple(map(_unchecked, test.missing))
    warned = tuple(
        f"The leak test warns: {rule}."
        for rule in dict.fromkeys(rule.rule for rule in test.rules if rule.verdict == "warn")
    )
    return replace(verdict, reasons=verdict.reasons + failed, warnings=verdict.warnings + warned)


def _without_leak_test(verdict: Verdict, test: LeakTest) -> Verdict:
    """A required test that could not be finished is a reason, any other is not judged."""
    if verdict.approved and test.setting == "required":
        return replace(verdict, reasons=(_missing_leak_test(test.why),))
    failure = (f"The leak test could not be finished: {test.why}.",) if test.failed else ()
    return replace(
        verdict,
        warnings=verdict.warnings + failure,
        not_judged=(*verdict.not_judged, NotJudged(RULE, test.why)),
    )


def _missing_leak_test(why: str) -> Reason:
    message = f"The design requires a leak test (limits.leak_test), but {why}."
    return Reason("printability", RULE, "not run", "pass", "", message)


def open_question(design: Design, report: PrintabilityReport, state: LoadedState) -> str:
    """What a finer mesh may decide, as text; empty if nothing."""
    estimated = state.error_estimate.max_von_mises_percent is not None
    if not estimated or not _by_itself(design, report, state).undecided:
        return ""
    if state.folded.at_highest_stress:
        return f"at the highest stress {state.folded.text}"
    limit, stress = design.max_von_mises, state.max_von_mises_mpa
    if _beyond_resolution(stress, limit):
        return ""
    return f"{stress:.3f} MPa are too near to the limit of {limit:g} MPa for their estimated error"


def _beyond_resolution(stress: float, limit: float) -> bool:
    """True if a stress is nearer to its limit than any mesh can tell."""
    return abs(stress - limit) <= LEAST_STRESS_ERROR * stress


def _not_judged(design: Design, state: LoadedState) -> tuple[NotJudged, ...]:
    """Rules without the data that they need."""
    material, found = design.material, []
    if state.strain.elongation_at_break is None:
        why = f"the material {material.name} states no elongation at break"
        found.append(NotJudged("elongation_at_break", why))
    if state.strain.valid is None:
        why = f"the material {material.name} does not state the strains of its tests"
        found.append(NotJudged("tested_strain", why))
    if state.stable is None:
        why = "the linear solver cannot tell whether an equilibrium is stable"
        found.append(NotJudged("stability", why))
    return tuple(found)


def _print_reasons(report: PrintabilityReport) -> tuple[Reason, ...]:
    failed = tuple(_failed(rule) for rule in report.failures)
    checked = {rule.rule for rule in report.rules}
    return failed + tuple(_unchecked(name) for name in REQUIRED_RULES if name not in checked)


def _unchecked(rule: str) -> Reason:
    return Reason("printability", rule, "not checked", "pass", "", f"{rule} was not checked.")


def _failed(rule: RuleResult) -> Reason:
    return Reason("printability", rule.rule, rule.measured, rule.required, rule.unit, rule.message)


def _history_reasons(state: LoadedState) -> tuple[Reason, ...]:
    """A result that another design's leads to is no ground for a verdict."""
    if state.ordinary:
        return ()
    message = (
        "The result was reached from a neighbouring design; a verdict needs an evaluation of the "
        "design by itself."
    )
    return (Reason("accuracy", "history", "neighbour", "ordinary", "", message),)


def _load_reasons(design: Design, state: LoadedState) -> tuple[Reason, ...]:
    required, reached = design.load.pressure, state.pressure_mpa
    if state.touch_pressure_mpa is not None or state.contact.void:
        return (_contact_reason(required, state),)
    if not state.converged or not reached / required >= 1 - 1e-9:
        why = f": {state.message}" if state.message else "."
        message = f"The solver reached {reached:.4g} MPa of {required:g} MPa{why}"
        return (Reason("convergence", "pressure", reached, required, "MPa", message),)
    return (*_stress_reasons(design.max_von_mises, state), *_strain_reasons(state.strain))


def _contact_reason(required: float, state: LoadedState) -> Reason:
    """Walls touch that the model does not keep apart."""
    touch = state.touch_pressure_mpa
    if touch is None:
        walls = " and ".join(state.contact.where)
        message = f"{walls} touch at {required:g} MPa, and this model does not keep them apart."
        return Reason("contact", "contact", required, required, "MPa", _sentence(message))
    up_to = f"The design may be judged at pressures up to {touch:.4g} MPa."
    if abs(touch) < LEAST_PRESSURE:
        up_to = f"Pressures below that, under {LEAST_PRESSURE:g} MPa, are not judged."
    message = _sentence(f"{state.message} {up_to}")
    return Reason("contact", "contact", touch, required, "MPa", message)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


def _strain_reasons(strain: ReachedStrain) -> tuple[Reason, ...]:
    limit = strain.elongation_at_break
    if limit is None or not strain.breaks:
        return ()
    reached, allowed = 100 * strain.highest, 100 * limit
    message = f"The material is strained to {reached:.3g} % but breaks at {allowed:.3g} %."
    return (Reason("strain", "elongation_at_break", reached, allowed, "%", message),)


def _remedy(stress: float, limit: float) -> str:
    """What helps where the error reaches across the limit."""
    if _beyond_resolution(stress, limit):
        least = 100 * LEAST_STRESS_ERROR
        return f"nearer than the {least:g} % that no mesh resolves; change the design or the load"
    return "refine the mesh"


def _stress_reasons(limit: float, state: LoadedState) -> tuple[Reason, ...]:
    stress, percent = state.max_von_mises_mpa, state.error_estimate.max_von_mises_percent
    if state.folded.at_highest_stress:
        message = (
            f"The highest von Mises stress, {stress:.3f} MPa, is not to be judged: "
            f"{state.folded.text}."
        )
        return (Reason("accuracy", "max_von_mises", stress, limit, "MPa", message),)
    if not math.isfinite(stress) or percent is None or not math.isfinite(percent):
        message = (
            f"The highest von Mises stress, {stress:.3f} MPa, has no error estimate: there was no "
            "second mesh within the budget of memory and time."
        )
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
        f"{error:.3f} MPa reaches across the limit of {limit:g} MPa: {_remedy(stress, limit)}."
    )
    return (Reason("accuracy", "max_von_mises", stress, limit, "MPa", message),)


def _scene_reasons(design: Design, name: str, result: SceneResult | None) -> Iterator[Reason]:
    """What speaks against a design in one of its scenes."""
    if result is None or result.found is None:
        why = "it was not evaluated" if result is None else result.failure.rstrip(".")
        message = f"The scene {name} has no result: {why}."
        yield Reason("scene", name, "no result", "a result", "", message)
        return
    found = result.found
    required, reached = design.load.pressure, found.last.pressure_mpa
    if not found.converged or not reached / required >= 1 - 1e-9:
        message = f"The scene {name} was reached up to {reached:.4g} MPa: {found.message}"
        yield Reason("scene", name, reached, required, "MPa", message)
        return
    if not found.last.stable:
        message = f"The finger is not stable in the scene {name} at {required:g} MPa."
        yield Reason("scene", name, "unstable", "stable", "", message)
    yield from _scene_stress(design.max_von_mises, found)
    yield from _grip_reasons(found)
    yield from _doubts(found)


def _scene_stress(limit: float, found: ForceCurve) -> Iterator[Reason]:
    """The highest stress under the load of a scene, with its error."""
    stress, percent = found.last.max_von_mises_mpa, found.last.max_von_mises_error_percent
    if stress is None or percent is None or not math.isfinite(stress * percent):
        message = f"The highest von Mises stress in the scene {found.scene} is not known."
        yield Reason("scene", found.scene, "not known", limit, "MPa", message)
    elif stress * (1 + percent / 100) > limit:
        message = (
            f"The highest von Mises stress in the scene {found.scene} is {stress:.3f} ± "
            f"{stress * percent / 100:.3f} MPa, not below the limit of {limit:g} MPa."
        )
        yield Reason("scene", found.scene, stress, limit, "MPa", message)


def _grip_reasons(found: ForceCurve) -> Iterator[Reason]:
    """A grip that does not hold its object, or not for sure."""
    last, scene = found.last, found.scene
    payload, percent = last.largest_payload_g, last.largest_payload_error_percent
    if payload is None or percent is None:
        return
    mass = getattr(found.content, "mass_g", math.nan)
    if last.holds is False:
        message = f"The grip slips in the scene {scene}: it holds {payload:.4g} g of {mass:g} g."
        yield Reason("scene", scene, payload, mass, "g", message)
    elif last.holds is None:
        why = " ".join(last.warnings)
        message = f"No equilibrium with the object's weight is known in the scene {scene}: {why}"
        yield Reason("scene", scene, "no equilibrium", "an equilibrium", "", message)
    elif not payload * (1 - percent / 100) >= mass:
        message = (
            f"The grip holds at most {payload:.4g} g in the scene {scene}, and the estimated error "
            f"of {percent:.2g} % reaches across the mass of {mass:g} g."
        )
        yield Reason("accuracy", scene, payload, mass, "g", message)


def _doubts(found: ForceCurve) -> Iterator[Reason]:
    """What the numbers of a scene do not stand on."""
    scene = found.scene
    if found.extrapolated:
        message = (
            f"In the scene {scene} sections bear moments beyond those that the law of the bubbles "
            "was computed for."
        )
        yield Reason("accuracy", scene, "extrapolated", "computed", "", message)
    if not found.law_complete:
        message = (
            f"The law of the bubbles was not computed as finely as asked for in time, and so the "
            f"errors in the scene {scene} are not known; --seconds gives it more."
        )
        yield Reason("accuracy", scene, "unfinished", "finished", "", message)
    if found.jumped:
        message = (
            f"In the scene {scene} the finger jumps to another equilibrium on its way to the "
            "pressure; which one it comes to is not certain."
        )
        yield Reason("scene", scene, "a jump", "no jump", "", message)
