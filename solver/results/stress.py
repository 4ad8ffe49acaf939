"""Cauchy stress at the nodes, recovered from the quadrature points.

Stresses jump between regions of other stiffness, so that they are averaged over the elements of one
region only: a node between regions has one value on each of its sides (``Mesh.sides``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.assembly.assembly import solid
from solver.assembly.state import State
from solver.kernels.element import Solid
from solver.kernels.stress import deviatoric_stress
from solver.mesh.elements import TETRAHEDRON_EDGES, tetrahedron_rule
from solver.mesh.mesh import Mesh
from solver.mesh.regions import REST
from solver.problem.problem import Problem
from solver.results.sharp_edges import trusted_nodes
from solver.results.solution import Solution, check_solution


@dataclass(frozen=True)
class Peak:
    """A largest nodal stress.

    Attributes:
        value: MPa.
        node: its number.
        position: of the node in the undeformed body, mm.
        scatter: MPa, how far the elements around the node differ: the root mean square of the von
            Mises stress of their differences from the average. It vanishes under refinement, and
            is 0 at a node of a single element.
        region: of the mesh that it is in; empty in the rest.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, peak_von_mises, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> peak = peak_von_mises(solve(bar))
        >>> print(f"{peak.value:.3f} MPa at {peak.position} mm")
        0.040 MPa at (5.0, 4.0, 4.0) mm
    """

    value: float
    node: int
    position: tuple[float, float, float]
    scatter: float
    region: str = REST


def nodal_von_mises(solution: Solution) -> Reals:
    """Von Mises Cauchy stress at the nodes.

    Args:
        solution: an equilibrium.

    Returns:
        Of the stress averaged over the elements at each node, weighted by their volumes; at a node
        between regions the largest of theirs.

        *Shape:* (n,) in MPa.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, nodal_von_mises, solve
        >>> from solver.mesh import block
        >>> held, pull = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), Traction("x1", (0.1, 0, 0))
        >>> bar = block((30, 4, 4), (6, 1, 1))
        >>> stress = nodal_von_mises(solve(Problem(bar, Ogden.neo_hooke(0.5), held, loads=(pull,))))
        >>> print(stress.shape, f"{stress.min():.4f} to {stress.max():.4f} MPa")  # uniform tension
        (117,) 0.1071 to 0.1071 MPa
    """
    check_solution(solution)
    stress = deviatoric_at_sides(solution.problem, solution.displacement)
    return largest_at_nodes(solution.problem.mesh, von_mises(stress))


def nodal_cauchy(solution: Solution) -> Reals:
    """Cauchy stress at the nodes.

    Args:
        solution: an equilibrium.

    Returns:
        Components in the order xx, yy, zz, xy, yz, zx; at a node between regions in that of the
        largest von Mises stress.

        *Shape:* (n, 6) in MPa.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, nodal_cauchy, solve
        >>> from solver.mesh import block
        >>> held, pull = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), Traction("x1", (0.1, 0, 0))
        >>> bar = block((30, 4, 4), (6, 1, 1))
        >>> stress = nodal_cauchy(solve(Problem(bar, Ogden.neo_hooke(0.5), held, loads=(pull,))))
        >>> print([f"{abs(mean):.4f}" for mean in stress.mean(axis=0)])  # MPa; along x, true stress
        ['0.1071', '0.0000', '0.0000', '0.0000', '0.0000', '0.0000']
    """
    check_solution(solution)
    mesh = solution.problem.mesh
    stress = deviatoric_at_sides(solution.problem, solution.displacement)
    shown = _shown_sides(mesh, von_mises(stress))
    stress[:, :3] -= _pressure_at_sides(mesh, solution.hydrostatic_pressure)[:, None]
    values = np.zeros((len(mesh.nodes), 6))
    values[mesh.sides[shown]] = stress[shown]
    return values


def peak_von_mises(solution: Solution) -> Peak:
    """Largest nodal von Mises stress.

    Args:
        solution: an equilibrium. Nodes nearer to a sharp edge than its problem's
            ``sharp_edge_radius`` do not count (``solver.results.sharp_edges``).

    Returns:
        The stress and where it is.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction
        >>> from solver import nodal_von_mises, peak_von_mises, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> solution = solve(bar)
        >>> print(peak_von_mises(solution).value == nodal_von_mises(solution).max())
        True
    """
    check_solution(solution)
    return peak_of(solution.problem, solution.displacement)


def peaks_by_region(solution: Solution) -> dict[str, Peak]:
    """Largest nodal von Mises stress of each region.

    Args:
        solution: an equilibrium. Nodes near sharp edges do not count, as for ``peak_von_mises``,
            but in a region that has no others.

    Returns:
        Region -> the stress and where it is. The rest, which belongs to no region of the mesh, has
        the empty name; it is missing where there is none.

    Examples:
        >>> import numpy as np
        >>> from solver import Ogden, Problem, Supports, Traction, peaks_by_region, solve
        >>> from solver.mesh import block
        >>> bar = block((30, 4, 4), (6, 1, 2))
        >>> centres = bar.nodes[bar.tets[:, :4]].mean(axis=1)
        >>> layered = bar.with_regions({"stiff": np.flatnonzero(centres[:, 2] < 2)})
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> pull = Traction("x1", (0.01, 0, 0))
        >>> rubber, stiff = Ogden.neo_hooke(0.5), Ogden.neo_hooke(5.0)
        >>> materials = {"stiff": stiff}
        >>> solution = solve(Problem(layered, rubber, held, loads=(pull,), materials=materials))
        >>> peaks = peaks_by_region(solution)
        >>> print(sorted(peaks), peaks["stiff"].value > peaks[""].value)
        ['', 'stiff'] True
    """
    check_solution(solution)
    problem = solution.problem
    mesh, stress = problem.mesh, stress_after(problem, solution.displacement)
    counted = trusted_nodes(problem)[mesh.sides]
    peaks = {}
    for number in np.unique(mesh.region_of_tet):
        own = mesh.region_of_side == number
        chosen = counted & own if (counted & own).any() else own
        peaks[mesh.region_names[number]] = _peak(mesh, stress, chosen)
    return peaks


def peak_of(
    problem: Problem, displacement: Reals, counted: NDArray[np.bool_] | None = None
) -> Peak:
    """The same after a displacement (n, 3), mm; ``counted`` (n,): the nodes that count."""
    counted = trusted_nodes(problem) if counted is None else counted
    return _peak(problem.mesh, stress_after(problem, displacement), counted[problem.mesh.sides])


def _peak(mesh: Mesh, stress: ElementStress, counted: NDArray[np.bool_]) -> Peak:
    """The largest one of the sides that are ``counted`` (s,)."""
    values = np.where(counted, von_mises(stress.nodal), 0.0)
    side = int(values.argmax())
    around = (stress.tets == side).any(axis=1)
    jumps = stress.raw[around] - stress.nodal[stress.tets[around]]
    differences = von_mises(jumps[stress.tets[around] == side])
    scatter = float(np.sqrt((differences**2).mean()))
    node = int(mesh.sides[side])
    x, y, z = (float(c) for c in mesh.nodes[node])
    region = mesh.region_names[mesh.region_of_side[side]]
    return Peak(float(values[side]), node, (x, y, z), scatter, region)


@dataclass(frozen=True)
class ElementStress:
    """Deviatoric Cauchy stress at the ten nodes of each element, MPa.

    ``raw`` (e, 10, 6) of the element itself, ``nodal`` (s, 6) averages on the sides of the nodes of
    the mesh, ``volumes`` (e,) of the elements, mm^3; ``tets`` (e, 10): sides of their nodes.
    """

    raw: Reals
    nodal: Reals
    volumes: Reals
    tets: Integers

    @property
    def smoothed(self) -> Reals:
        """The nodal averages at the nodes of each element, (e, 10, 6)."""
        return self.nodal[self.tets]

    @property
    def jumps(self) -> Reals:
        """Differences of each element from the nodal averages, (e, 10, 6)."""
        return self.raw - self.smoothed


def element_stress(solution: Solution) -> ElementStress:
    """Deviatoric stress in the elements of a solution, and smoothed over them."""
    return stress_after(solution.problem, solution.displacement)


def stress_after(problem: Problem, displacement: Reals) -> ElementStress:
    """The same after a displacement (n, 3), mm."""
    mesh = problem.mesh
    raw, volumes = in_elements(solid(problem), displacement)
    nodal = averaged(mesh.tet_sides, raw, volumes, len(mesh.sides))
    return ElementStress(raw, nodal, volumes, mesh.tet_sides)


def von_mises(stress: Reals) -> Reals:
    """sqrt(3/2 s:s) of stresses (..., 6) in the order xx, yy, zz, xy, yz, zx."""
    deviator = stress[..., :3] - stress[..., :3].mean(axis=-1, keepdims=True)
    return np.sqrt(1.5 * (deviator**2).sum(-1) + 3 * (stress[..., 3:] ** 2).sum(-1))


def nodal_pressure(problem: Problem, state: State) -> Reals:
    """Hydrostatic pressure at all nodes (n,), MPa; linear along element edges.

    At a node between regions in that of the largest von Mises stress.
    """
    mesh = problem.mesh
    shown = np.arange(len(mesh.sides))
    if mesh.regions:
        stress = deviatoric_at_sides(problem, state.displacement)
        shown = _shown_sides(mesh, von_mises(stress))
    values = np.zeros(len(mesh.nodes))
    values[mesh.sides[shown]] = _pressure_at_sides(mesh, state.hydrostatic_pressure)[shown]
    return values


def _pressure_at_sides(mesh: Mesh, pressure: Reals) -> Reals:
    """Hydrostatic pressure (s,) on all sides from that of the unknowns (v,), MPa."""
    values = np.zeros(len(mesh.sides))
    values[mesh.tet_sides[:, :4]] = pressure[mesh.tet_vertices]
    for middle, (a, b) in enumerate(TETRAHEDRON_EDGES, start=4):
        ends = values[mesh.tet_sides[:, a]] + values[mesh.tet_sides[:, b]]
        values[mesh.tet_sides[:, middle]] = ends / 2
    return values


def largest_at_nodes(mesh: Mesh, values: Reals) -> Reals:
    """The largest value (n,) of the sides (s,) of each node; 0 at nodes of no element."""
    if not mesh.regions:
        return values
    largest = np.zeros(len(mesh.nodes))
    np.maximum.at(largest, mesh.sides, values)
    return largest


def _shown_sides(mesh: Mesh, values: Reals) -> NDArray[np.int64]:
    """The side with the largest value (s,) of each node that has sides."""
    order = np.lexsort((values, mesh.sides))
    last = np.append(np.diff(mesh.sides[order]) > 0, True)
    return np.asarray(order[last])


def deviatoric_at_sides(problem: Problem, displacement: Reals) -> Reals:
    """Deviatoric Cauchy stress on the sides of the nodes, MPa: (s, 6).

    In each element the linear field through the four quadrature points, extrapolated to its ten
    nodes; on each side the average over its elements, weighted by their volumes.
    """
    at_nodes, volumes = in_elements(solid(problem), displacement)
    return averaged(problem.mesh.tet_sides, at_nodes, volumes, len(problem.mesh.sides))


def extrapolation() -> Reals:
    """Values (10, 4) at an element's nodes of the linear field through its quadrature points."""
    corners = np.linalg.inv(tetrahedron_rule().linear)
    middles = [(corners[a] + corners[b]) / 2 for a, b in TETRAHEDRON_EDGES]
    values: Reals = np.concatenate([corners, middles])
    return values


def in_elements(body: Solid, displacement: Reals) -> tuple[Reals, Reals]:
    """Deviatoric stress at the ten nodes of each element (e, 10, 6), and element volumes (e,)."""
    stress = np.empty((len(body.tets), len(body.weights), 6))
    volumes = np.empty(stress.shape[:2])
    deviatoric_stress(body, np.ascontiguousarray(displacement), stress, volumes)
    at_corners = np.einsum("vq,eqc->evc", np.linalg.inv(body.linear), stress)
    middles = [(at_corners[:, a] + at_corners[:, b]) / 2 for a, b in TETRAHEDRON_EDGES]
    at_nodes = np.concatenate([at_corners, np.stack(middles, axis=1)], axis=1)
    return at_nodes, volumes.sum(axis=1)


def averaged(
    tets: Integers,
    values: Reals,
    volumes: Reals,
    number_of_nodes: int,
) -> Reals:
    """Averages (n, 6) of element values (e, 10, 6) weighted by element volumes (e,).

    ``tets`` (e, 10) number the nodes, or sides, that they are of.
    """
    nodes, weights = tets.ravel(), np.repeat(volumes, tets.shape[1])
    total = np.bincount(nodes, weights, number_of_nodes)
    sums = [np.bincount(nodes, weights * values[..., c].ravel(), number_of_nodes) for c in range(6)]
    return np.stack(sums, axis=1) / np.where(total > 0, total, 1.0)[:, None]
