"""Dead loads: forces that keep size and direction while the body deforms."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias, get_args

import numpy as np

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.input_types import check_number, names, shown
from solver.mesh.edges import SHAPES, common_edge, lengths
from solver.mesh.elements import Rule, tetrahedron_rule, triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.vectors import finite

Field: TypeAlias = tuple[float, float, float] | Callable[[Reals], Reals]
"""A vector, or a function of reference positions (k, 3) in mm that gives vectors (k, 3)."""


@dataclass(frozen=True)
class Traction:
    """A dead force on a surface.

    Attributes:
        surface: name of the surface.
        stress: force per area of the undeformed surface, MPa: a vector, or a function of reference
            positions.

            *Shape:* (3,), or (k, 3) in mm -> (k, 3) in MPa.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> pull = Traction("x1", (0.1, 0, 0))  # a tenth of a MPa along x
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> bar = solve(Problem(block((30, 4, 4), (2, 1, 1)), rubber, held, loads=(pull,)))
        >>> stretch = 1 + bar.displacement[:, 0].max() / 30
        >>> print(f"{0.5 * (stretch - stretch**-2):.4f} MPa")  # the neo-Hookean law at that stretch
        0.1000 MPa
    """

    surface: str
    stress: Field


@dataclass(frozen=True)
class BodyForce:
    """A dead force in the whole body, or in a region of its mesh.

    Attributes:
        density: force per volume of the undeformed body, N/mm^3: a vector, or a function of
            reference positions.

            *Shape:* (3,), or (k, 3) in mm -> (k, 3) in N/mm^3.
        region: name of the region; None for the whole body.

    Examples:
        >>> from solver import BodyForce, Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> weight = BodyForce((0, 0, -1070 * 9.81e-9))  # 1070 kg/m^3
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> bar = Problem(block((40, 4, 4), (8, 1, 1)), rubber, Supports(("x0",)), loads=(weight,))
        >>> sagged = solve(bar)
        >>> print(f"{sagged.displacement[:, 2].min():.2f} mm")
        -1.56 mm
    """

    density: Field
    region: str | None = None


@dataclass(frozen=True)
class PointForce:
    """A dead force on a node.

    Attributes:
        position: of the node in the undeformed body, mm.
        force: its components, N.

    Examples:
        >>> from solver import Ogden, PointForce, Problem, Supports, reaction, solve
        >>> from solver.mesh import block
        >>> corner = PointForce((30, 0, 4), (0, 0.01, 0))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(corner,))
        >>> print(f"{reaction(solve(bar), 'x0').force[1]:.3f} N")
        -0.010 N
    """

    position: tuple[float, float, float]
    force: tuple[float, float, float]


@dataclass(frozen=True)
class EdgeForce:
    """A dead force spread evenly along the edge where two surfaces meet.

    Attributes:
        surfaces: names of both surfaces.
        force: components of the whole force, N; per length of the undeformed edge the same all
            along it.

    Raises:
        SolverError: anything but two names, or but three finite numbers.

    Examples:
        >>> from solver import EdgeForce, Ogden, Problem, Supports, reaction, solve
        >>> from solver.mesh import block
        >>> edge = EdgeForce(("x1", "z1"), (0, 0, -0.02))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(edge,))
        >>> print(f"{reaction(solve(bar), 'x0').force[2]:.3f} N")  # the clamp bears it
        0.020 N
    """

    surfaces: tuple[str, str]
    force: tuple[float, float, float]

    def __post_init__(self) -> None:
        given = names("edge force: surfaces", self.surfaces)
        if len(given) != 2:
            raise SolverError(f"edge force: surfaces must be two names, got {len(given)}.")
        object.__setattr__(self, "surfaces", given)
        force = finite("edge force: force (N)", self.force, (3,))
        object.__setattr__(self, "force", tuple(force.tolist()))


@dataclass(frozen=True)
class Couple:
    """A couple about y on the problem's moving plane, with which it rotates.

    In pure bending the rest of a uniform chain, or of a long tube, exerts one.

    Attributes:
        moment: N mm; positive turns the plane's normal from +x towards -z.

    Examples:
        >>> import math
        >>> from solver import Couple, Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> held = Supports(symmetry={"x0": 0, "y0": 1})
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> cell = block((3, 4, 4), (1, 2, 4))
        >>> problem = Problem(cell, rubber, held, loads=(Couple(1.0),), moving_plane="x1")
        >>> tilt, shift = solve(problem).plane
        >>> # a beam: 3 mm * 1 N mm / (1.5 MPa * 21.3 mm^4)
        >>> print(f"{math.degrees(tilt):.2f} degrees")
        5.39 degrees
    """

    moment: float


@dataclass(frozen=True)
class AxialForce:
    """A dead force along x on the problem's moving plane, at its section's origin.

    That is the plane's point that lies as far below the section's mean height as z = 0 does in the
    undeformed body; the force is spread evenly over the section (``solver.assembly.section``).

    Attributes:
        force: N; positive pulls the plane along +x.

    Examples:
        >>> from solver import AxialForce, Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> held = Supports(symmetry={"x0": 0, "y0": 1})
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> cell = block((3, 4, 4), (1, 2, 2))
        >>> cell = cell.moved(cell.nodes - (0, 0, 2))  # the section's middle at z = 0
        >>> problem = Problem(cell, rubber, held, loads=(AxialForce(1.0),), moving_plane="x1")
        >>> tilt, shift = solve(problem).plane
        >>> print(f"{shift:.3f} mm")  # linear theory: 3 mm * 1 N / (1.5 MPa * 16 mm^2) = 0.125 mm
        0.130 mm
    """

    force: float


Load: TypeAlias = Traction | BodyForce | PointForce | EdgeForce | Couple | AxialForce

LOAD_KINDS: tuple[type, ...] = get_args(Load)

PLANE_LOADS = (Couple, AxialForce)
"""Kinds of loads that act on a moving plane."""


def nodal_forces(mesh: Mesh, loads: Sequence[Load]) -> Reals:
    """Consistent nodal forces (n, 3) in N of all ``loads`` but those on a moving plane.

    Raises ``SolverError`` for an unknown surface, a point force on no node, surfaces without a
    common edge, or a value that is not a finite vector.
    """
    forces = np.zeros(mesh.nodes.shape)
    for load in loads:
        if not isinstance(load, PLANE_LOADS):
            forces += _forces(mesh, load)
    return forces


def check_loads(loads: Sequence[Load], moving_plane: str | None) -> None:
    """Raise ``SolverError`` unless couples and axial forces, and only they, meet a moving plane."""
    on_plane = [isinstance(load, PLANE_LOADS) for load in loads]
    if moving_plane is None and any(on_plane):
        raise SolverError("loads: a couple or an axial force needs a moving plane to act on.")
    if moving_plane is not None and not all(on_plane):
        raise SolverError(
            "loads: a cell with a moving plane takes pressure only, besides couples and axial "
            "forces."
        )


def loaded_surfaces(loads: Sequence[Load]) -> tuple[str, ...]:
    """Names of the surfaces with tractions, and of those with a force on their edge."""
    tractions = (load.surface for load in loads if isinstance(load, Traction))
    edges = (name for load in loads if isinstance(load, EdgeForce) for name in load.surfaces)
    return (*tractions, *edges)


def plane_loads(loads: Sequence[Load]) -> Reals:
    """Couple (N mm) and axial force (N) on the moving plane's section, (2,).

    Raises ``SolverError`` if they are not finite.
    """
    couples = [load.moment for load in loads if isinstance(load, Couple)]
    forces = [load.force for load in loads if isinstance(load, AxialForce)]
    return np.array(
        [
            _sum("load: a couple's moment", couples, "N mm"),
            _sum("load: an axial force", forces, "N"),
        ]
    )


def _sum(what: str, values: Sequence[float], unit: str) -> float:
    """Sum of numbers; ``SolverError`` if it is not finite."""
    for value in values:
        check_number(what, value)
    total = math.fsum(values)
    if not math.isfinite(total):
        raise SolverError(f"{what} must be a finite number of {unit}, got {total}.")
    return total


def _forces(mesh: Mesh, load: Traction | BodyForce | PointForce | EdgeForce) -> Reals:
    if isinstance(load, PointForce):
        return _on_node(mesh, load)
    if isinstance(load, EdgeForce):
        return _on_edge(mesh, load)
    if isinstance(load, Traction):
        cells, rule = mesh.triangles(load.surface), triangle_rule()
        tangents = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[cells])
        sizes = np.linalg.norm(np.cross(tangents[0], tangents[1]), axis=-1)
        return _integrated(mesh, cells, rule, sizes, load.stress)
    cells, rule = elements_of(mesh, load), tetrahedron_rule()
    sizes = np.linalg.det(np.einsum("qad,kai->kqdi", rule.gradients, mesh.nodes[cells]))
    return _integrated(mesh, cells, rule, sizes, load.density)


def elements_of(mesh: Mesh, load: BodyForce) -> Integers:
    """Tetrahedra (k, 10) that a load acts on; ``SolverError`` for an unknown region."""
    region = load.region
    if region is None:
        return mesh.tets
    if not isinstance(region, str) or region not in mesh.regions:
        known = ", ".join(mesh.regions) or "none"
        raise SolverError(f"load: the mesh has no region {region!r}; known regions: {known}.")
    elements: Integers = mesh.tets[mesh.regions[region]]
    return elements


def _integrated(mesh: Mesh, cells: Integers, rule: Rule, sizes: Reals, field: Field) -> Reals:
    """Integral of N_a times ``field`` over cells (k, m) of which points (k, q) have ``sizes``."""
    places = np.einsum("qa,kai->kqi", rule.quadratic, mesh.nodes[cells])
    values = _values(field, places.reshape(-1, 3)).reshape(places.shape)
    parts = np.einsum("q,kq,qa,kqi->kai", rule.weights, sizes, rule.quadratic, values)
    forces = np.zeros(mesh.nodes.shape)
    np.add.at(forces, cells, parts)
    return forces


def node_at(mesh: Mesh, position: tuple[float, float, float], what: str = "point force") -> int:
    """The node of an element at a position in mm; ``SolverError`` if there is none."""
    nodes = np.unique(mesh.tets)
    away = mesh.nodes[nodes] - _values(position, np.zeros((1, 3)))
    distances = np.linalg.norm(away, axis=1)
    nearest = int(distances.argmin())
    if distances[nearest] > 1e-6 * mesh.size:
        raise SolverError(
            f"{what}: no node lies at {position} mm; the nearest is "
            f"{distances[nearest]:.3g} mm away."
        )
    return int(nodes[nearest])


def _on_node(mesh: Mesh, load: PointForce) -> Reals:
    forces = np.zeros(mesh.nodes.shape)
    forces[node_at(mesh, load.position)] = _values(load.force, np.zeros((1, 3)))[0]
    return forces


def _on_edge(mesh: Mesh, load: EdgeForce) -> Reals:
    lines = common_edge(mesh, *load.surfaces)
    sizes, forces = lengths(mesh.nodes, lines), np.zeros(mesh.nodes.shape)
    shares = np.einsum("kq,qa->ka", sizes, SHAPES) / sizes.sum()
    np.add.at(forces, lines, shares[..., None] * np.array(load.force))
    return forces


def _values(field: Field, positions: Reals) -> Reals:
    """Vectors (k, 3) of a field at positions (k, 3)."""
    value = field(positions) if callable(field) else field
    try:
        given = np.asarray(value, float)
    except (TypeError, ValueError):
        raise SolverError(f"load: needs vectors of numbers, got {shown(value)}.") from None
    if given.shape not in ((3,), positions.shape):
        raise SolverError(f"load: needs vectors of the shape {positions.shape}, got {given.shape}.")
    if not np.isfinite(given).all():
        raise SolverError("load: every component must be a finite number.")
    return np.broadcast_to(given, positions.shape)
