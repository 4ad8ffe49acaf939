"""What a fit leaves open, in sentences for people."""

from __future__ import annotations

from bellows_design.materials.fitting.fit_result import Fit
from bellows_design.materials.measurements.points import Measurements
from solver.material.stability import HIGHEST

POOR = 0.1
"""Relative error from which on a fit is called poor."""


def fit_notes(data: Measurements, fit: Fit) -> tuple[str, ...]:
    """Sentences on errors, idle terms, undetermined constants and instability."""
    notes = (_poor(fit), _idle(fit), _open(fit), _ambiguous(fit), _unstable(fit), _one_test(data))
    return (*(note for note in notes if note), *_falling(fit))


def _poor(fit: Fit) -> str | None:
    if fit.relative_error <= POOR:
        return None
    return (
        f"a poor fit: the model is off by {100 * fit.relative_error:.0f} % in the mean of the "
        "points; look at the plot, at other models, and at the measurements."
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


def _ambiguous(fit: Fit) -> str | None:
    if fit.unique:
        return None
    return (
        "quite other constants fit these tests as well, with stresses that differ by up to "
        f"{100 * fit.ambiguity:.0f} % in the three tests over the same stretches; measure another "
        "kind of test."
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
