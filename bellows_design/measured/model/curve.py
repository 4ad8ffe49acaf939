"""A curve of the model, and what it is for other stiffnesses.

Without dead loads, scaling all moduli of a body by s is the same as dividing its pressure by s: the
equations of equilibrium are homogeneous in both. Angles and displacements are
f(p; s) = f(p/s; 1), forces F(p; s) = s F(p/s; 1), so that one curve tells all factors.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.interpolate import PchipInterpolator

from bellows_design.errors import UnreachedError
from solver.arrays import Reals

FEWEST_POINTS = 5
"""Of a curve, for every other to say something."""


@dataclass(frozen=True, eq=False)
class StoredCurve:
    """What the model says at some pressures.

    Attributes:
        pressure: Its size, MPa, ascending from 0. *Shape:* (k,).
        value: In the quantity's unit. *Shape:* (k,).
        error: Estimated error of each value by the mesh and the like, in its unit, not negative.
            *Shape:* (k,).
        ending: Why there is no more of it beyond its last pressure, as a sentence; empty where it
            was not asked for more.
        notes: Sentences on what it was computed by.

    Raises:
        UnreachedError: It has less than two points, or its pressures do not ascend.
    """

    pressure: Reals
    value: Reals
    error: Reals
    ending: str = ""
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        alike = self.pressure.shape == self.value.shape == self.error.shape
        if not (alike and self.pressure.size > 1 and (np.diff(self.pressure) > 0).all()):
            raise UnreachedError(
                "the model has no curve to compare with: it was solved at no pressure."
                + f" {self.ending}".rstrip()
            )

    @property
    def reach(self) -> float:
        """Size of its last pressure, MPa."""
        return float(self.pressure[-1])

    def values(self, pressure: Reals) -> Reals:
        """Between its points by cubics that keep the course of the points; beyond its end NaN."""
        return _inside(self._value, pressure, self.reach)

    def errors(self, pressure: Reals) -> Reals:
        """Estimated errors, likewise; with what the cubics may be off between points."""
        return _inside(self._error, pressure, self.reach)

    @cached_property
    def _value(self) -> PchipInterpolator:
        return PchipInterpolator(self.pressure, self.value, extrapolate=True)

    @cached_property
    def _error(self) -> PchipInterpolator:
        error = self.error + interpolation_error(self.pressure, self.value)
        return PchipInterpolator(self.pressure, error, extrapolate=True)


def interpolation_error(pressure: Reals, value: Reals) -> Reals:
    """By how much a curve may be off between its points (k,): half of what every other shows.

    Where points are left out, cubics through the others miss them by some amount. Half as far apart
    they miss a smooth curve by an eighth of it to a quarter, and a kink by about half.
    """
    missed = np.zeros(pressure.size)
    if pressure.size < FEWEST_POINTS:
        return missed
    kept = np.arange(0, pressure.size, 2)
    missed[1::2] = np.abs(
        PchipInterpolator(pressure[kept], value[kept])(pressure[1::2]) - value[1::2]
    )
    if pressure.size % 2 == 0:
        missed[-1] = 0.0  # beyond the last that is kept
    around = np.concatenate(([0.0], missed, [0.0]))
    beside: Reals = np.maximum(around[:-2], around[2:]) / 2
    return np.maximum(missed, beside) / 2


def _inside(curve: PchipInterpolator, pressure: Reals, reach: float) -> Reals:
    inside = pressure <= reach * (1 + 1e-9)
    result: Reals = np.where(inside, curve(np.minimum(pressure, reach)), np.nan)
    return result


class ModelCurve(Protocol):
    """What the model says of a part whose material is ``factor`` times as stiff as it stands."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what it was computed by."""
        ...

    @property
    def ending(self) -> str:
        """Why it ends, if it was asked for more; else empty."""
        ...

    def reach(self, factor: float) -> float:
        """Size of the highest pressure that it is known at, MPa."""
        ...

    def values(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """At sizes of pressure, MPa (n,), in the quantity's unit; NaN beyond its reach."""
        ...

    def errors(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """Estimated errors of these by the mesh and the like (n,), not negative."""
        ...

    def table(self, pressure: Reals, factors: Reals) -> Reals:
        """Values at n pressures for k factors (n, k)."""
        ...


@dataclass(frozen=True)
class ScaledByPressure:
    """One curve for all factors: exact without dead loads and where all stiffness is scaled.

    Attributes:
        curve: Of the factor 1.
        by_force: Whether its values are forces.
    """

    curve: StoredCurve
    by_force: bool = False

    @property
    def notes(self) -> tuple[str, ...]:
        """Those of its curve."""
        return self.curve.notes

    @property
    def ending(self) -> str:
        """That of its curve."""
        return self.curve.ending

    def reach(self, factor: float) -> float:
        """In proportion to the factor."""
        return self.curve.reach * factor

    def values(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """f(p/s), or s f(p/s) of a force."""
        return (factor if self.by_force else 1.0) * self.curve.values(pressure / factor)

    def errors(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """Likewise."""
        return (factor if self.by_force else 1.0) * self.curve.errors(pressure / factor)

    def table(self, pressure: Reals, factors: Reals) -> Reals:
        """All at once."""
        values = self.curve.values(pressure[:, None] / factors)
        return factors * values if self.by_force else values


@dataclass(frozen=True)
class BetweenFactors:
    """Curves at several factors, for bodies with dead loads or parts whose stiffness stays.

    Each is scaled to the factor asked for as if it were ``ScaledByPressure``, which leaves little
    to depend on the factor; that is interpolated by a polynomial in its logarithm.

    Attributes:
        curves: Factor -> curve.
        by_force: Whether their values are forces.
    """

    curves: dict[float, StoredCurve]
    by_force: bool = False

    @property
    def notes(self) -> tuple[str, ...]:
        """Those of all its curves, each once."""
        return tuple(dict.fromkeys(note for each in self.curves.values() for note in each.notes))

    @property
    def ending(self) -> str:
        """That of the curve that ends first."""
        return min(self._scaled.items(), key=lambda item: item[1].reach(1 / item[0]))[1].ending

    def reach(self, factor: float) -> float:
        """The least of its curves'."""
        return min(each.reach(factor / known) for known, each in self._scaled.items())

    def values(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """The mean of all curves, each scaled, with the weights of the polynomial."""
        parts = self._weights(factor)
        terms = (
            weight * each.values(pressure, factor / known)
            for (known, each), weight in zip(self._scaled.items(), parts, strict=True)
        )
        return np.sum(list(terms), axis=0)

    def errors(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """The largest of its curves'."""
        found = [each.errors(pressure, factor / known) for known, each in self._scaled.items()]
        return np.max(found, axis=0)

    def table(self, pressure: Reals, factors: Reals) -> Reals:
        """One factor after the other."""
        return np.array([self.values(pressure, float(each)) for each in factors]).T

    @cached_property
    def _scaled(self) -> dict[float, ScaledByPressure]:
        return {
            factor: ScaledByPressure(curve, self.by_force) for factor, curve in self.curves.items()
        }

    def _weights(self, factor: float) -> Reals:
        """Of Lagrange's polynomial in log s; beyond the outermost curves as at these."""
        nodes = np.log(list(self.curves))
        at = float(np.clip(np.log(factor), nodes.min(), nodes.max()))
        ratios = [
            np.prod([(at - other) / (node - other) for other in nodes if other != node])
            for node in nodes
        ]
        return np.array(ratios, float)


@dataclass(frozen=True)
class Zeroed:
    """A curve counted from its value at a pressure, as the measurement is.

    Attributes:
        curve: As it stands.
        pressure: Size of that pressure, MPa.
    """

    curve: ModelCurve
    pressure: float

    @property
    def notes(self) -> tuple[str, ...]:
        """Those of its curve."""
        return self.curve.notes

    @property
    def ending(self) -> str:
        """That of its curve."""
        return self.curve.ending

    def reach(self, factor: float) -> float:
        """That of its curve."""
        return self.curve.reach(factor)

    def values(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """Less the value at the zero."""
        return self.curve.values(pressure, factor) - self.curve.values(self._zero, factor)

    def errors(self, pressure: Reals, factor: float = 1.0) -> Reals:
        """Errors go with values, so that the zero takes its own with it."""
        return np.abs(self.curve.errors(pressure, factor) - self.curve.errors(self._zero, factor))

    def table(self, pressure: Reals, factors: Reals) -> Reals:
        """Less the values at the zero."""
        return self.curve.table(pressure, factors) - self.curve.table(self._zero, factors)

    @property
    def _zero(self) -> Reals:
        return np.array([self.pressure])
