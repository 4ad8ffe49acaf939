"""Whether walls of an own body touch each other, which no contact keeps apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.wall_contact import WallContact
from bellows_design.own_body.body import OwnBody
from bellows_design.own_body.conditions import AXES
from bellows_design.own_body.selection import BETWEEN
from solver.mesh.proximity import facing_gaps

if TYPE_CHECKING:
    from solver import Mesh, Problem, Solution
    from solver.arrays import Reals
    from solver.assembly.state import State
    from solver.nonlinear.events import Guard

WALLS, IMAGES = "walls of the body", "walls and their mirror images"

UNMODELLED = "walls of the body are not kept apart: the result does not hold past their touch"

PASSED = 1e-3
"""Of the body's size, by which a wall may pass a plane of symmetry: what a mesh leaves open."""


def touch_guard(body: OwnBody, problem: Problem) -> Guard | None:
    """Refuses states in which walls touch; None where they seem to do so undeformed."""
    mesh = problem.mesh
    still = np.zeros(mesh.nodes.shape)
    if touching(body, mesh, still):
        return None

    def refusal(state: State) -> str:
        found = touching(body, mesh, state.displacement)
        return f"{' and '.join(found)} touch, and nothing keeps them apart" if found else ""

    return refusal


def contact_of(body: OwnBody, solution: Solution) -> WallContact:
    """Which walls touch at an equilibrium, and the narrowest gap between them."""
    mesh = solution.problem.mesh
    found = touching(body, mesh, solution.displacement)
    return WallContact(
        detected=bool(found),
        min_gap_mm=narrowest_gap(mesh, solution.displacement),
        overlaps_itself=False,
        where=found,
        note=UNMODELLED if found else "",
    )


def touching(body: OwnBody, mesh: Mesh, displacement: Reals) -> tuple[str, ...]:
    """Names of what touches after a displacement (n, 3), mm."""
    gap = narrowest_gap(mesh, displacement)
    walls = (WALLS,) if gap is not None and gap <= 0 else ()
    images = (IMAGES,) if _passes_a_plane(body, mesh, displacement) else ()
    return (*walls, *images)


def narrowest_gap(mesh: Mesh, displacement: Reals) -> float | None:
    """Narrowest air between facing walls, mm; None where none face each other."""
    outer = [name for name in mesh.surfaces if BETWEEN not in name and len(mesh.surfaces[name])]
    distances = facing_gaps(mesh, displacement, *outer).distances
    return float(distances.min()) if distances.size else None


def _passes_a_plane(body: OwnBody, mesh: Mesh, displacement: Reals) -> bool:
    """Whether a wall has passed a plane of symmetry, behind which its mirror image is."""
    for name, axis in body.supports.symmetry.items():
        place = mesh.nodes[mesh.surface_nodes(name), AXES[axis]].mean()
        offset = mesh.nodes[:, AXES[axis]] - place
        side = np.sign(offset[np.abs(offset).argmax()])
        after = side * (offset + displacement[:, AXES[axis]])
        if after.min() < -PASSED * mesh.size:
            return True
    return False
