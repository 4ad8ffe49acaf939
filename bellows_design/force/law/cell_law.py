"""The law of half a bubble in the middle of the actuator, tabulated from the unit cell."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.force.law.building import Builder, aim_of
from bellows_design.force.law.continuation import Continuation
from bellows_design.force.law.table import Table
from bellows_design.force.law.tabulated import TabulatedLaw
from bellows_design.force.section_law import SectionResponse
from bellows_design.progress import SILENCE, Progress
from solver.arrays import Reals

if TYPE_CHECKING:
    from solver import Mesh

TOLERANCE = 0.005
"""Of the interpolated rotation, relative to the free rotation at the design's pressure."""

FIRST_ROWS = (0.0, 0.25, 0.5, 1.0)
"""Pressures of the first rows, relative to the design's."""


@dataclass(frozen=True)
class CellLaw:
    """Half a bubble of a design, between its middle and that of the gap beside it.

    Attributes:
        design: whose bubbles they are.
        tabulated: the law by interpolation.
        free_rotation: at the design's pressure, rad.
        factorizations: of the solver's tangent, in all.
        seconds: that it took, s.
    """

    design: Design
    tabulated: TabulatedLaw
    free_rotation: float
    factorizations: int
    seconds: float

    @property
    def length(self) -> float:
        """Half of the bubbles' pitch, mm."""
        return self.tabulated.length

    @property
    def table(self) -> Table:
        """The equilibria."""
        return self.tabulated.table

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """The answer to ``pressure`` (MPa) and to section loads (k, 3): moment, axial, shear.

        Beyond the moments of the table the compliance stays constant; ``within`` tells. Raises
        ``BellowsError`` for a pressure beyond those of the table.
        """
        return self.tabulated.response(pressure, loads)

    def within(self, pressure: float, loads: Reals) -> bool:
        """Whether the moments of section loads (k, 3) at a pressure (MPa) are in the table."""
        return self.tabulated.within(pressure, loads)


def cell_law(
    design: Design,
    tolerance: float = TOLERANCE,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> CellLaw:
    """The law of a design's half bubbles, from no pressure to the design's.

    Args:
        design: whose unit cell is solved, on its coarsest mesh.
        tolerance: of the interpolated rotation, relative to the free rotation at the design's
            pressure.
        progress: listens to stages.
        budget: memory of the mesh, and seconds after which nothing more is refined.

    Raises:
        BellowsError: a geometry the CAD kernel refuses, a mesh beyond the budget, or a pressure
            that the cell does not reach.
        MeshingError: no usable mesh, or none in time.
    """
    began = time.monotonic()
    progress.stage("mesh of the unit cell")
    cell = Continuation.of(design, _coarsest_mesh(design, budget))
    pressure = design.load.pressure
    free, reached = cell.from_zero(tuple(share * pressure for share in FIRST_ROWS[1:]))
    if len(free) + 1 < len(FIRST_ROWS):
        raise BellowsError(f"the section's law: without a moment the cell {reached}")
    at_rest, _ = cell.from_zero((0.0,))
    rotation = free[-1].point.rotation
    deadline = began + budget.seconds
    builder = Builder(cell, aim_of(rotation, tolerance), note=progress.stage, deadline=deadline)
    builder.start([*at_rest, *free])
    builder.refine()
    law = TabulatedLaw(design.bellows.pitch / 2, builder.table)
    return CellLaw(design, law, rotation, cell.factorizations, time.monotonic() - began)


def _coarsest_mesh(design: Design, budget: Budget) -> Mesh:
    from bellows_design.analysis.mesh_plan import first_plan
    from bellows_design.analysis.models import UNIT_CELL

    return first_plan(UNIT_CELL.solid(design), design).made(budget)
