"""What a chain needs to know of a piece of the actuator: motion under section loads.

The piece lies between two sections, normal to the plane of symmetry: the middle of a bubble and the
middle of the gap beside it. Seen from the first, the second turns by ``rotation`` (rad, positive
from +x towards -z, as the actuator curls under pressure), moves away by ``extension`` along the
first one's normal and by ``slip`` (mm) along its plane, towards -z. All loads and energies are
those of the full width. The origin of a section is its point at the height z = 0.

The complementary energy G(p; M, N, Q) has the motion as its derivatives by the section loads M
(N mm), N and Q (N), that work on it, and the enclosed volume as that by the pressure. So a chain
of such pieces has a potential and a symmetric tangent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from solver.arrays import Reals


@dataclass(frozen=True)
class SectionResponse:
    """How k equal pieces answer to one pressure and to section loads of their own.

    Attributes:
        energy: complementary energy.

            *Shape:* (k,) in N mm.
        motion: rotation, extension and slip; the derivative of ``energy`` by the section loads.

            *Shape:* (k, 3) in rad, mm, mm.
        compliance: its derivative by the section loads, symmetric.

            *Shape:* (k, 3, 3).
        volume: air inside; the derivative of ``energy`` by the pressure.

            *Shape:* (k,) in mm^3.
        motion_by_pressure: derivative of ``motion`` by the pressure, and of ``volume`` by the
            section loads.

            *Shape:* (k, 3) per MPa.
    """

    energy: Reals
    motion: Reals
    compliance: Reals
    volume: Reals
    motion_by_pressure: Reals


class SectionLaw(Protocol):
    """The law of one kind of piece."""

    @property
    def length(self) -> float:
        """Distance of the two sections at rest, mm; zero for a hinge."""
        ...

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3): moment, axial, shear."""
        ...


@dataclass(frozen=True)
class LinearLaw:
    """A piece that answers in proportion: for limits with closed forms.

    Attributes:
        length: of the piece at rest, mm.
        compliance: motion by section loads.

            *Shape:* (3, 3).
        motion_by_pressure: motion per MPa without section loads.

            *Shape:* (3,).
        volume_at_rest: mm^3.
        volume_by_pressure: mm^3 per MPa.
    """

    length: float
    compliance: Reals
    motion_by_pressure: Reals
    volume_at_rest: float = 0.0
    volume_by_pressure: float = 0.0

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3)."""
        free = pressure * np.asarray(self.motion_by_pressure)
        elastic = loads @ self.compliance
        return SectionResponse(
            energy=loads @ free
            + 0.5 * (loads * elastic).sum(axis=1)
            + pressure * self.volume_at_rest
            + 0.5 * pressure**2 * self.volume_by_pressure,
            motion=free + elastic,
            compliance=np.broadcast_to(self.compliance, (len(loads), 3, 3)),
            volume=self.volume_at_rest
            + pressure * self.volume_by_pressure
            + loads @ np.asarray(self.motion_by_pressure),
            motion_by_pressure=np.broadcast_to(self.motion_by_pressure, loads.shape),
        )
