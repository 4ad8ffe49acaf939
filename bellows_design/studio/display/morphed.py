"""The actuator's surface at once: the unit cell's, moved by the numbers, without CAD."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.design.design import Design
from bellows_design.design.topology import same_topology
from bellows_design.neighbours.bubbles import of_count
from bellows_design.studio.display.chained import Shape, chained, compacted, sides_of, triangles_of

if TYPE_CHECKING:
    from bellows_design.morphing.morpher import Morpher
    from solver import Mesh
    from solver.arrays import Integers

MOST = 6
"""Cells that are kept, each for designs with its faces."""

MODEL = "unit-cell"


@dataclass(frozen=True)
class MovedCell:
    """The mesh of one design's unit cell, its surface moved to designs with the same faces.

    All of its nodes lie on the surface: ``morpher`` holds no mid-node back for its element's sake.
    """

    design: Design
    morpher: Morpher
    sides: Integers

    @staticmethod
    def of(design: Design, mesh: Mesh) -> MovedCell:
        """From any mesh of the cell. Raises ``ForeignMesh``."""
        from bellows_design.morphing.morpher import Morpher

        return MovedCell(design, _on_surfaces(Morpher.of(design, MODEL, mesh)), sides_of(mesh))

    def fits(self, design: Design) -> bool:
        """Whether a design's cell has the same faces, however many bubbles there are."""
        return not same_topology(self.design, self._counted(design), MODEL)

    def shape_of(self, design: Design) -> Shape:
        """The whole actuator's surface. Raises ``NoNeighbour``."""
        points = np.array(self.morpher.mesh.nodes)
        points[self.morpher.skin.nodes] = self.morpher.boundary_of(self._counted(design))
        triangles = triangles_of(self.sides, design.bellows.bubble_count)
        return chained(compacted(Shape(points, triangles)), design)

    def _counted(self, design: Design) -> Design:
        return of_count(design, self.design.bellows.bubble_count)


def _on_surfaces(morpher: Morpher) -> Morpher:
    """The same, with the mid-nodes on their surfaces that stand back where elements would fold.

    On a coarse mesh they cut a sharp fillet off by as much as 0.3 of its radius; what is only drawn
    has no elements.
    """
    skin, stepped = (
        replace(each, share=np.ones_like(each.share)) for each in (morpher.skin, morpher.stepped)
    )
    return replace(morpher, skin=skin, stepped=stepped)


class Cells:
    """Moved cells, the last ones first."""

    def __init__(self) -> None:
        self._cells: list[MovedCell] = []

    def add(self, cell: MovedCell) -> None:
        """Keep one more; one for designs with the same faces goes."""
        others = [each for each in self._cells if not each.fits(cell.design)]
        self._cells = [cell, *others][:MOST]

    def shape_of(self, design: Design) -> Shape | None:
        """The surface of a design; None where no cell has its faces."""
        from bellows_design.morphing.errors import NoNeighbour

        for cell in self._cells:
            if cell.fits(design):
                try:
                    return cell.shape_of(design)
                except NoNeighbour:
                    continue
        return None
