"""Yeoh's model, W = C₁₀ (I₁ − 3) + C₂₀ (I₁ − 3)² + C₃₀ (I₁ − 3)³, from measurements.

The stress is linear in the constants. C₁₀ ≥ 0 as every μ; C₃₀ ≥ 0, or the material would soften
without end; C₂₀ is mostly negative.
Source: O. H. Yeoh, Rubber Chem. Technol. 66, 754, 1993.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bellows_design.materials.fitting.fit_result import Estimate, Fit, judged
from bellows_design.materials.fitting.linear import columns_of, fit_linear
from bellows_design.materials.fitting.weighted import Weighted
from bellows_design.materials.measurements.points import Measurements
from solver.arrays import Reals
from solver.material.constants import Constants
from solver.material.ogden import packed

if TYPE_CHECKING:
    from bellows_design.materials.fitting.fit_model import FitModel

CONSTANTS = ("c10", "c20", "c30")
LEAST = (0.0, -np.inf, 0.0)


def fit_yeoh(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    """Fit all three constants to ``data``, which ``problem`` has weighted."""
    columns = columns_of(data, problem, _law, len(CONSTANTS))
    found = fit_linear(problem, columns, CONSTANTS, LEAST)
    first, *higher = found.values.tolist()
    estimate = Estimate(
        law=_law(found.values),
        constants=found.constants,
        squares=found.squares,
        vanished=found.vanished,
        mu=(2 * first,),
        alpha=(2.0,),
        higher=tuple(higher),
    )
    return judged(data, problem, model.name, estimate)


def _law(values: Reals) -> Constants:
    """Constants (3,) as those of Ogden's law with Yeoh's higher terms."""
    return packed([2 * values[0]], [2.0], values[1:])
