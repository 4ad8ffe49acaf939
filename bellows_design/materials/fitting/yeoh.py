"""Yeoh's model, W = C₁₀ (I₁ − 3) + C₂₀ (I₁ − 3)² + C₃₀ (I₁ − 3)³, from measurements.

The stress is linear in the constants: one step of least squares, over the same relative errors as
Ogden's. C₁₀ ≥ 0 as every μ; C₃₀ ≥ 0, or the material would soften without end; C₂₀ is mostly
negative. Intervals are Student's, at 95 %, exact for Gaussian errors.
Source: O. H. Yeoh, Rubber Chem. Technol. 66, 754, 1993.
"""

from __future__ import annotations

import math

import numpy as np

from bellows_design.materials.fitting.fit_result import (
    VANISHED,
    Constant,
    Fit,
    aicc_of,
    difference_of,
    misfit_of,
    r_squared_of,
)
from bellows_design.materials.fitting.measurements import Measurements
from bellows_design.materials.fitting.weighted import Weighted
from solver.material.homogeneous import MODES, Reals, first_invariant, unit_stresses
from solver.material.stability import stability

CONSTANTS = ("c10", "c20", "c30")
LEAST = (0.0, -np.inf, 0.0)


def fit_yeoh(data: Measurements, problem: Weighted) -> Fit:
    """Fit all three constants to ``data``, which ``problem`` has weighted."""
    from scipy.optimize import lsq_linear

    columns = _columns(data, problem)
    scale = np.linalg.norm(columns, axis=0)
    scaled = lsq_linear(columns / scale, problem.target, (LEAST, np.inf), tol=1e-14)
    values = scaled.x / scale
    relative = math.sqrt(float(((columns @ values - problem.target) ** 2).sum()) / problem.telling)
    constants = values * problem.unit
    mu, alpha, higher = (2 * float(constants[0]),), (2.0,), tuple(constants[1:].tolist())
    difference = difference_of(data, np.array(mu), np.array(alpha), higher)
    return Fit(
        model="yeoh",
        mu=mu,
        alpha=alpha,
        constants=_intervals(constants, columns, relative, problem),
        points=data.stress.size,
        r_squared=r_squared_of(data.stress, difference),
        relative_error=relative,
        misfit=misfit_of(data, difference),
        aicc=aicc_of(relative, problem.telling, len(CONSTANTS) + 1),
        vanished=bool((np.abs(columns * values).max(axis=0) < VANISHED).any()),
        rivalry=0.0,
        stability=stability(mu, alpha, higher),
        higher=higher,
    )


def _columns(data: Measurements, problem: Weighted) -> Reals:
    """(n, 3) weighted stress of each order i with Cᵢ₀ = 1: i (I₁ − 3)^(i−1) (2 λ₁² − 2 λ₃²)/λ."""
    exponents = np.array([mode.exponents for mode in MODES.values()])[data.mode]
    invariant = first_invariant(problem.logs[:, None] * exponents)
    unit = unit_stresses(problem.mean, problem.gap, problem.logs, np.array([2.0]))[:, 0]
    orders = np.arange(1, len(CONSTANTS) + 1)
    powers: Reals = orders * invariant[:, None] ** (orders - 1)
    return (2 * problem.weight * unit)[:, None] * powers


def _intervals(
    values: Reals, columns: Reals, relative: float, problem: Weighted
) -> tuple[Constant, ...]:
    """The constants, MPa, with standard errors and intervals."""
    from scipy.stats import t as student

    freedom = problem.telling - len(CONSTANTS)
    scale = np.linalg.norm(columns, axis=0)
    inverse = np.linalg.pinv(columns / scale)
    noise = relative * math.sqrt(problem.telling / freedom)
    errors = noise * np.linalg.norm(inverse, axis=1) / scale * problem.unit
    width = float(student.ppf(0.975, freedom))
    return tuple(
        Constant(
            name, "MPa", value, error, value - width * error, value + width * error, signed=True
        )
        for name, value, error in zip(CONSTANTS, values.tolist(), errors.tolist(), strict=True)
    )
