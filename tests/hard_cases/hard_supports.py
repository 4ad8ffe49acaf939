"""Supports."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from hard_bodies import CLAMPED, NEO_HOOKE, NINJAFLEX, Points, solved
from hard_case import Finding, HardCase, below, exactly, refused, true
from meshes import box_mesh

from solver import Mesh, Ogden, Problem, Supports, Traction, nodal_cauchy, solve
from solver.assembly.assembly import unbalanced_forces
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


def three_nodes() -> tuple[Finding, ...]:
    """A block on three nodes, pulled by two opposite tractions: statically determinate."""
    mesh = box_mesh((2, 2, 2), (1.0, 1.5, 0.8), 0.2)
    held = {(0.0, 0.0, 0.0): (0, 1, 2), (1.0, 0.0, 0.0): (1, 2), (0.0, 1.5, 0.0): 2}
    dead = tuple(Traction(name, (x, 0.0, 0.0)) for name, x in (("x0", -0.5), ("x1", 0.5)))
    problem = Problem(mesh, NEO_HOOKE, Supports(nodes=held), loads=dead)
    solution = solved(problem)
    stretch = float(np.real(np.roots([1, -0.5, 0, -1])[0]))  # l - 1 / l^2 = 0.5 for mu = 1
    forces = unbalanced_forces(problem, solution.state, 0.0, 1.0)
    stress = nodal_cauchy(solution)
    expected = [0.5 * stretch, 0, 0, 0, 0, 0]
    calls = {
        "no node there": (
            lambda: Problem(mesh, NEO_HOOKE, Supports(nodes={(0.1, 0.2, 0.3): 0})), "no node lies"
        ),
        "too few": (
            lambda: Problem(mesh, NEO_HOOKE, Supports(nodes={(0.0, 0.0, 0.0): (0, 1, 2)})),
            "free to move in 3 ways",
        ),
    }  # fmt: skip
    return (
        below("largest reaction", float(np.abs(forces).max()), 1e-8, "N"),
        below("stress off by", float(np.abs(stress - expected).max()), 1e-7, "MPa"),
        refused("others", calls),
    )


def several_axes() -> tuple[Finding, ...]:
    """A face held in two components, as it slides in one; and in three, as it is clamped."""
    mesh = box_mesh((4, 2, 2), (2.0, 1.0, 1.0))
    rail = Supports(symmetry={"x0": (0, 2), "y0": 1})
    names = Supports(symmetry={"x0": (0, 1, 2)})
    slid = solved(Problem(mesh, NINJAFLEX, rail, ("z0",)), 0.05)
    at = slid.displacement[mesh.surface_nodes("x0")]
    clamped = solved(Problem(mesh, NINJAFLEX, CLAMPED, ("z0",)), 0.05)
    likewise = solved(Problem(mesh, NINJAFLEX, names, ("z0",)), 0.05)
    return (
        true("held along x and z only", not at[:, [0, 2]].any() and at[:, 1].any()),
        true("all three axes are a clamp", (clamped.displacement == likewise.displacement).all()),
    )


def contradiction() -> tuple[Finding, ...]:
    """Two faces that share an edge, led to different places, always or at half the load only."""

    def up(by: Callable[[float], float]) -> Callable[[Points, float], Points]:
        free = np.nan
        return lambda at, load: np.broadcast_to([free, free, by(load)], at.shape)

    def led(one: Callable[[float], float], other: Callable[[float], float]) -> Supports:
        return Supports(("x0",), prescribed={"x1": up(one), "z1": up(other)})

    def aside(at: Points, load: float) -> Points:
        return np.broadcast_to([0.0, 0.1 * load, np.nan], at.shape)

    same = led(lambda load: 0.1 * load, lambda load: 0.1 * load)
    apart = {
        "at every load": (led(lambda load: 0.1 * load, lambda load: 0.2 * load), "0.1 and 0.2 mm"),
        "amid the load": (
            led(lambda load: 0.1 * load, lambda load: 0.1 * load**2), "at 50 % of the load"
        ),
    }  # fmt: skip
    calls = {name: (_problem(MESH, supports), words) for name, (supports, words) in apart.items()}
    other = Supports(("x0",), prescribed={"x1": up(lambda load: 0.1 * load), "z1": aside})
    return (
        refused("motions that differ on shared nodes, with the place", calls),
        true("motions that agree, or lead other components, are taken",
             all(Problem(MESH, NINJAFLEX, each) for each in (same, other))),
    )  # fmt: skip


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
    HardCase(
        "A body on three nodes",
        "forces at single nodes spoil the stress around them",
        "single nodes are held by their position; determinate ones bear no force",
        three_nodes,
    ),
    HardCase(
        "Several components of one surface",
        "the same surface given twice, or a clamp where a rail was meant",
        "one axis, two or three for each surface",
        several_axes,
    ),
    HardCase(
        "Two motions that contradict each other",
        "the one given later wins on the shared edge, without a word",
        "refused with the place, the load and both values",
        contradiction,
    ),
)
