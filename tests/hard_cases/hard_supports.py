"""Supports."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from hard_bodies import CLAMPED, NEO_HOOKE, NINJAFLEX, Points
from hard_case import Finding, HardCase, exactly, refused, true
from meshes import box_mesh

from solver import Mesh, Ogden, Problem, Supports, solve
from solver.mesh.elements import TRIANGLE_EDGES

MESH = box_mesh((2, 1, 1))


def rank_deficient() -> tuple[Finding, ...]:
    """Every way to hold too little, with the number of motions left."""
    planes = {"x0": 0, "y0": 1, "z0": 2}
    held = {
        "nothing": (Supports(), 6),
        "one plane": (Supports(symmetry={"x0": 0}), 3),
        "two planes": (Supports(symmetry={"x0": 0, "y0": 1}), 1),
        "the same plane twice": (Supports(symmetry={"x0": 0, "x1": 0}), 3),
        "a point": (_held_at(lambda x: (x == 0).all(axis=1)), 3),
        "an edge": (_held_at(lambda x: (x[:, :2] == 0).all(axis=1)), 1),
        "a roller under a bar": (Supports(symmetry={"z0": 2}), 3),
    }
    calls = {
        name: (_problem(MESH, supports), f"free to move in {count} way")
        for name, (supports, count) in held.items()
    }
    enough = Problem(MESH, NINJAFLEX, Supports(symmetry=planes), ("x1",))
    return (
        refused("too few supports, counted and named", calls),
        true("three planes are enough", solve(enough, 0.1).converged),
    )


def _held_at(chosen: Callable[[Points], Points]) -> Supports:
    def motion(positions: Points, load: float) -> Points:
        return np.where(chosen(positions)[:, None], 0.0, np.full(positions.shape, np.nan))

    return Supports(prescribed={"x0": motion})


def _problem(mesh: Mesh, supports: Supports) -> Callable[[], object]:
    return lambda: Problem(mesh, NINJAFLEX, supports, ("x1",))


def prescribed_all_around() -> tuple[Finding, ...]:
    """An incompressible body without freedom, and what makes it solvable."""
    skin = Supports(clamped=tuple(MESH.surfaces))
    soft = Problem(MESH, Ogden((1.0,), (2.0,), 50.0), skin)
    calls = {
        "clamped all around": (lambda: Problem(MESH, NEO_HOOKE, skin), "pressure undetermined")
    }
    return (
        refused("incompressible", calls),
        true("with a bulk modulus it is solved", solve(soft).converged),
    )


def disconnected() -> tuple[Finding, ...]:
    """Two bodies of which one is held; and one body with unmerged nodes at a seam."""
    count = len(MESH.nodes)
    tets = np.concatenate([MESH.tets, MESH.tets + count])
    nodes = np.concatenate([MESH.nodes, MESH.nodes + np.array([5.0, 0.0, 0.0])])
    apart = Mesh(nodes, tets, MESH.surfaces)
    right = MESH.nodes[MESH.tets[:, :4]].mean(axis=1)[:, 0] > 0.5
    seam = Mesh(
        np.concatenate([MESH.nodes, MESH.nodes]),
        MESH.tets + count * right[:, None].astype(np.int32),
        {"x0": MESH.surfaces["x0"], "x1": MESH.surfaces["x1"] + count},
    )
    calls = {
        "two bodies": (lambda: Problem(apart, NINJAFLEX, CLAMPED, ("x1",)), "free to move"),
        "a seam": (lambda: Problem(seam, NINJAFLEX, CLAMPED, ("x1",)), "free to move"),
    }
    return (refused("a part that nothing holds", calls),)


def held_by_orphans() -> tuple[Finding, ...]:
    """A support on triangles of which no element knows."""
    extra = np.array([[0.0, 0, 0], [0, 1, 0], [0, 0, 1]])
    middles = [extra[list(edge)].mean(axis=0) for edge in TRIANGLE_EDGES]
    triangle = len(MESH.nodes) + np.arange(6, dtype=np.int32)[None]
    mesh = Mesh(
        np.concatenate([MESH.nodes, extra, middles]), MESH.tets, {**MESH.surfaces, "x0": triangle}
    )
    calls = {"clamp": (lambda: Problem(mesh, NINJAFLEX, CLAMPED, ("x1",)), ".")}
    return (refused("held by nodes that belong to no element", calls),)


def too_many() -> tuple[Finding, ...]:
    """The same face clamped, in a plane of symmetry, and led nowhere: no contradiction."""
    still = Supports(
        clamped=("x0", "x0"),
        symmetry={"x0": 0, "y0": 1},
        prescribed={"x0": lambda at, load: 0 * at},
    )
    solution = solve(Problem(MESH, NINJAFLEX, still, ("z0",)), 0.02)
    moved = float(np.abs(solution.displacement[MESH.surface_nodes("x0")]).max())
    return (
        true("reached", solution.converged, solution.message),
        exactly("nodes of the face that moved", int(moved != 0), 0),
    )


CASES = (
    HardCase(
        "Rank-deficient supports",
        "a singular matrix, or worse a solution that drifted off",
        "the free rigid motions are counted and named before anything is solved",
        rank_deficient,
    ),
    HardCase(
        "An incompressible body prescribed all around",
        "its pressure is known but for a constant: a singular matrix",
        "refused with the remedy",
        prescribed_all_around,
    ),
    HardCase(
        "The same face held thrice",
        "a node's equations are removed more than once",
        "a held displacement simply has no number",
        too_many,
    ),
    HardCase(
        "A part that is not held; nodes not merged at a seam",
        "a second body floats freely, or a cut goes through the first one",
        "rigid motions are counted for each connected part",
        disconnected,
    ),
    HardCase(
        "A support on nodes of no element",
        "the body floats although it looks held",
        "only nodes of elements count as held",
        held_by_orphans,
    ),
)
