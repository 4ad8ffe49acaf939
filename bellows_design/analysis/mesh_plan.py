"""What a mesh of a body will take, before it is made: the coarsest one, and refined ones."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import cadquery as cq
from OCP.BRepAdaptor import BRepAdaptor_Surface

from bellows_design.analysis.models import thinnest_wall
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.geometry.meshable import Meshable
from bellows_design.machine import GIB
from solver import Mesh, Solution
from solver.adaptivity.refinement import Refinement, refined_sizes
from solver.meshing.estimate import BodySize, FaceSize, expected_elements, expected_memory
from solver.meshing.solid import MeshOptions, SizeField

COARSEST_EDGE = 1.33
"""Largest edge of the first mesh in walls' thicknesses: one quadratic element through a wall."""

LARGEST_EDGE = 2.0
"""The same for refined meshes, which may be coarser where nothing happens."""

ELEMENTS_PER_CIRCLE = 6.0
"""Edges on a full circle of a curved face in refined meshes, at least."""


@dataclass(frozen=True)
class PlannedMesh:
    """A mesh of ``solid`` that is yet to be made."""

    solid: Meshable
    options: MeshOptions

    @cached_property
    def elements(self) -> float:
        """Expected number of tetrahedra."""
        return expected_elements(body_size(self.solid), self.options)

    @property
    def memory(self) -> float:
        """Expected memory of a program that solves on it, GiB."""
        return expected_memory(self.elements) / GIB

    @property
    def summary(self) -> str:
        """Both numbers in words."""
        return f"about {_rounded(self.elements)} tetrahedra and take about {self.memory:.1f} GiB"

    def fits(self, budget: Budget) -> bool:
        """True if the budget's memory is enough."""
        return self.memory <= budget.memory

    def made(self, budget: Budget = DEFAULT) -> Mesh:
        """The mesh.

        Raises ``DesignError`` if it would not fit into the budget, and ``MeshingError``.
        """
        if not self.fits(budget):
            raise DesignError(
                f"the mesh would have {self.summary}, above the limit of {budget.memory:.3g} GiB; "
                "allow more with --memory if there is more, or make the thinnest wall thicker, "
                "the actuator smaller or the model a unit-cell; of an own body mesh.size larger."
            )
        return self.solid.meshed(self.options, budget.mesh_seconds)


def first_plan(solid: Meshable, design: Design) -> PlannedMesh:
    """Coarsest mesh of a design's body that carries the load."""
    return coarsest_plan(solid, thinnest_wall(design))


def coarsest_plan(solid: Meshable, wall: float) -> PlannedMesh:
    """Coarsest mesh of a body whose walls are ``wall`` mm thick."""
    return PlannedMesh(solid, MeshOptions(COARSEST_EDGE * wall, 0.0, min(0.1, wall / 4)))


def finer_plan(
    solid: Meshable, wall: float, solution: Solution, refinement: Refinement
) -> PlannedMesh:
    """Mesh that is finer where ``solution`` is least accurate; ``wall`` in mm."""
    field = SizeField(solution.problem.mesh, refined_sizes(solution, refinement))
    size = LARGEST_EDGE * wall
    options = MeshOptions(size, ELEMENTS_PER_CIRCLE, min(0.1, wall / 8), field)
    return PlannedMesh(solid, options)


@lru_cache(maxsize=4)
def body_size(body: Meshable) -> BodySize:
    """What the number of elements depends on; kept for the next mesh of the same body."""
    faces = tuple(
        FaceSize(face.Area(), tuple(edge.Length() for edge in face.Edges()), _radius(face))
        for solid in body.solids
        for face in solid.Faces()
    )
    volume = sum(solid.Volume() for solid in body.solids)
    whole = cq.Compound.makeCompound(body.solids) if len(body.solids) > 1 else body.solids[0]
    return BodySize(volume, whole.BoundingBox().DiagonalLength, faces)


def _radius(face: cq.Face) -> float:
    """Least radius of curvature of a face, mm, as far as it is one of a fillet's."""
    surface, kind = BRepAdaptor_Surface(face.wrapped), face.geomType()
    if kind == "CYLINDER":
        return float(surface.Cylinder().Radius())
    if kind == "SPHERE":
        return float(surface.Sphere().Radius())
    return float(surface.Torus().MinorRadius()) if kind == "TORUS" else math.inf


def _rounded(number: float) -> str:
    """Two digits of a number, its thousands apart: 1234567 as 1 200 000."""
    return f"{float(f'{number:.2g}'):,.0f}".replace(",", " ")
