"""The law of half a bubble in the middle of an actuator, and of its ends, from its unit cell."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from bellows_design.design.design import Design
from bellows_design.force.law.ends import EndPiece
from bellows_design.force.law.errors import LawError
from bellows_design.force.law.interpolation.readings import gaps, highest_stress
from bellows_design.force.law.interpolation.table import Table
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw
from bellows_design.force.section_law import SectionResponse
from solver.arrays import Reals
from solver.mesh.mesh import Mesh


@dataclass(frozen=True)
class Effort:
    """What a law took: factorizations of the solver's tangent, and s."""

    factorizations: int
    seconds: float


@dataclass(frozen=True, eq=False)
class CellLaw:
    """Half a bubble of a design, between its middle and that of the gap beside it.

    Attributes:
        design: whose bubbles they are.
        tabulated: the law by interpolation.
        root: the law of the first bubble's outer half with its stub's turning.
        tip: that of the last bubble's.
        free_rotation: of half a bubble at the design's pressure, rad.
        tolerance: of the interpolated rotation, relative to the free rotation.
        stress_factor: highest stress on the finest mesh of an evaluation over that on the table's,
            times that of the ends over the cell's, if they are stressed more.
        error: estimated.
        mesh: on which the table was computed.
        effort: what it took.
        from_cache: when it was computed (UTC), where it comes from the store; else empty.
    """

    design: Design
    tabulated: TabulatedLaw
    root: EndPiece
    tip: EndPiece
    free_rotation: float
    tolerance: float
    stress_factor: float
    error: LawError
    mesh: Mesh
    effort: Effort
    from_cache: str = ""

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

    @cached_property
    def without_contact(self) -> TabulatedLaw:
        """The same half bubble if no neighbour stopped it.

        Where neighbours would touch, the compliance stays what it was before. Against Prototype 1's
        cell without contact at 0.1 MPa the rotation is then too large by 0.2, 0.6 and 1.9 degrees
        at 1.5, 2.1 and 2.6 times the moment at which neighbours begin to touch. Where they touch
        without a moment already, the law with contact stands for it.
        """
        apart = self.table.apart
        return self.tabulated if apart is None else self.tabulated.on(apart)

    def moments(self, loads: Reals) -> Reals:
        """Moments (k,) of section loads (k, 3) by which the table goes, N mm."""
        return self.tabulated.moments(loads)

    def touching(self, pressure: float, loads: Reals) -> bool:
        """Whether neighbouring bubbles touch under section loads (k, 3) at a pressure (MPa)."""
        return bool((gaps(self.table, pressure, self.moments(loads)) <= 0).any())

    def stress(self, pressure: float, loads: Reals) -> tuple[float, float | None]:
        """Highest von Mises stress (MPa) of pieces under section loads (k, 3), and its error (%).

        Only moments about the neutral height count.
        """
        highest = float(highest_stress(self.table, pressure, self.moments(loads)).max())
        return self.stress_factor * highest, self.error.stress_percent
