"""The mesh of a design's body, with its supports and loads, before anything is solved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.analysis.models import choose
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.errors import DesignError

if TYPE_CHECKING:
    from bellows_design.analysis.mesh_plan import PlannedMesh
    from bellows_design.geometry.meshable import Meshable
    from solver import Problem

COARSEST, FINEST = 5.0, 0.1
"""Largest and smallest edge that may be asked for, in thicknesses of the thinnest wall."""


def design_problem(
    design: Design, model: str = "half", size: float | None = None, budget: Budget = DEFAULT
) -> Problem:
    """A design's body, meshed, supported and loaded as ``evaluate`` does it.

    Args:
        design: What is meshed.
        model: ``half``, ``full`` or ``unit-cell``.
        size: Largest edge of a tetrahedron, mm; without it 1.33 thinnest walls, the coarsest mesh
            that carries the load. Below that fillets get six edges on a circle at least.
        budget: Memory (GiB) that solving on the mesh may take, and seconds to make it.

    Returns:
        The problem. Its mesh has the surfaces ``cavity``, ``outside``, ``root``, ``tip`` and those
        of symmetry; the half and the whole have one more for each side of a bubble.

    Raises:
        DesignError: an unknown model, a size out of bounds, or a mesh that exceeds the budget.
        GeometryError: the CAD kernel cannot build the body.
        MeshingError: no usable mesh, or none in time.
    """
    body, _ = choose(design, model)
    plan = _plan(design, body.solid(design), size)
    return body.problem(design, plan.made(budget))


def _plan(design: Design, solid: Meshable, size: float | None) -> PlannedMesh:
    from bellows_design.analysis.mesh_plan import (
        COARSEST_EDGE,
        ELEMENTS_PER_CIRCLE,
        PlannedMesh,
        first_plan,
    )
    from bellows_design.analysis.models import thinnest_wall
    from solver.meshing import MeshOptions

    if size is None:
        return first_plan(solid, design)
    wall = thinnest_wall(design)
    if not FINEST * wall <= size <= COARSEST * wall:
        raise DesignError(
            f"size = {size:g} mm must lie between {FINEST * wall:g} and {COARSEST * wall:g} mm, "
            f"{FINEST:g} and {COARSEST:g} of the thinnest wall."
        )
    round_edges = ELEMENTS_PER_CIRCLE if size < COARSEST_EDGE * wall else 0.0
    return PlannedMesh(solid, MeshOptions(size, round_edges, min(0.1, wall / 8, size)))
