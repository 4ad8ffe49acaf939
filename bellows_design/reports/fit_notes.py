"""What a fit leaves open, in sentences for people."""

from __future__ import annotations

from bellows_design.materials.fitting.fit_result import BEST_ERROR, Choice, Fit
from bellows_design.materials.fitting.initial_modulus import initial_modulus
from bellows_design.materials.material import Material
from bellows_design.materials.measurements.points import Measurements
from solver.material.homogeneous import MODES
from solver.material.stability import HIGHEST

POOR = 0.1
"""Relative error from which on a fit is called poor."""

SAME_ERROR = 1.25
"""Ratio of errors up to which models follow the measurements about as well."""

MODULUS_NOTED = 3.0
"""%. Difference from the initial shear modulus that the beginning of the tests tells."""


def fit_notes(data: Measurements, choice: Choice) -> tuple[str, ...]:
    """Sentences on errors, idle terms, undetermined constants, instability, and the choice."""
    fit = choice.fit
    notes = (
        *(_poor(fit), _off_at_first(data, fit), _open_modulus(choice)),
        *(_criteria(choice), _unstable_but_better(choice)),
        *(_idle(fit), _open(fit), _ambiguous(data, fit), _unstable(fit), _one_test(data)),
    )
    return (*(note for note in notes if note), *_falling(fit))


def material_notes(data: Measurements, material: Material) -> tuple[str, ...]:
    """Sentences on what the material that is written leaves open."""
    reach, limit = 100 * data.valid_strain[1], material.elongation_at_break
    if limit is None:
        return (
            "the material has no elongation at break, so no rule judges strains: "
            f"--elongation-at-break gives it, in per cent (these tests reached {reach:.0f}).",
        )
    if "uniaxial" in data.modes and limit < 100 * (data.of("uniaxial")[0].max() - 1) - 1:
        return (
            f"the elongation at break of {limit:g} % is less than these tests reached, "
            f"{100 * (data.of('uniaxial')[0].max() - 1):.0f} %.",
        )
    return ()


def _poor(fit: Fit) -> str | None:
    if fit.relative_error <= POOR:
        return None
    return (
        f"a poor fit: the model is off by {100 * fit.relative_error:.0f} % in the mean of the "
        "points; look at the plot, at other models, and at the measurements."
    )


def _off_at_first(data: Measurements, fit: Fit) -> str | None:
    start, modulus = initial_modulus(data), fit.stability.shear_modulus
    if start is None or not start.contradicts(modulus, MODULUS_NOTED):
        return None
    return (
        f"the initial shear modulus of the fit is {modulus:.4g} MPa, that of the beginning of the "
        f"tests {start.value:.4g} ± {2 * start.error:.2g} MPa: the model misses small strains by "
        f"{100 * abs(modulus / start.value - 1):.0f} %."
    )


def _open_modulus(choice: Choice) -> str | None:
    """How far models that follow the tests about as well differ at small strains."""
    fit = choice.fit
    bound = SAME_ERROR * max(fit.relative_error, BEST_ERROR)
    alike = [each for each in choice.tried if each.stable and each.relative_error <= bound]
    moduli = [each.stability.shear_modulus for each in (*alike, fit)]
    low, high = min(moduli), max(moduli)
    if high <= (1 + MODULUS_NOTED / 100) * low:
        return None
    return (
        "models that follow the measurements about as well have initial shear moduli from "
        f"{low:.4g} to {high:.4g} MPa: more points at small strains would tell."
    )


def _criteria(choice: Choice) -> str | None:
    other = choice.by_criterion
    if other is None:
        return None
    return (
        f"the criteria disagree: with {choice.fit.points} points AICc would take {other.model}, "
        f"off by {100 * other.relative_error:.2g} %; {choice.fit.model}, off by "
        f"{100 * choice.fit.relative_error:.2g} %, shows that this is more than the measurements "
        "allow. More points would settle it."
    )


def _unstable_but_better(choice: Choice) -> str | None:
    fit = choice.fit
    better = [
        each
        for each in choice.tried
        if each.relative_error < fit.relative_error / 2 and fit.relative_error > 2 * BEST_ERROR
    ]
    if not better:
        return None
    best = min(better, key=lambda each: each.relative_error)
    why = "is unstable" if not best.stable else "is not determined by these tests"
    return (
        f"{best.model} follows the measurements to {100 * best.relative_error:.2g} % but {why}; "
        f"{fit.model}, which answers, is off by {100 * fit.relative_error:.2g} %."
    )


def _idle(fit: Fit) -> str | None:
    if not fit.vanished:
        return None
    return (
        f"{fit.model} has a term that adds nothing, with a μ of 0 or next to it; a smaller model "
        "says the same."
    )


def _open(fit: Fit) -> str | None:
    names = [each.name for each in fit.constants if not each.determined]
    if fit.vanished or not names:
        return None
    return (
        f"the measurements do not determine {', '.join(names)}: other constants fit as well, and "
        "would differ where nothing was measured; try a smaller model or more tests."
    )


def _ambiguous(data: Measurements, fit: Fit) -> str | None:
    if fit.unique:
        return None
    missing = [mode for mode in MODES if mode not in data.modes]
    how_far = (
        f"by up to {100 * fit.ambiguity:.0f} %"
        if fit.ambiguity < 1
        else f"by a factor of {1 + fit.ambiguity:.1f} and more"
        if fit.ambiguity < 9
        else "by more than a factor of ten"
    )
    advice = f"add a {' or '.join(missing)} test, or" if missing else "test over more strains, or"
    where = f"in {' and '.join(missing)} tests" if missing else "between and beyond the points"
    return (
        "quite other constants fit these tests as well; their stresses differ "
        f"{how_far} {where} over the same stretches, so take nothing there from this fit: "
        f"{advice} try a smaller model."
    )


def _unstable(fit: Fit) -> str | None:
    return None if fit.stable else f"{fit.model} is unstable: see the stable stretches."


def _one_test(data: Measurements) -> str | None:
    if len(data.modes) != 1:
        return None
    return (
        f"only {data.modes[0]} tests: in other states of stress, as in a pressurised wall, the fit "
        "is a guess; an equibiaxial test would add most."
    )


def _falling(fit: Fit) -> list[str]:
    peaks = [each for each in fit.stability.ranges if each.load_rises_to < HIGHEST]
    return [
        f"{each.mode}: the load peaks at stretch {each.load_rises_to:.3g}; past it a part under "
        "constant load necks or bursts."
        for each in peaks
        if each.highest > each.load_rises_to
    ]
