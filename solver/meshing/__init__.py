"""From a solid's boundary to tetrahedra, by Gmsh in a process of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from solver.errors import MeshingError
    from solver.meshing.parts import Part, mesh_solids
    from solver.meshing.solid import MeshOptions, SizeField, mesh_solid

__all__ = ["MeshOptions", "MeshingError", "Part", "SizeField", "mesh_solid", "mesh_solids"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "parts": ("Part", "mesh_solids"),
        "solid": ("MeshOptions", "MeshingError", "SizeField", "mesh_solid"),
    },
)
