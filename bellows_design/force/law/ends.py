"""The outer half of the first or the last bubble with the stub beside it.

Its rotation and extension are known at pressures and moments on a grid. Rotation between moments is
a cubic by values and compliances, between pressures by values and derivatives; all that is returned
are derivatives of one energy,

    G(p, M, N) = G(p, 0) + integral of the rotation by M + N e(p, M) + N^2 c(p, M) / 2.

Known is an end without the neighbouring bubble. Where that presses against it, it is stiffer: with
three bubbles of Prototype 1 at 0.1 MPa both ends together turn back by 29.6 degrees under
-34.8 N mm, by this law by 33.7.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.law.interpolation.derivatives import curvatures, monotone_slopes
from bellows_design.force.law.interpolation.polynomials import hermite
from bellows_design.force.law.interpolation.table import KEPT_PRESSURES, ROUNDING, Curves
from bellows_design.force.law.interpolation.tabulated import corrected, response_of
from bellows_design.force.section_law import SectionResponse
from solver.arrays import Reals

BENT = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
"""Beyond its moments the energy and its derivative by the pressure go on as parabolas."""


@dataclass(frozen=True, eq=False)
class EndPiece:
    """A ``SectionLaw`` between the middle of the outermost bubble and its stub, which it turns.

    r pressures, one of them 0, and m moments, one of them 0; full width.

    Attributes:
        length: half of the bubbles' pitch, mm.
        pressures: ascending, MPa.

            *Shape:* (r,).
        moments: ascending, N mm.

            *Shape:* (m,).
        motion: rotation (rad) and extension (mm) without forces.

            *Shape:* (r, m, 2).
        compliance: its derivatives by moment and axial force, symmetric and positive.

            *Shape:* (r, m, 2, 2).
        rate: its derivative by the pressure, per MPa.

            *Shape:* (r, m, 2).
        volumes: air inside without loads, mm^3.

            *Shape:* (r,).
        reaches: moments up to which each row was computed; beyond, its compliance is constant.

            *Shape:* (r, 2).
        softening: factor on all motion but slip: a coarse mesh is too stiff.
        shear_compliance: slip by shear force, mm per N.
    """

    length: float
    pressures: Reals
    moments: Reals
    motion: Reals
    compliance: Reals
    rate: Reals
    volumes: Reals
    reaches: Reals
    softening: float = 1.0
    shear_compliance: float = 0.0

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3): moment, axial, shear.

        Raises ``BellowsError`` for a pressure beyond those known.
        """
        found = response_of(self._curves_at(self._checked(pressure)), loads)
        rest, slip = self.volume_at_rest, self.shear_compliance
        return corrected(found, pressure, loads[:, 2], self.softening, rest, slip)

    @property
    def volume_at_rest(self) -> float:
        """Air inside, mm^3."""
        return float(self.volumes[np.abs(self.pressures).argmin()])

    def reach(self, pressure: float) -> tuple[float, float]:
        """Moments (N mm) up to which it is known, between those of the rows beside."""
        low, high = (np.interp(pressure, self.pressures, side) for side in self.reaches.T)
        return float(low), float(high)

    def within(self, pressure: float, loads: Reals) -> bool:
        """Whether it is known at the moments of section loads (k, 3) at a pressure (MPa)."""
        low, high = self.reach(pressure)
        return bool((loads[:, 0] >= low).all() and (loads[:, 0] <= high).all())

    def _checked(self, pressure: float) -> float:
        low, high = float(self.pressures[0]), float(self.pressures[-1])
        slack = ROUNDING * (high - low)
        if not low - slack <= pressure <= high + slack:
            raise BellowsError(
                f"pressure = {pressure:g} MPa lies outside the law of the finger's ends, which "
                f"goes from {low:g} to {high:g} MPa."
            )
        return float(np.clip(pressure, low, high))

    @cached_property
    def _curves_at(self) -> Callable[[float], Curves]:
        """A chain asks for the same pressure at every step."""
        return lru_cache(KEPT_PRESSURES)(self._curves)

    def _curves(self, pressure: float) -> Curves:
        """Energy, extension and axial compliance, with their derivatives by the pressure."""
        fields = [self._fields(pressure, order) for order in (0, 1)]
        value, slope, bend = (np.stack(each, axis=1) for each in zip(*fields, strict=True))
        return Curves(0.0, 0.0, hermite(self.moments, value, slope, bend, BENT))

    def _fields(self, pressure: float, order: int) -> tuple[Reals, Reals, Reals]:
        """Values and first and second derivatives by the moment, (m, 3) each.

        With ``order`` 1 they are those of the derivatives by the pressure.
        """
        rotation, extension = self._motions(pressure, order).T
        soft, coupling, axial, bend, axial_slope, axial_bend = self._compliances(pressure, order).T
        work = self._work(pressure, order) + _integral(self.moments, rotation, soft)
        return (
            np.stack([work, extension, axial], axis=1),
            np.stack([rotation, coupling, axial_slope], axis=1),
            np.stack([soft, bend, axial_bend], axis=1),
        )

    @cached_property
    def _motions(self) -> Callable[[float, int], Reals]:
        """Rotation and extension (m, 2) by the pressure, or their derivative."""
        from scipy.interpolate import CubicHermiteSpline

        return CubicHermiteSpline(self.pressures, self.motion, self.rate)

    @cached_property
    def _compliances(self) -> Callable[[float, int], Reals]:
        """All that ``_fields`` needs besides (m, 6), monotone from row to row."""
        from scipy.interpolate import PchipInterpolator

        nodes, columns = self.moments, []
        for motion, by in zip(self.motion, self.compliance, strict=True):
            axial = by[:, 1, 1]
            bend = curvatures(nodes, motion[:, 1], by[:, 0, 1])
            axial_slope = monotone_slopes(nodes, axial)
            more = (bend, axial_slope, curvatures(nodes, axial, axial_slope))
            columns.append(np.stack([by[:, 0, 0], by[:, 0, 1], axial, *more], axis=1))
        return PchipInterpolator(self.pressures, np.array(columns))

    @cached_property
    def _work(self) -> Callable[[float, int], float]:
        """Energy without section loads: the volume's integral by the pressure."""
        from scipy.interpolate import PchipInterpolator

        found = PchipInterpolator(self.pressures, self.volumes).antiderivative()
        at_rest = found(0.0)
        return lambda pressure, order: float(found(pressure, order) - (0 if order else at_rest))


def _integral(nodes: Reals, values: Reals, slopes: Reals) -> Reals:
    """From 0, a node, to nodes (n,) of the cubics through values and slopes (n,)."""
    h = np.diff(nodes)
    parts = h * (values[:-1] + values[1:]) / 2 - h**2 * np.diff(slopes) / 12
    whole = np.concatenate([[0.0], np.cumsum(parts)])
    result: Reals = whole - whole[np.flatnonzero(nodes == 0.0)[0]]
    return result
