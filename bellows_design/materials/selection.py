"""Fitting a model of the table of laws to measurements, or the best of them.

Least squares over relative errors: the difference of model and measured nominal stress, divided
by the measured one, or by 5 % of its test's largest where that is more. Models are compared by the
corrected information criterion

    AICc = n ln s² + 2 K + 2 K (K + 1)/(n − K − 1),

s the relative error, K the free constants and the error, but no s below 1 %: no test is better.
Source: K. P. Burnham and D. R. Anderson, Model Selection and Multimodel Inference, 2002.
"""

from __future__ import annotations

from collections.abc import Sequence

from bellows_design.errors import DesignError
from bellows_design.materials.fitting.fit_model import FitModel
from bellows_design.materials.fitting.fit_result import BEST_ERROR, Choice, Fit
from bellows_design.materials.fitting.measurements import Measurements
from bellows_design.materials.fitting.weighted import Weighted
from bellows_design.materials.laws import BEST, FIT_CHOICES, FIT_MODELS
from bellows_design.validation.quoting import did_you_mean, quoted

NOT_MUCH_WORSE = 10.0
"""Difference in AICc up to which the smaller model is preferred."""


def fit(data: Measurements, model: str = BEST) -> Choice:
    """Fit ``model`` to ``data``.

    ``best`` is the smallest model, of those the measurements determine if there are any, whose
    AICc is within 10 of the lowest; unstable models and those with an idle term do not count.

    Args:
        data: Stretches (no unit) and nominal stresses (MPa), see ``load_measurements``.
        model: One of ``laws.FIT_CHOICES``.

    Returns:
        The fit, its constants in MPa or without unit, and all that were tried for it.

    Raises:
        DesignError: Unknown model, or too few points for it.
    """
    if model != BEST:
        only = fit_model(data, model)
        return Choice(only, (only,))
    problem = Weighted.of(data)
    automatic = [each for each in FIT_MODELS.values() if each.automatic]
    possible = [each for each in automatic if _enough(problem, each)]
    if not possible:
        raise DesignError(_too_few(data, problem, automatic[0]))
    tried: list[Fit] = []
    for each in possible:
        if not _cannot_be_better(each, tried):
            tried.append(each.fitter(data, problem, each))
    return Choice(_best(tried), tuple(tried))


def fit_model(data: Measurements, model: str) -> Fit:
    """Fit one model of ``laws.FIT_MODELS``. Raises ``DesignError``."""
    if model not in FIT_MODELS:
        raise DesignError(f"unknown model {quoted(model)}{did_you_mean(model, FIT_CHOICES)}")
    problem, chosen = Weighted.of(data), FIT_MODELS[model]
    if not _enough(problem, chosen):
        raise DesignError(_too_few(data, problem, chosen))
    return chosen.fitter(data, problem, chosen)


def _enough(problem: Weighted, model: FitModel) -> bool:
    return problem.informative >= model.constants + 2


def _too_few(data: Measurements, problem: Weighted, model: FitModel) -> str:
    return (
        f"{quoted(data.name)} has {problem.informative} points away from stretch 1 but "
        f"{model.name}, with {model.constants} constants, needs at least {model.constants + 2}."
    )


def _cannot_be_better(model: FitModel, tried: Sequence[Fit]) -> bool:
    """True if no larger model can be better: the error is at its floor, or terms go unused."""
    smaller = [each for each in tried if each.free_constants < model.constants]
    return any(
        each.relative_error <= BEST_ERROR
        or (each.vanished and None in FIT_MODELS[each.model].exponents)
        for each in smaller
    )


def _best(tried: Sequence[Fit]) -> Fit:
    good = [each for each in tried if each.stable and not each.vanished] or list(tried)
    bound = min(each.aicc for each in good) + NOT_MUCH_WORSE
    near = [each for each in good if each.aicc <= bound]
    near = [each for each in near if each.determined] or near
    return min(near, key=lambda each: (each.free_constants, each.aicc))
