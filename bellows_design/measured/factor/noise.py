"""What the scatter of a measured curve may be like: its course and its correlation.

Neither is known beforehand. Sizes of the scatter go with pressure as stated by a column, or are
constant, or go with the value. Correlated scatter, as of a camera that moves or of friction in a
gauge, is an Ornstein-Uhlenbeck process over pressure, with uncorrelated scatter beside it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals

LENGTHS = (0.1, 0.3, 1.0, 3.0)
"""Correlation lengths by the range of pressures."""
SHARES = (0.5, 0.9, 1.0)
"""Of the variance that is correlated."""
FLOORS = (0.005, 0.05, 0.3)
"""Of the largest value: scatter in proportion to the value does not fall below that."""
LEAST_SPREAD = 0.25
"""Of the median: a stated standard deviation that is smaller, of a few readings, is by chance."""


USUAL = 0.1
"""Of the largest value. More scatter is improbable: a smooth curve would be scatter altogether, and
any factor would do."""


@dataclass(frozen=True, eq=False)
class Scatter:
    """Hypotheses on the scatter of n points, but for its size.

    Attributes:
        whitening: Of each, the inverse of the lower triangular root of its covariance. *Shape:*
            (h, n, n).
        log_determinant: Of each covariance. *Shape:* (h,).
        log_weight: Logarithm of each one's probability before the data. *Shape:* (h,).
        usual: Of each, the size from which on it is improbable. *Shape:* (h,).
    """

    whitening: Reals
    log_determinant: Reals
    log_weight: Reals
    usual: Reals


def scatter_of(
    pressure: Reals, value: Reals, spread: Reals | None, zero: float | None = None
) -> Scatter:
    """All hypotheses on the scatter of points at ``pressure`` (n,), the model's ``value`` (n,).

    Values that are counted from that at the pressure ``zero`` have its scatter in common.
    """
    count = pressure.size
    differences = np.eye(count)
    if zero is not None:
        pressure, value = np.append(pressure, zero), np.append(value, 0.0)
        spread = None if spread is None else np.append(spread, np.median(spread))
        differences = np.hstack([differences, -np.ones((count, 1))])
    sizes = np.array(list(_sizes(value, spread)))
    weights, correlations = zip(*_correlations(pressure), strict=True)
    covariance = np.einsum("si,cij,sj->scij", sizes, np.array(correlations), sizes)
    covariance = covariance.reshape(-1, *covariance.shape[2:])
    roots = np.linalg.cholesky(differences @ covariance @ differences.T)
    diagonal = np.diagonal(roots, axis1=1, axis2=2)
    return Scatter(
        np.linalg.inv(roots),
        2 * np.log(diagonal).sum(axis=1),
        np.log(np.tile(weights, len(sizes)) / len(sizes)),
        np.repeat(USUAL * np.abs(value).max() / sizes.max(axis=1), len(weights)),
    )


def _sizes(value: Reals, spread: Reals | None) -> Iterator[Reals]:
    """Standard deviations (n,) up to a factor."""
    if spread is not None and np.median(spread) > 0:
        yield np.maximum(spread, LEAST_SPREAD * float(np.median(spread)))
        return
    size = np.abs(value)
    largest = float(size.max()) or 1.0
    yield np.full(value.size, largest)
    for floor in FLOORS:
        yield np.maximum(size, floor * largest)


def _correlations(pressure: Reals) -> Iterator[tuple[float, Reals]]:
    """Probabilities and correlation matrices: none as probable as all the others together."""
    count = pressure.size
    yield 0.5, np.eye(count)
    span = float(np.ptp(pressure)) or 1.0
    apart = np.abs(pressure[:, None] - pressure[None, :]) / span
    each = 0.5 / (len(LENGTHS) * len(SHARES))
    for length in LENGTHS:
        correlated = np.exp(-apart / length)
        for share in SHARES:
            yield each, share * correlated + (1 - share) * np.eye(count)
