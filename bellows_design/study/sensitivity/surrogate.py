"""Polynomials in place of evaluations, fitted to values and gradients, and how far off they are.

A sum of products of Legendre polynomials, the polynomial chaos of uniformly distributed parameters
(D. Xiu, G. E. Karniadakis, SIAM J. Sci. Comput. 24, 2002), by least squares. A gradient by d
parameters gives d more equations for the coefficients than the value alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np

from bellows_design.errors import DesignError
from solver.arrays import Integers, Reals

HIGHEST_DEGREE = 3

EQUATIONS = 1.2
"""For each coefficient at least."""

FOLDS = 5


@dataclass(frozen=True)
class Data:
    """What is known at points.

    Attributes:
        points: (points, parameters), each from -1 to 1.
        values: (points,), of any unit.
        slopes: (points, parameters), their derivatives by these coordinates; None if unknown.
    """

    points: Reals
    values: Reals
    slopes: Reals | None = None

    def of(self, chosen: Integers) -> Data:
        """Those of some points, by number."""
        slopes = None if self.slopes is None else self.slopes[chosen]
        return Data(self.points[chosen], self.values[chosen], slopes)

    @property
    def equations(self) -> int:
        """Numbers that are known."""
        return self.values.size + (0 if self.slopes is None else self.slopes.size)


@dataclass(frozen=True)
class HeldOut:
    """How far a surrogate is off at points that it was not fitted to.

    Attributes:
        r_squared: Share of the values' variance that it explains.
        root_mean_square_percent: Of the values.
        largest_percent: Of the value there.
    """

    r_squared: float
    root_mean_square_percent: float
    largest_percent: float


@dataclass(frozen=True)
class Surrogate:
    """A polynomial: for each term the degree in each parameter, and the coefficient.

    ``error`` is that of polynomials of the same terms at points held out from their fits.
    """

    degrees: Integers
    coefficients: Reals
    error: HeldOut

    def __call__(self, points: Reals) -> Reals:
        """Values, (points,), at (points, parameters)."""
        return _terms(self.degrees, _legendre(points)) @ self.coefficients


def fitted(data: Data) -> Surrogate:
    """The best of a few polynomials, by their errors at points held out.

    Raises ``DesignError`` if there are too few points.
    """
    candidates = [
        degrees
        for degrees in _candidates(data.points.shape[1])
        if len(degrees) * EQUATIONS <= data.equations * (FOLDS - 1) / FOLDS
    ]
    if len(data.values) < FOLDS or not candidates:
        raise DesignError(
            f"samples: {len(data.values)} evaluations that succeeded are too few for a surrogate "
            f"in {data.points.shape[1]} parameters."
        )
    errors = [_held_out(degrees, data) for degrees in candidates]
    best = max(range(len(candidates)), key=lambda i: errors[i].r_squared)
    return Surrogate(candidates[best], _solved(candidates[best], data), errors[best])


def error_at(values: Reals, guessed: Reals) -> HeldOut:
    """How far ``guessed`` is off from ``values``, (points,)."""
    off, spread = guessed - values, values - values.mean()
    relative = 100 * np.abs(off) / np.abs(values)
    variance = float(spread @ spread)
    return HeldOut(
        r_squared=1 - float(off @ off) / variance if variance else float(not off.any()),
        root_mean_square_percent=float(np.sqrt(np.mean(relative**2))),
        largest_percent=float(relative.max()),
    )


def _held_out(degrees: Integers, data: Data) -> HeldOut:
    """Each fifth of the points is guessed from the others."""
    numbers = np.arange(len(data.values))
    guessed = np.empty(len(numbers))
    for fold in range(FOLDS):
        out = numbers % FOLDS == fold
        coefficients = _solved(degrees, data.of(numbers[~out]))
        guessed[out] = _terms(degrees, _legendre(data.points[out])) @ coefficients
    return error_at(data.values, guessed)


def _candidates(count: int) -> Iterator[Integers]:
    """Terms of polynomials in ``count`` parameters, each (terms, parameters)."""
    single = [[(i,) * power for i in range(count)] for power in range(1, HIGHEST_DEGREE + 1)]
    mixed = [list(combinations_with_replacement(range(count), n)) for n in (2, HIGHEST_DEGREE)]
    constant_and_linear = [(), *single[0]]
    yield _degrees(constant_and_linear, count)
    yield _degrees([*constant_and_linear, *single[1]], count)
    yield _degrees([*constant_and_linear, *mixed[0]], count)
    yield _degrees([*constant_and_linear, *mixed[0], *single[2]], count)
    yield _degrees([*constant_and_linear, *mixed[0], *mixed[1]], count)


def _degrees(terms: list[tuple[int, ...]], count: int) -> Integers:
    return np.array([np.bincount(np.array(term, dtype=int), minlength=count) for term in terms])


def _solved(degrees: Integers, data: Data) -> Reals:
    """Coefficients by least squares; slopes count like the values they make over half a side."""
    rows, right = [_terms(degrees, _legendre(data.points))], [data.values]
    if data.slopes is not None:
        rows += [
            _terms(degrees, _legendre(data.points), along) for along in range(data.points.shape[1])
        ]
        right += list(data.slopes.T)
    return np.linalg.lstsq(np.concatenate(rows), np.concatenate(right), rcond=None)[0]


def _legendre(points: Reals) -> tuple[Reals, Reals]:
    """Normalized polynomials and their slopes, (points, parameters, degrees)."""
    norms = np.sqrt(2 * np.arange(HIGHEST_DEGREE + 1) + 1)
    values = np.polynomial.legendre.legvander(points, HIGHEST_DEGREE).astype(np.float64)
    nothing = np.zeros_like(points)
    slopes = np.stack([nothing, nothing + 1, 3 * points, (15 * points**2 - 3) / 2], axis=-1)
    return values * norms, slopes * norms


def _terms(degrees: Integers, legendre: tuple[Reals, Reals], along: int | None = None) -> Reals:
    """Terms at points, (points, terms), or their slopes ``along`` one parameter."""
    values, slopes = legendre
    product = np.ones((values.shape[0], len(degrees)))
    for parameter in range(degrees.shape[1]):
        factor = slopes if parameter == along else values
        product *= factor[:, parameter, degrees[:, parameter]]
    return product
