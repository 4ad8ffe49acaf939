"""From a solid's boundary to tetrahedra, by Gmsh in a process of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from solver.errors import MeshingError
    from solver.meshing.solid import MeshOptions, SizeField, mesh_solid

__all__ = ["MeshOptions", "MeshingError", "SizeField", "mesh_solid"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "solid": ("MeshOptions", "MeshingError", "SizeField", "mesh_solid"),
    },
)
