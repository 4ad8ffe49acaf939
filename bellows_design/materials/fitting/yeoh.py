"""Yeoh's model, W = C₁₀ (I₁ − 3) + C₂₀ (I₁ − 3)² + C₃₀ (I₁ − 3)³, from measurements.

The stress is linear in the constants. C₁₀ ≥ 0 as every μ; C₃₀ ≥ 0, or the material would soften
without end; C₂₀ is mostly negative.
Source: O. H. Yeoh, Rubber Chem. Technol. 66, 754, 1993.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bellows_design.materials.fitting.fit_result import Estimate, Fit, judged
from bellows_design.materials.fitting.linear import fit_linear
from bellows_design.materials.fitting.measurements import Measurements
from bellows_design.materials.fitting.weighted import Weighted
from solver.material.homogeneous import MODES, Reals, first_invariant, unit_stresses

if TYPE_CHECKING:
    from bellows_design.materials.laws import FitModel

CONSTANTS = ("c10", "c20", "c30")
LEAST = (0.0, -np.inf, 0.0)


def fit_yeoh(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    """Fit all three constants to ``data``, which ``problem`` has weighted."""
    found = fit_linear(problem, _columns(data, problem), CONSTANTS, LEAST)
    first, *higher = found.values.tolist()
    estimate = Estimate(
        (2 * first,), (2.0,), found.constants, found.squares, found.vanished, tuple(higher)
    )
    return judged(data, problem, model.name, estimate)


def _columns(data: Measurements, problem: Weighted) -> Reals:
    """(n, 3) weighted stress of each order i with Cᵢ₀ = 1: i (I₁ − 3)^(i−1) (2 λ₁² − 2 λ₃²)/λ."""
    exponents = np.array([mode.exponents for mode in MODES.values()])[data.mode]
    invariant = first_invariant(problem.logs[:, None] * exponents)
    unit = unit_stresses(problem.mean, problem.gap, problem.logs, np.array([2.0]))[:, 0]
    orders = np.arange(1, len(CONSTANTS) + 1)
    powers: Reals = orders * invariant[:, None] ** (orders - 1)
    return (2 * problem.weight * unit)[:, None] * powers
