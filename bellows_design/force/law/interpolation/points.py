"""One equilibrium of half a bubble: what the table holds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Reals

if TYPE_CHECKING:
    from solver import Peak, SectionDerivatives

HALVES = 2.0
"""The cell that is solved for has half of the width."""


@dataclass(frozen=True)
class SectionPoint:
    """Half a bubble, full width, in equilibrium under a pressure and a moment.

    Attributes:
        pressure: MPa.
        moment: N mm.
        rotation: rad.
        extension: mm.
        volume: air inside, mm^3.
        energy: complementary, N mm; its derivatives by moment, axial force and pressure are
            rotation, extension and volume.
        derivatives: of rotation, extension and volume (rows) by moment (N mm), axial force (N) and
            pressure (MPa) (columns), symmetric.

            *Shape:* (3, 3).
        stress: highest von Mises stress, MPa.
        position: where, in the undeformed half bubble from the bubble's middle, mm.
        gap: air to the neighbouring bubble, mm; negative where they touch, None if none faces it.
        stable: under these loads; None if the linear solver cannot tell.
        factorizations: that it took.
    """

    pressure: float
    moment: float
    rotation: float
    extension: float
    volume: float
    energy: float
    derivatives: Reals
    stress: float
    position: tuple[float, float, float]
    gap: float | None
    stable: bool | None
    factorizations: int

    @staticmethod
    def of(
        couple: float,
        section: SectionDerivatives,
        peak: Peak,
        gap: float | None,
        stable: bool | None,
        factorizations: int,
    ) -> SectionPoint:
        """The point of a cell under ``couple`` (N mm), half of the full width's moment."""
        extensive = np.array([1.0, 1.0, HALVES])
        return SectionPoint(
            pressure=section.pressure,
            moment=HALVES * couple,
            rotation=section.tilt,
            extension=section.shift,
            volume=HALVES * section.volume,
            energy=HALVES * section.complementary_energy,
            derivatives=section.derivatives * np.outer(extensive, extensive) / HALVES,
            stress=peak.value,
            position=peak.position,
            gap=gap,
            stable=stable,
            factorizations=factorizations,
        )

    @property
    def touches(self) -> bool:
        """Whether it presses against the neighbouring bubble."""
        return self.gap is not None and self.gap <= 0

    @property
    def compliance(self) -> float:
        """Derivative of the rotation by the moment, rad per N mm."""
        return float(self.derivatives[0, 0])
