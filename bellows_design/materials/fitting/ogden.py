"""Ogden's constants from measurements, each with its interval.

Least squares over relative errors. For given exponents the stress is linear in μ, and exponents
are compared with the best μ ≥ 0 for them (non-negative least squares): first all of a grid, then
the best few of it are refined.

Every μ is kept positive, Hill's inequality in Abaqus's form, because a design takes no other
material. Neo-Hooke and Mooney–Rivlin are the cases in which the exponents are given.

Intervals are Student's, at 95 %, from the Jacobian at the solution, linear in α and in ln μ, since
μ is positive; where they are wide the truth may be wider still.
"""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bellows_design.materials.fitting.fit_result import (
    VANISHED,
    Constant,
    Estimate,
    Fit,
    judged,
    student_width,
)
from bellows_design.materials.fitting.weighted import FLOOR, Weighted
from bellows_design.materials.measurements.points import Measurements
from solver.arrays import Reals
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.ogden import packed

if TYPE_CHECKING:
    from bellows_design.materials.fitting.fit_model import FitModel

LARGEST_EXPONENT = 30.0
"""Bound of |α|. Elastomers stay far below."""

EXPONENTS = (*(-20, -12, -8, -5, -4, -3, -2, -1, -0.3), *(0.3, 1, 1.5, 2, 3, 4, 5, 6, 8, 12, 20))
"""Exponents to start from."""

STARTS = 6
"""Starts that are refined."""

MOST_STEPS = 60
"""Steps of a refinement; what creeps on has constants the measurements do not determine."""

SAME_ERROR, SAME_LIKELIHOOD = 1e-3, 4.0
"""Fits are equally good below that relative error, or that difference of n ln s²."""


def fit_ogden(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    """Fit the constants of ``model`` to ``data``, which ``problem`` has weighted."""
    solution = _solved(problem, model.exponents)
    order = np.argsort(-solution.mu, kind="stable")
    fixed = np.array([exponent is not None for exponent in model.exponents])[order]
    return judged(data, problem, model.name, _estimate(problem, solution, order, fixed))


class _Solution(NamedTuple):
    """μ, in units of stress, α, and how far equally good constants are from them (relative)."""

    mu: Reals
    alpha: Reals
    ambiguity: float


def _solved(problem: Weighted, form: tuple[float | None, ...]) -> _Solution:
    few = problem.thinned()
    if None not in form:
        alpha = np.array([float(exponent or 0.0) for exponent in form])
        return _Solution(_best_mu(problem.columns(alpha), problem.target)[0], alpha, 0.0)
    refined = [_refined(few, start) for start in _starts(few, len(form))]
    errors = [math.sqrt(_squares(few, *each) / few.informative) for each in refined]
    best = refined[int(np.argmin(errors))]
    bound = max(min(errors), SAME_ERROR) * math.exp(SAME_LIKELIHOOD / (2 * few.informative))
    equals = [each for each, error in zip(refined, errors, strict=True) if error <= bound]
    ambiguity = max(_distance(few, best, each) for each in equals)
    if few.logs.size < problem.logs.size:
        best = _refined(problem, best[1])
    return _Solution(*best, ambiguity)


def _distance(problem: Weighted, ours: tuple[Reals, Reals], other: tuple[Reals, Reals]) -> float:
    """Largest relative difference of two sets' stresses, in all tests over the range measured."""
    line = np.linspace(problem.logs.min(), problem.logs.max(), 21)
    stretch = np.exp(line[line != 0])
    parts = []
    for mode in MODES.values():
        mine, theirs = (nominal_stress(mode, stretch, packed(*each)) for each in (ours, other))
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


def _estimate(
    problem: Weighted, solution: _Solution, order: NDArray[np.intp], fixed: NDArray[np.bool_]
) -> Estimate:
    """The solution in MPa, its terms in that order, with the intervals of its constants."""
    mu, alpha = solution.mu[order], solution.alpha[order]
    squares = _squares(problem, mu, alpha)
    errors = _standard_errors(problem, mu, alpha, fixed, squares)
    freedom = problem.informative - mu.size - int((~fixed).sum())
    return Estimate(
        law=packed(mu * problem.unit, alpha),
        mu=tuple((mu * problem.unit).tolist()),
        alpha=tuple(alpha.tolist()),
        constants=_constants(mu * problem.unit, alpha, fixed, errors, freedom),
        squares=squares,
        vanished=bool((np.abs(problem.columns(alpha) * mu).max(axis=0) < VANISHED).any()),
        ambiguity=solution.ambiguity,
    )


def _standard_errors(
    problem: Weighted, mu: Reals, alpha: Reals, fixed: NDArray[np.bool_], squares: float
) -> Reals:
    """Of (μ in MPa, α), infinite where the measurements leave it open and 0 where α is given."""
    free = np.concatenate([np.full(mu.size, True), ~fixed])
    jacobian = _jacobian(problem, mu, alpha)[:, free]
    scale = np.linalg.norm(jacobian, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    _, singular, directions = np.linalg.svd(jacobian / scale, full_matrices=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.where(directions == 0, 0.0, directions / singular[:, None])
    noise = max(squares / (problem.informative - free.sum()), 1e-20)
    errors = np.zeros(2 * mu.size)
    errors[free] = np.sqrt(noise * (parts**2).sum(axis=0)) / scale
    return errors * np.repeat([problem.unit, 1.0], mu.size)


def _constants(
    mu: Reals, alpha: Reals, fixed: NDArray[np.bool_], errors: Reals, freedom: int
) -> tuple[Constant, ...]:
    width = student_width(freedom)
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
