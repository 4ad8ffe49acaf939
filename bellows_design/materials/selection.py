"""Fitting a model of the table of laws to measurements, or the best of them.

Least squares over relative errors: the difference of model and measured nominal stress, divided
by the measured one, or by 5 % of its test's largest where that is more. Models are compared by the
corrected information criterion

    AICc = n ln s² + 2 K + 2 K (K + 1)/(n − K − 1),

s the relative error, K the free constants and the error, but no s below 1 %: no test is better.
With few points its last term outweighs any error. Hence a model does not count whose error is more
than the measurements allow: at least twice that of a larger stable model, and by the F test of
their sums of squares by chance in less than one of a hundred such tests. Nor does one whose initial
shear modulus the beginning of the tests contradicts, if there are others.
Sources: K. P. Burnham and D. R. Anderson, Model Selection and Multimodel Inference, 2002; N. R.
Draper and H. Smith, Applied Regression Analysis, 1998, section 6.1.
"""

from __future__ import annotations

from collections.abc import Sequence

from bellows_design.errors import DesignError
from bellows_design.materials.fitting.fit_model import FitModel
from bellows_design.materials.fitting.fit_result import BEST_ERROR, Choice, Fit
from bellows_design.materials.fitting.initial_modulus import initial_modulus
from bellows_design.materials.fitting.weighted import Weighted
from bellows_design.materials.laws import BEST, FIT_CHOICES, FIT_MODELS, law_of_fit
from bellows_design.materials.measurements.points import Measurements
from bellows_design.validation.quoting import did_you_mean, quoted

NOT_MUCH_WORSE = 10.0
"""Difference in AICc up to which the smaller model is preferred."""

WORSE, BY_CHANCE = 2.0, 0.01
"""Ratio of errors, and probability, from which on a larger model contradicts a smaller one."""

MODULUS_OFF = 5.0
"""%. Difference of initial shear moduli from which on the beginning of the tests contradicts."""


def fit(data: Measurements, model: str = BEST) -> Choice:
    """Fit ``model`` to ``data``.

    ``best`` is the smallest model, of those the measurements determine if there are any, whose
    AICc is within 10 of the lowest; unstable models, those with an idle term and those with more
    error than the measurements allow do not count.

    Args:
        data: Stretches (no unit) and nominal stresses (MPa), see ``load_measurements``.
        model: One of ``laws.FIT_CHOICES``.

    Returns:
        The fit, its constants in MPa or without unit, and all that were tried for it.

    Raises:
        DesignError: Unknown model, or too few points for it.

    Examples:
        >>> import numpy as np
        >>> from pathlib import Path
        >>> from bellows_design.materials import fit, load_measurements
        >>> stretches = np.linspace(1.05, 2, 20)
        >>> rows = [f"uniaxial,{s:.4f},{0.4 * (s - s**-2):.6f}" for s in stretches]  # mu = 0.4 MPa
        >>> _ = Path("test.csv").write_text("\\n".join(["mode,stretch,stress_mpa", *rows]))
        >>> best = fit(load_measurements("test.csv"))
        >>> print(best.fit.model, f"mu = {best.fit.mu[0]:.3f} MPa")
        neo-hooke mu = 0.400 MPa
    """
    if model != BEST:
        only = fit_model(data, model)
        return Choice(only, (only,))
    problem = Weighted.of(data)
    automatic = sorted(FIT_MODELS.values(), key=lambda each: each.constants)
    possible = [each for each in automatic if _enough(problem, each)]
    if not possible:
        raise DesignError(_too_few(data, problem, automatic[0]))
    tried: list[Fit] = []
    for each in possible:
        if not _cannot_be_better(each, tried):
            tried.append(each.fitter(data, problem, each))
    return _choice(data, tried)


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
        or (each.vanished and None in FIT_MODELS[each.model].exponents and None in model.exponents)
        for each in smaller
    )


def usable(data: Measurements, fit: Fit) -> bool:
    """True if the material is stable: everywhere, or over the tests where its law may soften."""
    low, high = data.valid_strain
    in_range = law_of_fit(fit.model).softens and fit.stability.covers(1 + low, 1 + high)
    return fit.stable or in_range


def _choice(data: Measurements, tried: Sequence[Fit]) -> Choice:
    """The best of the fits, and the one that the criterion alone would take if it differs."""
    good = [each for each in tried if usable(data, each) and not each.vanished] or list(tried)
    allowed = [each for each in good if not any(_contradicts(other, each) for other in good)]
    allowed = _with_right_modulus(data, allowed) or _with_right_modulus(data, good) or allowed
    best, by_criterion = _best(allowed), _best(good)
    return Choice(best, tuple(tried), None if best is by_criterion else by_criterion)


def _with_right_modulus(data: Measurements, fits: Sequence[Fit]) -> list[Fit]:
    """Those whose initial shear modulus the beginning of the tests does not contradict."""
    start = initial_modulus(data)
    if start is None:
        return list(fits)
    moduli = [(each, each.stability.shear_modulus) for each in fits]
    return [each for each, modulus in moduli if not start.contradicts(modulus, MODULUS_OFF)]


def _best(good: Sequence[Fit]) -> Fit:
    bound = min(each.aicc for each in good) + NOT_MUCH_WORSE
    near = [each for each in good if each.aicc <= bound]
    near = [each for each in near if each.determined] or near
    return min(near, key=lambda each: (each.free_constants, each.aicc))


def _contradicts(larger: Fit, smaller: Fit) -> bool:
    """True if ``larger`` shows that the error of ``smaller`` is more than scatter."""
    more = larger.free_constants - smaller.free_constants
    freedom = larger.points - larger.free_constants
    least, most = (max(each.relative_error, BEST_ERROR) for each in (larger, smaller))
    if more <= 0 or freedom <= 0 or most < WORSE * least:
        return False
    from scipy.stats import f as fisher

    ratio = (most**2 - least**2) * larger.points / more / (least**2 * larger.points / freedom)
    return bool(fisher.sf(ratio, more, freedom) < BY_CHANCE)
