"""How probable each factor is, given a measured curve and the model's.

For a factor s the residuals are r(s) = y - f(s). With the covariance σ² R of a hypothesis on the
scatter, the size σ integrated with the prior 1/σ, and an offset (if any) with a constant one,

    p(s) ∝ Σ_R p(R) |R|^(-1/2) |1ᵀ R⁻¹ 1|^(-1/2) (rᵀ P r)^(-m/2),

where P is R⁻¹ without the offset's part and m the number of points, less one with an offset. For
one R and a model that is linear in s this is Student's t of m - 1 degrees of freedom around the
generalised least squares; the sum lets the data say how correlated their scatter is. A scatter σ
beyond a tenth of the values is improbable, by exp(-(σ/0.1)²/2) at the most probable σ. The prior of
the factor is constant in log s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.measured.factor.noise import Scatter
from solver.arrays import Reals

PROBABILITY = 0.95


@dataclass(frozen=True, eq=False)
class Likelihood:
    """Probabilities of factors.

    Attributes:
        logs: Natural logarithms of the factors, equally spaced. *Shape:* (k,).
        density: Their probabilities, of sum 1. *Shape:* (k,).
    """

    logs: Reals
    density: Reals

    @property
    def factor(self) -> float:
        """The median."""
        return self.quantile(0.5)

    @property
    def interval(self) -> tuple[float, float]:
        """Factors that enclose 95 %, as much below as above."""
        left = (1 - PROBABILITY) / 2
        return self.quantile(left), self.quantile(1 - left)

    def quantile(self, probability: float) -> float:
        """The factor below which that much lies."""
        step = self.logs[1] - self.logs[0]
        edges = np.append(self.logs - step / 2, self.logs[-1] + step / 2)
        below = np.append(0.0, np.cumsum(self.density))
        return float(np.exp(np.interp(probability, below, edges)))

    @property
    def cut(self) -> tuple[float, float]:
        """Probability at either end of the factors looked at, by the highest."""
        highest = float(self.density.max())
        return float(self.density[0]) / highest, float(self.density[-1]) / highest


def likelihood(logs: Reals, residuals: Reals, scatter: Scatter, offset: bool) -> Likelihood:
    """The probabilities of factors with these residuals.

    Args:
        logs: Logarithms of the factors. *Shape:* (k,).
        residuals: Measurement less model for each factor. *Shape:* (n, k).
        scatter: Hypotheses on the scatter.
        offset: Whether all residuals may have a constant in common.
    """
    count, number = residuals.shape[0], len(scatter.log_weight)
    white = (scatter.whitening.reshape(-1, count) @ residuals).reshape(number, count, -1)
    terms = scatter.log_weight - 0.5 * scatter.log_determinant
    if offset:
        ones = scatter.whitening.sum(axis=2)
        sizes = (ones**2).sum(axis=1)
        along = np.einsum("hn,hnk->hk", ones, white) / sizes[:, None]
        white = white - ones[:, :, None] * along[:, None, :]
        count, terms = count - 1, terms - 0.5 * np.log(sizes)
    squares = np.maximum(np.einsum("hnk,hnk->hk", white, white), np.finfo(float).tiny)
    exponents = terms[:, None] - 0.5 * count * np.log(squares)
    exponents -= 0.5 * squares / count / scatter.usual[:, None] ** 2
    density = np.exp(exponents - exponents.max()).sum(axis=0)
    return Likelihood(logs, density / density.sum())
