"""The interpolated complementary energy of half a bubble, from rows of equilibria.

Interpolated are G without axial force, the extension, and the compliance against axial force:

    G(p, M, N) = G(p, M) + N e(p, M) + N^2 c(p, M) / 2.

Within a row each is a quintic between neighbouring moments, so that the tangent of a chain is
continuous; between rows a cubic, by values and derivatives by the pressure. All that is returned
are derivatives of this one function.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.interpolation.coordinates import Coordinates, hermite_weights
from bellows_design.force.law.interpolation.polynomials import Piecewise, evaluated, pieces
from bellows_design.force.law.interpolation.row_fields import row_fields
from bellows_design.force.law.interpolation.rows import Row
from solver.arrays import Reals


@dataclass(frozen=True)
class Fields:
    """Energy, extension and axial compliance (k, 3) by moment and pressure, at k moments.

    Each with its derivatives by the moment, first and second, by the pressure, and by both.
    """

    value: Reals
    by_moment: Reals
    by_moment_twice: Reals
    by_pressure: Reals
    by_both: Reals


@dataclass(frozen=True)
class Curves:
    """The fields at one pressure and their derivatives by it at constant m, as functions of m.

    ``origin``: the moment at m = 0, N mm; ``rate``: its derivative by the pressure.
    """

    origin: float
    rate: float
    polynomials: Piecewise

    def fields(self, moments: Reals) -> Fields:
        """At moments (k,), N mm."""
        places = moments - self.origin
        own = pieces(self.polynomials.breaks, places)
        found = self.polynomials.coefficients[own]
        distances = places - self.polynomials.origins[own]
        value, slope, bend = (evaluated(found, distances, order) for order in range(3))
        return Fields(
            value=value[:, 0],
            by_moment=slope[:, 0],
            by_moment_twice=bend[:, 0],
            by_pressure=value[:, 1] - self.rate * slope[:, 0],
            by_both=slope[:, 1] - self.rate * bend[:, 0],
        )


@dataclass(frozen=True, eq=False)
class Table:
    """Rows by ascending pressure, at least two."""

    rows: tuple[Row, ...]

    @cached_property
    def coordinates(self) -> Coordinates:
        """What rows are compared at."""
        return Coordinates.of(self.rows)

    @cached_property
    def pressures(self) -> Reals:
        """Of the rows, MPa."""
        return self.coordinates.pressures

    def with_row(self, row: Row) -> Table:
        """The table with another row, or with a new one of the same pressure."""
        others = [each for each in self.rows if each.pressure != row.pressure]
        return Table(tuple(sorted((*others, row), key=lambda each: each.pressure)))

    @property
    def apart(self) -> Table | None:
        """The same without neighbours: rows as far as these do not touch; None if one has none.

        Where they would touch, the compliance stays what it was.
        """
        rows = [row.apart for row in self.rows]
        known = tuple(row for row in rows if row is not None)
        return Table(known) if len(known) == len(rows) else None

    def interval(self, pressure: float) -> int:
        """Number of the row below a pressure. Raises ``BellowsError`` beyond the rows."""
        low, high = self.pressures[0], self.pressures[-1]
        slack = ROUNDING * (high - low)
        if not low - slack <= pressure <= high + slack:
            raise BellowsError(
                f"pressure = {pressure:g} MPa lies outside the table of the section's law, which "
                f"goes from {low:g} to {high:g} MPa."
            )
        found = int(np.searchsorted(self.pressures, pressure, side="right")) - 1
        return int(np.clip(found, 0, len(self.rows) - 2))

    def reach(self, pressure: float) -> tuple[float, float]:
        """Moments (N mm) up to which there are points, between those of the rows beside."""
        number, (weights, _) = self.interval(pressure), self._weights(pressure)
        low, high = self.pressures[number : number + 2]
        share = (pressure - low) / (high - low)
        near, far = (np.array(self._relative(n)) for n in (number, number + 1))
        below, above = self.coordinates.at(weights, number) + (1 - share) * near + share * far
        return float(below), float(above)

    def curves(self, pressure: float) -> Curves:
        """The fields at a pressure (MPa). Raises ``BellowsError`` beyond the rows."""
        return self._curves_at(float(pressure))

    def _weights(self, pressure: float) -> tuple[Reals, Reals]:
        """Of the rows beside a pressure, and their derivatives by it."""
        number = self.interval(pressure)
        low, high = self.pressures[number : number + 2]
        step = high - low
        share = (pressure - low) / step
        return hermite_weights(share, step), hermite_weights(share, step, 1)

    def _relative(self, number: int) -> tuple[float, float]:
        """First and last m of a row."""
        origin, (low, high) = self.coordinates.origins[number], self.rows[number].reach
        return low - origin, high - origin

    @cached_property
    def _fields(self) -> tuple[Piecewise, ...]:
        """Of every row as functions of m: (2, 3), values and derivatives by p at constant m."""
        known = zip(self.rows, self.coordinates.origins, self.coordinates.rates, strict=True)
        return tuple(row_fields(row, float(origin), float(rate)) for row, origin, rate in known)

    @cached_property
    def _curves_at(self) -> Callable[[float], Curves]:
        """A chain asks for the same pressure at every step."""
        return lru_cache(KEPT_PRESSURES)(self._blended)

    def _blended(self, pressure: float) -> Curves:
        number, weights = self.interval(pressure), np.stack(self._weights(pressure))
        breaks, polynomials = self._pairs[number]
        blended = np.einsum("dw,bwfc->bdfc", weights, polynomials)
        origin, rate = (self.coordinates.at(each, number) for each in weights)
        return Curves(origin, rate, Piecewise(breaks, blended))

    @cached_property
    def _pairs(self) -> tuple[tuple[Reals, Reals], ...]:
        """Of every interval: breaks of both rows (b,), and polynomials (b + 1, 4, 3, 6).

        The four are what ``hermite_weights`` weighs.
        """
        pairs = []
        for near, far in zip(self._fields, self._fields[1:], strict=False):
            breaks = np.union1d(near.breaks, far.breaks)
            both = [each.on(breaks).coefficients for each in (near, far)]
            pairs.append((breaks, np.concatenate(both, axis=1)))
        return tuple(pairs)


ROUNDING = 1e-9
"""Share of the pressures' range."""

KEPT_PRESSURES = 16
