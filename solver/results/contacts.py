"""What the planes of a problem's contacts exert on the body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.contact import ContactPair, contact_pairs
from solver.mesh.elements import triangle_rule
from solver.problem.vectors import finite
from solver.results.solution import Solution


@dataclass(frozen=True)
class ContactForce:
    """Force, moment, area and pressure of one contact.

    Attributes:
        force: of the plane on the body; normal to the plane, as there is no friction.

            *Shape:* (3,) in N.
        moment: about a given point.

            *Shape:* (3,) in N mm.
        area: of the deformed surface in contact, mm^2; it counts by quadrature points, of which a
            triangle has six, so that its error falls with the size of the elements.
        peak_pressure: the largest at a quadrature point, per deformed area, MPa.
        gap: least signed distance of the surface from the plane, mm; in contact minus the
            penetration.
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
    """
    point = finite("contact_forces: about (mm)", about, (3,))
    return tuple(_force(pair, solution, point) for pair in contact_pairs(solution.problem))


def _force(pair: ContactPair, solution: Solution, about: Reals) -> ContactForce:
    state, face = solution.state, pair.face
    gaps, pressures = pair.gaps(state, solution.load), pair.pressures(state, solution.load)
    normal = pair.plane(state, solution.load).equation[:3]
    deformed = (face.nodes + state.displacement)[face.triangles]
    places = np.einsum("qa,kai->kqi", face.shapes, deformed) - about
    borne = face.areas * pressures
    areas = _areas(deformed)
    return ContactForce(
        force=borne.sum() * normal,
        moment=np.cross(np.einsum("kq,kqi->i", borne, places), normal),
        area=float(areas[gaps < 0].sum()),
        peak_pressure=float((borne / areas).max(initial=0.0)),
        gap=float(gaps.min(initial=np.inf)),
    )


def _areas(triangles: Reals) -> Reals:
    """Areas (k, q) that the quadrature points of triangles (k, 6, 3) stand for, mm^2."""
    rule = triangle_rule()
    along = np.einsum("qad,kai->dkqi", rule.gradients, triangles)
    areas: Reals = rule.weights * np.linalg.norm(np.cross(along[0], along[1]), axis=-1)
    return areas
