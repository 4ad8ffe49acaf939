"""Constants of Ogden's rubber from measurements, with what they are worth.

Least squares over relative errors: the difference of model and measured nominal stress, divided
by the measured one, or by 5 % of its test's largest where that is more. For given exponents the
stress is linear in μ, and exponents are judged with the best μ ≥ 0 for them (non-negative
least squares): first all of a grid, then the best few of it are refined.

Every μ is kept positive, Hill's inequality in Abaqus's form, because a design takes no other
material. Yeoh's model, a polynomial of the first invariant, is fitted if asked for by name.

Intervals are Student's, at 95 %, from the Jacobian at the solution, linear in α and in ln μ, since
μ is positive; where they are wide the truth may be wider still. Models are compared by the
corrected information criterion

    AICc = n ln s² + 2 K + 2 K (K + 1)/(n − K − 1),

s the relative error, K the free constants and the error, but no s below 1 %: no test is better.
Source of both: K. P. Burnham and D. R. Anderson, Model Selection and Multimodel Inference, 2002.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import DesignError, did_you_mean, quoted
from bellows_design.materials.fitting.fit_result import (
    BEST_ERROR,
    VANISHED,
    Choice,
    Constant,
    Fit,
    aicc_of,
    difference_of,
    misfit_of,
    r_squared_of,
)
from bellows_design.materials.fitting.measurements import Measurements
from bellows_design.materials.fitting.weighted import FLOOR, Weighted
from solver.material.homogeneous import MODES, Reals, nominal_stress
from solver.material.stability import stability

LARGEST_EXPONENT = 30.0
"""Bound of |α|. Elastomers stay far below."""

EXPONENTS = (*(-20, -12, -8, -5, -4, -3, -2, -1, -0.3), *(0.3, 1, 1.5, 2, 3, 4, 5, 6, 8, 12, 20))
"""Exponents to start from."""

STARTS = 6
"""Starts that are refined."""

MOST_STEPS = 60
"""Steps of a refinement; what creeps on has constants the measurements do not tell."""

SAME_ERROR, SAME_LIKELIHOOD = 1e-3, 4.0
"""Fits are equally good below that relative error, or that difference of n ln s²."""

NOT_MUCH_WORSE = 10.0
"""Difference in AICc up to which the smaller model is preferred."""

BEST = "best"
MODELS: dict[str, tuple[float | None, ...]] = {
    "neo-hooke": (2.0,),
    "ogden1": (None,),
    "mooney-rivlin": (2.0, -2.0),
    "ogden2": (None, None),
    "ogden3": (None, None, None),
}
"""Model -> the exponent of each term, None where it is fitted. Smallest first."""

YEOH = "yeoh"
CHOICES = (BEST, *MODELS, YEOH)
"""What may be asked for. ``best`` is one of ``MODELS``."""


def fit(data: Measurements, model: str = BEST) -> Choice:
    """Fit ``model`` to ``data``: one of ``CHOICES``.

    ``best`` is the smallest model, of those the measurements determine if there are any, whose
    AICc is within 10 of the lowest; unstable models and those with an idle term do not count.
    Raises ``DesignError`` for an unknown model, and when there are too few points for it.
    """
    if model != BEST:
        only = fit_model(data, model)
        return Choice(only, (only,))
    problem = Weighted.of(data)
    possible = [name for name in MODELS if _enough(problem, name)]
    if not possible:
        smallest = next(iter(MODELS))
        raise DesignError(_too_few(data, problem, smallest, _free(MODELS[smallest])))
    tried: list[Fit] = []
    for name in possible:
        if not (tried and _is_hopeless(name, tried)):
            tried.append(fit_model(data, name))
    return Choice(_best(tried), tuple(tried))


def fit_model(data: Measurements, model: str) -> Fit:
    """Fit one model of ``MODELS``, or Yeoh's. Raises ``DesignError``."""
    problem = Weighted.of(data)
    if model == YEOH:
        from bellows_design.materials.fitting.yeoh import CONSTANTS, fit_yeoh

        if problem.telling < len(CONSTANTS) + 2:
            raise DesignError(_too_few(data, problem, model, len(CONSTANTS)))
        return fit_yeoh(data, problem)
    if model not in MODELS:
        raise DesignError(f"unknown model {quoted(model)}{did_you_mean(model, CHOICES)}")
    if not _enough(problem, model):
        raise DesignError(_too_few(data, problem, model, _free(MODELS[model])))
    return _judged(data, problem, model, _solved(problem, MODELS[model]))


def _enough(problem: Weighted, model: str) -> bool:
    return problem.telling >= _free(MODELS[model]) + 2


def _free(form: tuple[float | None, ...]) -> int:
    return len(form) + sum(exponent is None for exponent in form)


def _too_few(data: Measurements, problem: Weighted, model: str, count: int) -> str:
    return (
        f"{quoted(data.name)} has {problem.telling} points away from stretch 1 but {model}, with "
        f"{count} constants, needs at least {count + 2}."
    )


def _is_hopeless(model: str, tried: Sequence[Fit]) -> bool:
    """True if no larger model can be better: the error is at its floor, or terms go unused."""
    smaller = [each for each in tried if each.free_constants < _free(MODELS[model])]
    return any(
        each.relative_error <= BEST_ERROR or (each.vanished and None in MODELS[each.model])
        for each in smaller
    )


def _best(tried: Sequence[Fit]) -> Fit:
    good = [each for each in tried if each.stable and not each.vanished] or list(tried)
    bound = min(each.aicc for each in good) + NOT_MUCH_WORSE
    near = [each for each in good if each.aicc <= bound]
    near = [each for each in near if each.determined] or near
    return min(near, key=lambda each: (each.free_constants, each.aicc))


class _Solution(NamedTuple):
    """μ, in units of stress, α, and how far equally good constants are from them (relative)."""

    mu: Reals
    alpha: Reals
    rivalry: float


def _solved(problem: Weighted, form: tuple[float | None, ...]) -> _Solution:
    few = problem.thinned()
    if None not in form:
        alpha = np.array([float(exponent or 0.0) for exponent in form])
        return _Solution(_best_mu(problem.columns(alpha), problem.target)[0], alpha, 0.0)
    refined = [_refined(few, start) for start in _starts(few, len(form))]
    errors = [math.sqrt(_squares(few, *each) / few.telling) for each in refined]
    best = refined[int(np.argmin(errors))]
    bound = max(min(errors), SAME_ERROR) * math.exp(SAME_LIKELIHOOD / (2 * few.telling))
    rivals = [each for each, error in zip(refined, errors, strict=True) if error <= bound]
    rivalry = max(_distance(few, best, each) for each in rivals)
    if few.logs.size < problem.logs.size:
        best = _refined(problem, best[1])
    return _Solution(*best, rivalry)


def _distance(problem: Weighted, ours: tuple[Reals, Reals], other: tuple[Reals, Reals]) -> float:
    """Largest relative difference of two sets' stresses, in all tests over the range measured."""
    line = np.linspace(problem.logs.min(), problem.logs.max(), 21)
    stretch = np.exp(line[line != 0])
    parts = []
    for mode in MODES.values():
        mine, theirs = (nominal_stress(mode, stretch, *each) for each in (ours, other))
        floor = np.maximum(np.abs(mine), FLOOR * np.abs(mine).max())
        parts.append(float((np.abs(mine - theirs) / floor).max()))
    return max(parts)


def _starts(problem: Weighted, terms: int) -> list[Reals]:
    """The best exponents of the grid, best first; none with a term that goes unused if possible."""
    grid = np.array(EXPONENTS, float)
    columns = problem.columns(grid)
    orthogonal, triangle = np.linalg.qr(columns / np.linalg.norm(columns, axis=0))
    target = orthogonal.T @ problem.target
    found = []
    for chosen in itertools.combinations(range(grid.size), terms):
        mu, error = _best_mu(triangle[:, chosen], target)
        found.append((bool((mu == 0).any()), error, chosen))
    return [grid[list(chosen)] for _, _, chosen in sorted(found)[:STARTS]]


def _best_mu(columns: Reals, target: Reals) -> tuple[Reals, float]:
    """μ ≥ 0 of least squares, and the norm of what is left."""
    from scipy.optimize import nnls

    scale = np.linalg.norm(columns, axis=0)
    scaled, error = nnls(columns / scale, target)
    return scaled / scale, float(error)


def _refined(problem: Weighted, alpha: Reals) -> tuple[Reals, Reals]:
    """The local optimum (μ, α) next to exponents: least squares in α alone, each with its best μ.

    So the narrow valley in which a small μ trades against its α costs no steps (variable
    projection: G. Golub and V. Pereyra, Inverse Problems 19, 2003).
    """
    from scipy.optimize import least_squares

    def residual(exponents: Reals) -> Reals:
        columns = problem.columns(exponents)
        left: Reals = columns @ _best_mu(columns, problem.target)[0] - problem.target
        return left

    tolerances = dict.fromkeys(("xtol", "ftol", "gtol"), 1e-11)
    bounds = (-LARGEST_EXPONENT, LARGEST_EXPONENT)
    result = least_squares(residual, alpha, bounds=bounds, max_nfev=MOST_STEPS, **tolerances)
    mu, _ = _best_mu(problem.columns(result.x), problem.target)
    return mu, result.x


def _jacobian(problem: Weighted, mu: Reals, alpha: Reals) -> Reals:
    return np.hstack([problem.columns(alpha), problem.slopes(alpha) * mu])


def _squares(problem: Weighted, mu: Reals, alpha: Reals) -> float:
    return float(((problem.columns(alpha) @ mu - problem.target) ** 2).sum())


def _judged(data: Measurements, problem: Weighted, model: str, solution: _Solution) -> Fit:
    order = np.argsort(-solution.mu, kind="stable")
    fixed = np.array([exponent is not None for exponent in MODELS[model]])[order]
    mu, alpha = solution.mu[order], solution.alpha[order]
    squares, count = _squares(problem, mu, alpha), _free(MODELS[model])
    errors = _standard_errors(problem, mu, alpha, fixed, squares)
    constants = _constants(mu * problem.unit, alpha, fixed, errors, problem.telling - count)
    difference = difference_of(data, mu * problem.unit, alpha)
    relative = math.sqrt(squares / problem.telling)
    return Fit(
        model=model,
        mu=tuple((mu * problem.unit).tolist()),
        alpha=tuple(alpha.tolist()),
        constants=constants,
        points=data.stress.size,
        r_squared=r_squared_of(data.stress, difference),
        relative_error=relative,
        misfit=misfit_of(data, difference),
        aicc=aicc_of(relative, problem.telling, count + 1),
        vanished=bool((np.abs(problem.columns(alpha) * mu).max(axis=0) < VANISHED).any()),
        rivalry=solution.rivalry,
        stability=stability(mu * problem.unit, alpha),
    )


def _standard_errors(
    problem: Weighted, mu: Reals, alpha: Reals, fixed: NDArray[np.bool_], squares: float
) -> Reals:
    """Of (μ in MPa, α), infinite where the measurements tell nothing and 0 where α is given."""
    free = np.concatenate([np.full(mu.size, True), ~fixed])
    jacobian = _jacobian(problem, mu, alpha)[:, free]
    scale = np.linalg.norm(jacobian, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    _, singular, directions = np.linalg.svd(jacobian / scale, full_matrices=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.where(directions == 0, 0.0, directions / singular[:, None])
    noise = max(squares / (problem.telling - free.sum()), 1e-20)
    errors = np.zeros(2 * mu.size)
    errors[free] = np.sqrt(noise * (parts**2).sum(axis=0)) / scale
    return errors * np.repeat([problem.unit, 1.0], mu.size)


def _constants(
    mu: Reals, alpha: Reals, fixed: NDArray[np.bool_], errors: Reals, freedom: int
) -> tuple[Constant, ...]:
    from scipy.stats import t as student

    width = float(student.ppf(0.975, freedom))
    result = []
    for term, (value, exponent) in enumerate(zip(mu.tolist(), alpha.tolist(), strict=True)):
        error, other = float(errors[term]), float(errors[mu.size + term])
        factor = _exp(width * error / value) if value > 0 else math.inf
        high = value * factor if value > 0 else math.inf
        result += [
            Constant(f"mu_{term + 1}", "MPa", value, error, value / factor, high),
            Constant(
                f"alpha_{term + 1}",
                "",
                exponent,
                other,
                exponent - width * other,
                exponent + width * other,
                bool(fixed[term]),
            ),
        ]
    return tuple(result)


def _exp(x: float) -> float:
    return math.exp(x) if x < 700 else math.inf
