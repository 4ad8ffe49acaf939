"""A mesh of one design as a mesh of a neighbouring one: same tetrahedra, moved nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.morphing.errors import ForeignMesh, MorphFailed, NoNeighbour
    from bellows_design.morphing.morpher import Morpher

__all__ = ["ForeignMesh", "MorphFailed", "Morpher", "NoNeighbour"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "errors": ("ForeignMesh", "MorphFailed", "NoNeighbour"),
        "morpher": ("Morpher",),
    },
)
