"""What the contacts of a problem exert on the body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.pairs.made import contact_pairs
from solver.assembly.pairs.pair import ContactPair
from solver.mesh.elements import triangle_rule
from solver.problem.vectors import finite
from solver.results.solution import Solution, check_solution


@dataclass(frozen=True)
class ContactForce:
    """Force, moment, area and pressure of one contact.

    Attributes:
        force: on the body, of the plane, cylinder or sphere; on the surface, of the other one.

            *Shape:* (3,) in N.
        moment: about a given point.

            *Shape:* (3,) in N mm.
        area: of the deformed surface nearer than the contact's ``penetration``, mm^2.
        peak_pressure: largest at a vertex, per deformed area, MPa: the average over the triangles
            around it. From point to point the pressure of a stiff contact oscillates, its averages
            do not.
        gap: least signed distance of the surface, mm; in contact minus the
            penetration. Infinite where another surface is not near.

    Examples:
        >>> from solver import Ogden, Problem, RigidPlane, Supports, contact_forces, solve
        >>> from solver.mesh import block
        >>> down = lambda load: (0, 0, -0.4 * load)  # by 10 %
        >>> plate = RigidPlane("z1", 0.005, (0, 0, -1), (0, 0, 4), motion=down)
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> pressed = solve(Problem(block((4, 4, 4), (2, 2, 2)), rubber, held, contacts=(plate,)))
        >>> (found,) = contact_forces(pressed)
        >>> print(f"{found.force[2]:.2f} N on {found.area:.1f} mm^2")
        -2.66 N on 17.8 mm^2
    """

    force: Reals
    moment: Reals
    area: float
    peak_pressure: float
    gap: float


def contact_forces(
    solution: Solution, about: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> tuple[ContactForce, ...]:
    """What each contact of the problem exerts on the body, in the order of ``Problem.contacts``.

    Of a symmetric part only that part's share counts. Lever arms are those of the deformed body.

    Args:
        solution: an equilibrium.
        about: point in space that the moments refer to, mm.

    Returns:
        One ``ContactForce`` for each contact; zeros, and a positive gap, where nothing touches.

    Raises:
        SolverError: a point that is not three finite numbers.

    Examples:
        >>> from solver import Ogden, Problem, RigidPlane, Supports, contact_forces, solve
        >>> from solver.mesh import block
        >>> far = RigidPlane("z1", 0.005, (0, 0, -1), (0, 0, 6))  # 2 mm above the block
        >>> held = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
        >>> rubber = Ogden.neo_hooke(0.5)
        >>> alone = solve(Problem(block((4, 4, 4), (1, 1, 1)), rubber, held, contacts=(far,)))
        >>> print([f"{found.gap:.1f} mm" for found in contact_forces(alone)])
        ['2.0 mm']
    """
    check_solution(solution)
    point = finite("contact_forces: about (mm)", about, (3,))
    return tuple(_force(pair, solution, point) for pair in contact_pairs(solution.problem))


def _force(pair: ContactPair, solution: Solution, about: Reals) -> ContactForce:
    state, load, face = solution.state, solution.load, pair.face
    gaps, borne = pair.gaps(state, load), face.areas * pair.pressures(state, load)
    pushes = borne[..., None] * np.where(borne[..., None] > 0, pair.normals(state, load), 0.0)
    deformed = (face.nodes + state.displacement)[face.triangles]
    places = np.einsum("qa,kai->kqi", face.shapes, deformed) - about
    areas = _areas(deformed)
    return ContactForce(
        force=pushes.sum(axis=(0, 1)),
        moment=np.cross(places, pushes).sum(axis=(0, 1)),
        area=float(areas[gaps < pair.contact.penetration].sum()) if borne.any() else 0.0,
        peak_pressure=_peak(face.triangles[:, :3], borne, areas),
        gap=float(gaps.min(initial=np.inf)),
    )


def _peak(corners: Integers, borne: Reals, areas: Reals) -> float:
    """Largest average pressure at a vertex, from force and area (k, q) of quadrature points."""
    vertices, places = np.unique(corners, return_inverse=True)
    forces, sizes = np.zeros((2, len(vertices)))
    linear, places = triangle_rule().linear, places.reshape(corners.shape)
    np.add.at(forces, places, borne @ linear)
    np.add.at(sizes, places, areas @ linear)
    return float((forces / sizes).max(initial=0.0))


def _areas(triangles: Reals) -> Reals:
    """Areas (k, q) that the quadrature points of triangles (k, 6, 3) stand for, mm^2."""
    rule = triangle_rule()
    along = np.einsum("qad,kai->dkqi", rule.gradients, triangles)
    areas: Reals = rule.weights * np.linalg.norm(np.cross(along[0], along[1]), axis=-1)
    return areas
