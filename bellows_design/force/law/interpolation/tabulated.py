"""A section's law from a table."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from bellows_design.force.law.interpolation.neutral_height import (
    loads_about,
    moments_about,
    neutral_height,
    response_at_origin,
    row_about,
)
from bellows_design.force.law.interpolation.table import Curves, Fields, Table
from bellows_design.force.section_law import SectionResponse
from solver.arrays import Reals


@dataclass(frozen=True, eq=False)
class TabulatedLaw:
    """A ``SectionLaw`` by interpolation.

    Attributes:
        length: of the piece at rest, mm.
        table: its equilibria.
        softening: factor on all motion, and on the volume beyond that at rest: a coarse mesh is too
            stiff.
        volume_at_rest: mm^3.
        shear_compliance: slip by shear force, mm per N.
    """

    length: float
    table: Table
    softening: float = 1.0
    volume_at_rest: float = 0.0
    shear_compliance: float = 0.0

    def on(self, table: Table) -> TabulatedLaw:
        """The same law of another table."""
        return replace(self, table=table)

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3): moment, axial, shear.

        Beyond the moments of the table the compliance stays constant; ``within`` tells.

        Raises:
            BellowsError: a pressure beyond those of the table.
        """
        about = response_of(self._about.curves(pressure), loads_about(loads, self.height))
        found = response_at_origin(about, self.height)
        rest, slip = self.volume_at_rest, self.shear_compliance
        return corrected(found, pressure, loads[:, 2], self.softening, rest, slip)

    def within(self, pressure: float, loads: Reals) -> bool:
        """Whether section loads (k, 3) at a pressure (MPa) are in the table, by their moments."""
        low, high = self.table.reach(pressure)
        moments = self.moments(loads)
        return bool((moments >= low).all() and (moments <= high).all())

    def moments(self, loads: Reals) -> Reals:
        """What the table goes by: moments (k,) about the neutral height, N mm."""
        return moments_about(loads, self.height)

    @cached_property
    def height(self) -> float:
        """At which an axial force leaves the gap to the neighbour alone, mm; 0 if none is known."""
        return neutral_height(self.table.rows)

    @cached_property
    def _about(self) -> Table:
        """The table about that height."""
        return Table(tuple(row_about(row, self.height) for row in self.table.rows))


def response_of(curves: Curves, loads: Reals) -> SectionResponse:
    """By moment and axial force, as on the mesh that curves were computed on."""
    moment, axial = loads[:, 0], loads[:, 1]
    fields = curves.fields(moment)
    by_axial = np.stack([np.ones_like(axial), axial, axial**2 / 2], axis=1)
    extension = fields.value[:, 1] + axial * fields.value[:, 2]
    motion, rate = np.zeros((2, len(loads), 3))
    motion[:, 0], motion[:, 1] = (fields.by_moment * by_axial).sum(axis=1), extension
    rate[:, 0] = (fields.by_both * by_axial).sum(axis=1)
    rate[:, 1] = fields.by_pressure[:, 1] + axial * fields.by_pressure[:, 2]
    return SectionResponse(
        energy=(fields.value * by_axial).sum(axis=1),
        motion=motion,
        compliance=_compliance(fields, by_axial, axial),
        volume=(fields.by_pressure * by_axial).sum(axis=1),
        motion_by_pressure=rate,
    )


def corrected(
    found: SectionResponse, pressure: float, shear: Reals, soft: float, rest: float, slip: float
) -> SectionResponse:
    """A response softened by a factor, and with the slip under shear forces (k,).

    ``rest``: volume at rest, mm^3, which the factor does not change; ``slip``: by shear force.
    """
    motion, compliance = soft * found.motion, soft * found.compliance
    motion[:, 2] = slip * shear
    compliance[:, 2, 2] = slip
    return SectionResponse(
        energy=soft * found.energy + (1 - soft) * pressure * rest + slip * shear**2 / 2,
        motion=motion,
        compliance=compliance,
        volume=soft * found.volume + (1 - soft) * rest,
        motion_by_pressure=soft * found.motion_by_pressure,
    )


def _compliance(fields: Fields, by_axial: Reals, axial: Reals) -> Reals:
    """Of rotation and extension by moment and axial force, in (k, 3, 3)."""
    result = np.zeros((len(axial), 3, 3))
    result[:, 0, 0] = (fields.by_moment_twice * by_axial).sum(axis=1)
    coupling = fields.by_moment[:, 1] + axial * fields.by_moment[:, 2]
    result[:, 0, 1] = result[:, 1, 0] = coupling
    result[:, 1, 1] = fields.value[:, 2]
    return result
