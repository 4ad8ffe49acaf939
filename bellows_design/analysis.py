"""From a design to meshes of increasing fineness of a body that stands for it."""

from __future__ import annotations

import tempfile
from pathlib import Path

from bellows_design.design import Design
from bellows_design.solids import NamedSolid
from solver import Mesh, Solution
from solver.meshing import MeshOptions, SizeField, mesh_solid
from solver.refinement import Refinement, refined_sizes

COARSEST_EDGE = 1.33
"""Largest edge of the first mesh in walls' thicknesses: one quadratic element through a wall."""

LARGEST_EDGE = 2.0
"""The same for refined meshes, which may be coarser where nothing happens."""

ELEMENTS_PER_CIRCLE = 6.0
"""Edges on a full circle of a curved face in refined meshes, at least."""


def first_mesh(solid: NamedSolid, design: Design) -> Mesh:
    """Coarsest mesh that carries the load. Raises ``MeshingError``."""
    wall = thinnest_wall(design)
    return _mesh(solid, MeshOptions(COARSEST_EDGE * wall, 0.0, min(0.1, wall / 4)))


def finer_mesh(
    solid: NamedSolid, design: Design, solution: Solution, refinement: Refinement
) -> Mesh:
    """Mesh that is finer where ``solution`` is least accurate. Raises ``MeshingError``."""
    wall = thinnest_wall(design)
    field = SizeField(solution.problem.mesh, refined_sizes(solution, refinement))
    size = LARGEST_EDGE * wall
    return _mesh(solid, MeshOptions(size, ELEMENTS_PER_CIRCLE, min(0.1, wall / 8), field))


def thinnest_wall(design: Design) -> float:
    """Thinnest wall of bubbles and tendon, mm."""
    return min(design.bellows.bubble_thickness, design.bellows.tendon_thickness)


def _mesh(solid: NamedSolid, options: MeshOptions) -> Mesh:
    with tempfile.TemporaryDirectory(prefix="bellows-") as folder:
        brep = Path(folder) / "solid.brep"
        solid.solid.exportBrep(str(brep))
        return mesh_solid(brep, solid.face_names, options)
