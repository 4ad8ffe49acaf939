"""From a design to the equation that is solved: half body, mesh, supports, load."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from bellows_design.design import Design
from bellows_design.geometry import CAVITY, ROOT, SYMMETRY, half_body
from bellows_design.parameters import BellowsParameters
from bellows_design.solids import NamedSolid
from solver import Mesh, Ogden, Problem, SlenderAxis, Supports
from solver.meshing import MeshOptions, mesh_solid


@dataclass(frozen=True)
class Level:
    """Fineness of a mesh: largest edge in walls' thicknesses, edges on a full circle."""

    edge_per_wall: float
    elements_per_circle: float


LADDER = (Level(1.33, 0), Level(1.0, 4), Level(0.75, 6), Level(0.6, 8))
"""Meshes from coarse to fine. The load is walked on the first; each further one starts from the
solution before it, and the difference between the last two is the estimate of the error."""


def half_solid(design: Design) -> NamedSolid:
    """Half of the actuator, cut at its plane of symmetry. Raises ``GeometryError``."""
    return half_body(design.bellows, design.indent)


def mesh_of(solid: NamedSolid, design: Design, level: Level) -> Mesh:
    """Mesh of ``solid`` at a level of the ladder. Raises ``MeshingError``."""
    bellows = design.bellows
    wall = min(bellows.bubble_thickness, bellows.tendon_thickness)
    options = MeshOptions(
        size=level.edge_per_wall * wall,
        elements_per_circle=level.elements_per_circle,
        smallest_size=min(0.1, wall / 4),
    )
    with tempfile.TemporaryDirectory(prefix="bellows-") as folder:
        brep = Path(folder) / "solid.brep"
        solid.solid.exportBrep(str(brep))
        return mesh_solid(brep, solid.face_names, options)


def half_problem(design: Design, mesh: Mesh) -> Problem:
    """Root face clamped, symmetry about y = 0, pressure on the whole cavity."""
    material = design.material
    return Problem(
        mesh=mesh,
        material=Ogden(mu=material.mu, alpha=material.alpha),
        supports=Supports(clamped=(ROOT,), symmetry={SYMMETRY: 1}),
        pressurised=(CAVITY,),
        axis=SlenderAxis(_stations(design.bellows)),
    )


def _stations(bellows: BellowsParameters) -> tuple[float, ...]:
    """x of the root, of every bubble's and every gap's middle, and of the tip, mm."""
    middles = bellows.bubble_middles
    gaps = (middle + bellows.pitch / 2 for middle in middles[:-1])
    return tuple(sorted((0.0, *middles, *gaps, bellows.length)))
