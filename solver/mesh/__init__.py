"""Ten-node tetrahedra: the mesh, its elements, checks and distances."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from solver.mesh.blocks import block
    from solver.mesh.mesh import Mesh

__all__ = ["Mesh", "block"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "blocks": ("block",),
        "mesh": ("Mesh",),
    },
)
