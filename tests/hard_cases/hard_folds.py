"""Folded elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hard_bodies import NEO_HOOKE, Points, cantilever
from hard_case import Finding, HardCase, at_most, below, exactly, refused, true, within
from meshes import box_mesh, cylinder_mesh

from solver import (
    Contact,
    Mesh,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    folded_elements,
    reaction,
    solve,
)
from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_gradients, tetrahedron_rule
from solver.mesh.jacobians import least_jacobians
from solver.mesh.mid_nodes import relaxed


def folded_meshes() -> tuple[Finding, ...]:
    """A mid-node ever nearer to the end of its edge, in a mesh that the quadrature points like."""
    calls, gauss, accepted = {}, [], []
    for share in (0.26, 0.25, 0.24, 0.2, 0.15):
        mesh = _with_mid_node_at(share)
        gauss.append(_jacobians(mesh, tetrahedron_rule().linear).min())
        if share < 0.25:
            calls[f"{share}"] = (lambda mesh=mesh: solve(cantilever(mesh), 0.01), "is folded at (")
        else:
            accepted.append(solve(cantilever(mesh), 0.01).converged)
    return (
        true("positive at every quadrature point", min(gauss) > 0, gauss),
        true("taken up to a quarter of the edge, where the Jacobian vanishes", all(accepted)),
        refused("nearer to the corner, with number and place", calls),
    )


def _with_mid_node_at(share: float) -> Mesh:
    """A block of which one mid-node inside lies at a share of its edge."""
    mesh = box_mesh((2, 2, 2))
    nodes, skin = mesh.nodes.copy(), mesh.surface_nodes(*mesh.surfaces)
    for place, edge in enumerate(TETRAHEDRON_EDGES, start=4):
        if mesh.tets[7, place] not in skin:
            near, far = nodes[mesh.tets[7, list(edge)]]
            nodes[mesh.tets[7, place]] = near + share * (far - near)
            return Mesh(nodes, mesh.tets, mesh.surfaces)
    raise AssertionError("no edge inside")


def _jacobians(mesh: Mesh, points: Points) -> Points:
    gradients = quadratic_gradients(points, TETRAHEDRON_EDGES)
    return np.linalg.det(np.einsum("qad,eai->eqdi", gradients, mesh.nodes[mesh.tets]))


def between_samples() -> tuple[Finding, ...]:
    """Random curved elements: bounds against 4 Gauss points, corners and 4000 points."""
    random = np.random.default_rng(5)
    corners = np.vstack([np.zeros(3), np.eye(3)])
    unit = np.vstack([corners, [corners[list(edge)].mean(axis=0) for edge in TETRAHEDRON_EDGES]])
    elements = unit + random.normal(scale=0.09, size=(500, 10, 3))
    mesh = Mesh(elements.reshape(-1, 3), np.arange(5000, dtype=np.int32).reshape(500, 10))
    bounds = least_jacobians(mesh.nodes, mesh.tets)
    seen = {
        "Gauss": _jacobians(mesh, tetrahedron_rule().linear).min(axis=1) < 0,
        "corners": _jacobians(mesh, np.eye(4)).min(axis=1) < 0,
    }
    points = np.concatenate([np.eye(4), random.dirichlet(np.full(4, 0.5), size=4000)])
    dense = _jacobians(mesh, points).min(axis=1)
    found = bounds.high < 0
    return (
        exactly("elements that the bounds leave open", int((found != (bounds.low < 0)).sum()), 0),
        true("no sample lies below the bound", (dense >= bounds.low - 1e-12).all()),
        true("folds that 4000 samples see are all found", (found | (dense >= 0)).all()),
        within("share of folds that Gauss points miss", _missed(found, seen["Gauss"]), 0.9, 0.93),
        within("that corners miss", _missed(found, seen["corners"]), 0.01, 0.03),
    )


def _missed(found: Points, seen: Points) -> float:
    return float((found & ~seen).sum() / found.sum())


@dataclass(frozen=True)
class Pressed:
    """A bonded block pressed between plates: the quarter of its cross-section, in plane strain."""

    solution: Solution
    force: float
    beyond: float
    """How far its side reaches beyond the plate, half heights."""

    @property
    def folds(self) -> int:
        """Number of folded elements."""
        return len(folded_elements(self.solution).elements)


WIDTH = 2.8
"""Half width over half height."""


def pressed(cells: tuple[int, int], grading: float, strain: float, contact: float = 0.0) -> Pressed:
    """Pressed by ``strain``; edges at the bond's rim shorter for a ``grading`` above 1.

    ``contact``: penetration that keeps the side off the plate, 0 for none. The plate rests; the
    middle plane of the block is led.
    """

    def led(at: Points, load: float) -> Points:
        return np.broadcast_to([np.nan, np.nan, strain * load], at.shape)

    mesh = _graded(cells, grading)
    supports = Supports(("z1",), {"x0": 0, "y0": 1, "y1": 1}, {"z0": led})
    contacts = (Contact("x1", contact, 2, 1.0),) if contact else ()
    problem = Problem(mesh, NEO_HOOKE, supports, contacts=contacts)
    solution = solve(problem, options=SolverOptions(maximum_steps=60))
    side = (mesh.nodes + solution.displacement)[mesh.surface_nodes("x1")]
    force = reaction(solution, "z0").force[2] / THICKNESS
    return Pressed(solution, float(force), float(side[:, 2].max() - 1))


THICKNESS = 0.05


def _graded(cells: tuple[int, int], grading: float) -> Mesh:
    box = box_mesh((cells[0], 1, cells[1]))
    nodes = box.nodes.copy()
    nodes[:, [0, 2]] = 1 - (1 - nodes[:, [0, 2]]) ** grading
    nodes *= [WIDTH, THICKNESS, 1.0]
    for middle, edge in enumerate(TETRAHEDRON_EDGES, start=4):
        nodes[box.tets[:, middle]] = nodes[box.tets[:, edge]].mean(axis=1)
    return Mesh(nodes, box.tets, box.surfaces)


CLOSE = 3e-4
"""Penetration that is small against the shortest edge, half heights."""


def bonded_block() -> tuple[Finding, ...]:
    """A block bonded to two plates, pressed by 17 %, its side free or kept off the plates."""
    cells = (28, 10)
    free, kept = pressed(cells, 1.0, 0.17), pressed(cells, 1.0, 0.17, CLOSE)
    folds = folded_elements(free.solution)
    away = np.linalg.norm((folds.positions - [WIDTH, 0, 1])[:, [0, 2]], axis=1)
    (warning,) = free.solution.warnings
    return (
        within("the free side passes through the plate by", free.beyond, 0.07, 0.08, "h"),
        true("a warning tells how many elements fold there", f"{free.folds} elem" in warning),
        below("farthest of them from the rim of the bond", float(away.max()), 0.1, "h"),
        exactly("folded elements where the side may not cross the plate", kept.folds, 0),
        within("share of the force on what touches", 1 - free.force / kept.force, 0.03, 0.07),
    )


def finer_at_the_rim() -> tuple[Finding, ...]:
    """The same with edges of a seventieth of the half height at the rim."""
    free, kept = (pressed((14, 6), 2.0, 0.17, contact) for contact in (0.0, CLOSE))
    fine = pressed((42, 15), 1.0, 0.17, CLOSE)
    return (
        true("free: ends before the whole strain", not free.solution.converged),
        true("kept off the plates: reached on both", kept.solution.converged),
        below("iterations", kept.solution.newton_iterations, 50),
        exactly("folded elements", kept.folds + fine.folds, 0),
        at_most("forces of two meshes differ by", kept.force / fine.force - 1, 0.01),
    )


def bonded_disc() -> tuple[Finding, ...]:
    """A disc, its radius 2.8 times half its height, pressed by 17 % on meshes finer at its rim."""
    found = [_disc(*cells) for cells in ((10, 5), (12, 6))]
    forces = [4 * float(reaction(each, "z0").force[2]) for each in found]
    first_row = [folded_elements(each).positions for each in found]
    near = [np.linalg.norm(at[:, :2], axis=1).min() for at in first_row]
    return (
        true("reached", all(each.converged for each in found)),
        below("iterations", max(each.newton_iterations for each in found), 30),
        within("force over μ h²", forces[-1], 31.0, 31.4),
        at_most("meshes differ by", forces[0] / forces[1] - 1, 0.005),
        true("folds left in the first row at the rim are told", min(near) > 2.7, near),
    )


def _disc(rings: int, layers: int) -> Solution:
    """A quarter of the disc's upper half, its side kept off the plate."""

    def led(at: Points, load: float) -> Points:
        return np.broadcast_to([np.nan, np.nan, 0.17 * load], at.shape)

    mesh = cylinder_mesh(WIDTH, 1.0, rings, layers, np.pi / 2, 1)
    nodes, out = mesh.nodes.copy(), np.linalg.norm(mesh.nodes[:, :2], axis=1) / WIDTH
    graded = 1 - (1 - np.minimum(out, 1)) ** 1.5
    nodes[:, :2] *= np.where(out > 0, graded / np.where(out > 0, out, 1), 1.5)[:, None]
    nodes[:, 2] = 1 - (1 - nodes[:, 2]) ** 1.5
    mesh = Mesh(relaxed(nodes, mesh.tets), mesh.tets, mesh.surfaces)
    supports = Supports(("z1",), {"start": 1, "end": 0}, {"z0": led})
    off = (Contact("side", 1e-3, 2, 1.0),)
    return solve(Problem(mesh, NEO_HOOKE, supports, contacts=off))


CASES = (
    HardCase(
        "Meshes with a Jacobian that is negative in a corner",
        "quadrature points see nothing; the element is folded",
        "the Jacobian is bounded over the whole element, and such meshes are refused",
        folded_meshes,
    ),
    HardCase(
        "Folds between samples",
        "a cubic polynomial is positive wherever it is looked at, and negative elsewhere",
        "Bernstein coefficients bound it, of parts of the element where the sign is open",
        between_samples,
    ),
    HardCase(
        "A bonded block pressed by 17 %",
        "its side rolls onto the plates and through them: folded elements at the rim of the bond, "
        "called converged and stable",
        "folds are told with their place; with contact between side and plates there are none",
        bonded_block,
    ),
    HardCase(
        "The same, finer at the rim of the bond",
        "the side turns by more the nearer to the rim: a finer mesh folds earlier, the walk ends",
        "the limit is that of a body without contact; with contact the strain is reached",
        finer_at_the_rim,
        slow=True,
    ),
    HardCase(
        "A bonded disc pressed by 17 %",
        "hundreds of iterations, and an end on finer meshes, for want of contact with the plates",
        "reached with contact",
        bonded_disc,
        slow=True,
    ),
)
