"""Laws in closed form, and tables made of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.force.law.interpolation.points import SectionPoint
from bellows_design.force.law.interpolation.rows import Row
from bellows_design.force.law.interpolation.table import Table

AT_REST = 300.0
"""mm^3."""


@dataclass(frozen=True)
class MadeUp:
    """A complementary energy of pressure p, moment M and axial force N, smooth but for contact.

    Below the moment ``onset`` - ``drift`` p a share ``stiffer`` of the compliance is lost; with
    ``stiffer`` 0 there is no contact.
    """

    onset: float = -5.0
    drift: float = 150.0
    stiffer: float = 0.0

    def energy(self, p: float, moment: float, axial: float = 0.0) -> float:
        """N mm."""
        m, n = moment, axial
        smooth = 3 * p * m + (0.009 - 0.03 * p) * m**2 / 2 + 2e-6 * m**3 / 6
        smooth += 40 * p**2 * np.cos(m / 15) + AT_REST * p
        axially = n * (-2 * p + 0.01 * m * p - 1e-4 * m**2) + n**2 * (0.02 + 1e-4 * m) / 2
        below = min(m - self.onset + self.drift * p, 0.0)
        return smooth + axially - self.stiffer * 0.009 * below**2 / 2

    def derivative(self, order: tuple[int, int, int], p: float, m: float) -> float:
        """By pressure, moment and axial force at N = 0, by central differences of second order."""
        step = np.array([1e-4, 1e-2, 1e-2])
        places = [(0.0, 0.0, 0.0, 1.0)]
        for axis, times in enumerate(order):
            for _ in range(times):
                places = [
                    (*(at[k] + (side * step[k] if k == axis else 0) for k in range(3)),
                     at[3] * side / (2 * step[axis]))
                    for at in places
                    for side in (-1, 1)
                ]  # fmt: skip
        return sum(w * self.energy(p + dp, m + dm, dn) for dp, dm, dn, w in places)

    def point(self, pressure: float, moment: float) -> SectionPoint:
        """An equilibrium."""
        along = {"M": (0, 1, 0), "N": (0, 0, 1), "p": (1, 0, 0)}

        def by(*names: str) -> float:
            order = tuple(sum(along[name][k] for name in names) for k in range(3))
            return self.derivative(order, pressure, moment)

        return SectionPoint(
            pressure=pressure,
            moment=moment,
            rotation=by("M"),
            extension=by("N"),
            volume=by("p"),
            energy=self.energy(pressure, moment),
            derivatives=np.array([[by(a, b) for b in "MNp"] for a in "MNp"]),
            stress=abs(moment) / 20,
            position=(0.0, 0.0, 0.0),
            gap=moment - self.onset + self.drift * pressure if self.stiffer else 1.0,
            stable=True,
            factorizations=1,
        )

    def row(self, pressure: float, moments: np.ndarray) -> Row:
        """Equilibria under one pressure."""
        return Row(tuple(self.point(pressure, moment) for moment in moments))

    def table(self, pressures: int, moments: int) -> Table:
        """Rows from 0 to 0.1 MPa, from -60 to 20 N mm."""
        return Table(
            tuple(
                self.row(float(p), np.linspace(-60, 20, moments))
                for p in np.linspace(0, 0.1, pressures)
            )
        )
