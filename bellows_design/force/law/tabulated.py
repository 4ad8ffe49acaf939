"""A section's law from a table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.force.law.table import Table
from bellows_design.force.section_law import SectionResponse
from solver.arrays import Reals


@dataclass(frozen=True)
class TabulatedLaw:
    """A ``SectionLaw`` by interpolation.

    Attributes:
        length: of the piece at rest, mm.
        table: its equilibria.
        shear_compliance: slip by shear force, mm per N.
    """

    length: float
    table: Table
    shear_compliance: float = 0.0

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3): moment, axial, shear.

        Beyond the moments of the table the compliance stays constant; ``within`` tells.

        Raises:
            BellowsError: a pressure beyond those of the table.
        """
        moment, axial, shear = loads.T
        fields = self.table.curves(pressure).fields(moment)
        by_axial = np.stack([np.ones_like(axial), axial, axial**2 / 2], axis=1)
        slip = self.shear_compliance * shear
        extension = fields.value[:, 1] + axial * fields.value[:, 2]
        coupling = fields.by_moment[:, 1] + axial * fields.by_moment[:, 2]
        compliance = np.zeros((len(loads), 3, 3))
        compliance[:, 0, 0] = (fields.by_moment_twice * by_axial).sum(axis=1)
        compliance[:, 0, 1] = compliance[:, 1, 0] = coupling
        compliance[:, 1, 1] = fields.value[:, 2]
        compliance[:, 2, 2] = self.shear_compliance
        stretch_by_pressure = fields.by_pressure[:, 1] + axial * fields.by_pressure[:, 2]
        rotation_by_pressure = (fields.by_both * by_axial).sum(axis=1)
        return SectionResponse(
            energy=(fields.value * by_axial).sum(axis=1) + slip * shear / 2,
            motion=np.stack([(fields.by_moment * by_axial).sum(axis=1), extension, slip], axis=1),
            compliance=compliance,
            volume=(fields.by_pressure * by_axial).sum(axis=1),
            motion_by_pressure=np.stack(
                [rotation_by_pressure, stretch_by_pressure, np.zeros_like(shear)], axis=1
            ),
        )

    def within(self, pressure: float, loads: Reals) -> bool:
        """Whether the moments of section loads (k, 3) at a pressure (MPa) are in the table."""
        low, high = self.table.reach(pressure)
        return bool((loads[:, 0] >= low).all() and (loads[:, 0] <= high).all())
