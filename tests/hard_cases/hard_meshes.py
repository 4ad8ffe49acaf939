"""Meshes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from hard_bodies import (
    CLAMPED,
    NEO_HOOKE,
    NINJAFLEX,
    THREE_PLANES,
    TIGHT,
    Points,
    cantilever,
    distance,
    moved,
    single_tetrahedron,
    solved,
    with_surfaces,
)
from hard_case import Finding, HardCase, at_most, below, refused, true, within
from meshes import box_mesh

from solver import Mesh, PointForce, Problem, Supports, Traction, solve
from solver.mesh.elements import TETRAHEDRON_EDGES

BOX = box_mesh((2, 1, 1))


def slivers() -> tuple[Finding, ...]:
    """A bar with an inner vertex ever nearer to a face: its tetrahedra there go flat."""
    regular = _with_sliver(0.5)
    expected = solved(_lifted(regular))
    tip = regular.surface_nodes("x1")
    at = expected.displacement[tip].mean(axis=0)
    moves, pivots, angles = [], [], []
    for height in (1e-1, 1e-2, 1e-3, 1e-4):
        mesh = _with_sliver(height)
        found = solved(_lifted(mesh))
        moves.append(distance(found.displacement[tip].mean(axis=0), at))
        pivots.append(bool(found.stable))
        angles.append(_smallest_dihedral(mesh))
    return (
        within("smallest dihedral angle of the flattest", angles[-1], 0.002, 0.005, "°"),
        at_most("mean displacement of the tip moves by", max(moves), 0.05),
        true("every state known to be stable", all(pivots)),
    )


def _lifted(mesh: Mesh) -> Problem:
    """A bar clamped at x0 under a dead force on its lower face."""
    return Problem(mesh, NINJAFLEX, CLAMPED, loads=(Traction("z0", (0.0, 0.0, 0.05)),))


def _with_sliver(height: float) -> Mesh:
    """A bar of 2 x 2 x 2 cells whose inner vertex lies at a share ``height`` of the body's."""
    mesh = box_mesh((2, 2, 2), (3.0, 1.0, 1.0))
    nodes = mesh.nodes.copy()
    inner = np.setdiff1d(mesh.vertices, mesh.surface_nodes(*mesh.surfaces))
    nodes[inner, 2] = height
    for middle, edge in enumerate(TETRAHEDRON_EDGES, start=4):
        nodes[mesh.tets[:, middle]] = nodes[mesh.tets[:, edge]].mean(axis=1)
    return Mesh(nodes, mesh.tets, mesh.surfaces)


def _smallest_dihedral(mesh: Mesh) -> float:
    """Over all tetrahedra, degrees."""
    corners = mesh.nodes[mesh.tets[:, :4]]
    faces = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])
    a, b, c = (corners[:, faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    cosines = -np.einsum("efi,egi->efg", normals, normals)[:, *np.triu_indices(4, 1)]
    return float(np.degrees(np.arccos(np.clip(cosines, -1, 1))).min())


def one_element() -> tuple[Finding, ...]:
    """A single tetrahedron, clamped, under pressure; and held so that it can only be squeezed."""
    one = single_tetrahedron()
    clamped = solve(Problem(one, NINJAFLEX, CLAMPED, ("far",)), 0.1)
    corner = solve(Problem(one, NINJAFLEX, THREE_PLANES, ("far",)), 0.1, TIGHT)
    inside = float(np.abs(corner.hydrostatic_pressure - 0.1).max())
    moved_by = float(np.abs(clamped.displacement).max())
    return (
        within("clamped on a face, moves by", moved_by, 0.03, 0.031, "mm"),
        below("between three planes, pressure inside off by", inside, 1e-9, "MPa"),
    )


def metres() -> tuple[Finding, ...]:
    """The same bar in other units of length."""
    expected = solved(cantilever(BOX), 0.1).displacement
    strays = {}
    for scale in (1e-3, 0.1, 1e3, 1e6):
        mesh = moved(BOX, scale * np.eye(3))
        solution = solve(cantilever(mesh), 0.1, TIGHT)
        off = distance(solution.displacement / scale, expected)
        strays[scale] = off if solution.converged else np.inf
    return (below("strains differ by", max(strays.values()), 1e-9),)


def micrometres() -> tuple[Finding, ...]:
    """Ten microns of rubber: reached means right."""
    expected = solved(cantilever(BOX, NEO_HOOKE), 0.02).displacement
    mesh = moved(BOX, 1e-4 * np.eye(3))
    solution = solve(cantilever(mesh, NEO_HOOKE), 0.02)
    off = distance(solution.displacement * 1e4, expected)
    wrong = solution.converged and off > 1e-3
    return (true("no state passed off as reached is wrong", not wrong, f"off by {off:.3g}"),)


def orphans() -> tuple[Finding, ...]:
    """Nodes of no element, first and last in the numbering."""
    nodes = np.concatenate([[[9.0, 9, 9]], BOX.nodes, [[-4.0, 3, 2]]])
    surfaces = {name: faces + 1 for name, faces in BOX.surfaces.items()}
    expected = solved(cantilever(BOX), 0.1)
    found = solved(cantilever(Mesh(nodes, BOX.tets + 1, surfaces)), 0.1)
    off = distance(found.displacement[1:-1], expected.displacement)
    still = not found.displacement[[0, -1]].any()
    return (
        below("the body moves otherwise by", off, 1e-8),
        true("they stay where they are", still),
    )


def force_on_an_orphan() -> tuple[Finding, ...]:
    """A point force on a node of no element."""
    mesh = Mesh(np.concatenate([BOX.nodes, [[9.0, 9, 9]]]), BOX.tets, BOX.surfaces)
    load = PointForce((9.0, 9.0, 9.0), (1.0, 0.0, 0.0))
    problem = Problem(mesh, NINJAFLEX, CLAMPED, loads=(load,))
    return (refused("point force", {"orphan": (lambda: solve(problem), ".")}),)


def broken() -> tuple[Finding, ...]:
    """Elements without volume, and numbers that name nothing."""
    mirrored, repeated, beyond = (BOX.tets.copy() for _ in range(3))
    mirrored[0] = mirrored[0, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]]
    repeated[0, 1] = repeated[0, 0]
    beyond[0, 1] = len(BOX.nodes)
    inner = np.setdiff1d(np.arange(len(BOX.nodes)), BOX.surface_nodes(*BOX.surfaces))
    bulging = BOX.nodes.copy()
    bulging[inner[0]] += 2.0
    calls = {
        "mirrored": (_solve(BOX.nodes, mirrored), ""),
        "a node twice": (_solve(BOX.nodes, repeated), "mesh: "),
        "flat": (_solve(_flat(), BOX.tets), "turned inside out"),
        "a mid-node far out": (_solve(bulging, BOX.tets), "turned inside out"),
        "a number too many": (_solve(BOX.nodes, beyond), "numbered 0 to"),
        "negative": (_solve(BOX.nodes, -beyond), "names node -"),
        "linear elements": (_solve(BOX.nodes, BOX.tets[:, :4]), "shape (n, 10)"),
    }
    return (refused("meshes", calls),)


def _flat() -> Points:
    """The first tetrahedron without any volume."""
    nodes = BOX.nodes.copy()
    nodes[BOX.tets[0, 3]] = nodes[BOX.tets[0, :3]].mean(axis=0)
    for middle, edge in enumerate(TETRAHEDRON_EDGES, start=4):
        nodes[BOX.tets[:, middle]] = nodes[BOX.tets[:, edge]].mean(axis=1)
    return nodes


def _solve(nodes: Points, tets: Points) -> Callable[[], object]:
    return lambda: solve(cantilever(Mesh(nodes, tets, BOX.surfaces)), 0.1)


def no_elements() -> tuple[Finding, ...]:
    """Empty tables."""
    nothing = np.zeros((0, 10), np.int32)
    calls = {
        "no element": (lambda: Problem(Mesh(BOX.nodes, nothing), NINJAFLEX, Supports()), "mesh: "),
        "no node": (
            lambda: Problem(Mesh(np.zeros((0, 3)), nothing), NINJAFLEX, Supports()), "mesh: "
        ),
    }  # fmt: skip
    return (refused("empty meshes", calls),)


EMPTY = with_surfaces(BOX, nothing=np.zeros((0, 6), np.int32))


def empty_support() -> tuple[Finding, ...]:
    """Supports on a surface without triangles hold nothing."""
    calls = {
        "clamped": (
            lambda: Problem(EMPTY, NINJAFLEX, Supports(clamped=("nothing",))), "free to move in 6"
        )
    }  # fmt: skip
    return (refused("supports", calls),)


def empty_load() -> tuple[Finding, ...]:
    """Loads on a surface without triangles."""
    pulled = (Traction("nothing", (1.0, 0.0, 0.0)),)
    calls = {
        "pressure": (lambda: solve(Problem(EMPTY, NINJAFLEX, CLAMPED, ("nothing",)), 0.1), "no "),
        "traction": (lambda: solve(Problem(EMPTY, NINJAFLEX, CLAMPED, loads=pulled)), "no "),
    }
    return (refused("loads", calls),)


def wrong_surfaces() -> tuple[Finding, ...]:
    """Triangles that look inwards, or lie within the body."""
    faces = BOX.surfaces["z0"]
    inward = with_surfaces(BOX, z0=faces[:, [0, 2, 1, 5, 4, 3]])
    crossing = with_surfaces(BOX, z0=faces[:, [0, 1, 2, 3, 4, 5]] + 1)
    calls = {
        "inward": (lambda: solve(cantilever(inward), 0.02), "'z0'"),
        "no faces": (lambda: solve(cantilever(crossing), 0.02), "'z0'"),
    }
    return (refused("pressurised surfaces", calls),)


def odd_surfaces() -> tuple[Finding, ...]:
    """Faces whose mid-nodes are swapped, or that are named twice."""
    swapped = with_surfaces(BOX, z0=BOX.surfaces["z0"][:, [0, 1, 2, 4, 5, 3]])
    twice = with_surfaces(BOX, again=BOX.surfaces["z0"])
    calls = {
        "swapped": (lambda: solve(cantilever(swapped), 0.02), "'z0'"),
        "named twice": (
            lambda: solve(Problem(BOX, NINJAFLEX, CLAMPED, ("z0", "z0")), 0.02), "'z0'"
        ),
        "in two surfaces": (
            lambda: solve(Problem(twice, NINJAFLEX, CLAMPED, ("z0", "again")), 0.02), "twice"
        ),
    }  # fmt: skip
    return (refused("pressurised surfaces", calls),)


def overlapping() -> tuple[Finding, ...]:
    """The same tetrahedron twice."""
    mesh = Mesh(BOX.nodes, np.concatenate([BOX.tets, BOX.tets[:1]]), BOX.surfaces)
    return (
        refused(
            "doubled element",
            {"twice": (lambda: solve(Problem(mesh, NINJAFLEX, CLAMPED)), "mesh: ")},
        ),
    )


CASES = (
    HardCase(
        "Slivers",
        "flat tetrahedra spoil the matrix or lock",
        "the mixed element bears them; Gmsh's meshes are checked for worse ones before solving",
        slivers,
        inertia=True,
    ),
    HardCase(
        "A single element",
        "more pressures than freedoms, chunks and patterns of size one",
        "solved like any other mesh",
        one_element,
    ),
    HardCase(
        "Nodes of no element",
        "zero rows in the matrix",
        "they get no unknowns",
        orphans,
    ),
    HardCase(
        "Broken meshes",
        "a result on elements without volume, or a crash in compiled code",
        "refused with the number of the element or node, or the place",
        broken,
    ),
    HardCase(
        "Supports on an empty surface",
        "a body that floats",
        "counted as holding nothing",
        empty_support,
    ),
    HardCase(
        "A mesh in metres, or of a bridge",
        "pivots that are small only for their units count as zero",
        "unknowns are scaled by their own stiffness before the factorization",
        metres,
    ),
    HardCase(
        "A mesh in tenths of a micrometre",
        "a matrix so badly scaled that corrections vanish without equilibrium",
        "the same scaling: what is solved for is solved",
        micrometres,
    ),
    HardCase(
        "A force on a node of no element",
        "the load is lost without a word",
        "refused",
        force_on_an_orphan,
    ),
    HardCase(
        "A mesh without elements",
        "a message from the depths",
        "refused as such",
        no_elements,
    ),
    HardCase(
        "Loads on an empty surface",
        "a load that does nothing",
        "refused with the name of the surface",
        empty_load,
    ),
    HardCase(
        "Triangles that face inwards, or are no faces",
        "the pressure acts the wrong way, or twice",
        "pressurised triangles are checked against the elements' faces",
        wrong_surfaces,
    ),
    HardCase(
        "Triangles with swapped mid-nodes, or loaded twice",
        "the pressure acts askew, or doubly",
        "refused with the name of the surface",
        odd_surfaces,
    ),
    HardCase(
        "An element given twice",
        "the body is stiffer than it is",
        "refused: a face belongs to two elements at most",
        overlapping,
    ),
)
