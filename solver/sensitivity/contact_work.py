"""Derivatives of the virtual work of contacts (``solver.assembly.contact``) by positions.

A contact's energy is the integral of psi(g) over the reference area, g = n . x + c being the
distance of a point from its plane. Along a direction, which may also tilt and shift the plane, the
gap changes by dg, so that the work is the integral of psi' dg. Its derivative has parts by the
area, by the deformed positions (g and dg change) and, at the moving plane, by where the plane is
in the undeformed body. Which points touch is taken as it is: there psi'' is continuous.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.contact import ContactPair
from solver.assembly.state import State
from solver.kernels.contact import Plane, contact_slopes
from solver.problem.contacts import on_moving_plane
from solver.sensitivity.surface_integrals import area_derivative, at_points, spread
from solver.sensitivity.unknowns import Direction


def contact_derivatives(
    pair: ContactPair, state: State, load: float, direction: Direction
) -> tuple[Reals, Reals]:
    """Derivatives (n, 3) by positions and by displacements of a contact's work, N."""
    touch = _Touch.of(pair, state, load, direction)
    moving = touch.by_deformed_position()
    return moving + touch.by_area() + touch.by_place_of_the_plane(), moving


def contact_work(pair: ContactPair, state: State, load: float, direction: Direction) -> float:
    """Work of a contact along a direction, N mm; in proportion to its stiffness."""
    touch = _Touch.of(pair, state, load, direction)
    return float((pair.face.areas * touch.density).sum())


@dataclass(frozen=True)
class _Touch:
    """A contact at a state and along a direction.

    ``slopes`` and ``curvatures`` (k, q): psi' and psi'' (MPa, MPa/mm) at the quadrature points;
    ``changes`` (k, q): dg, mm.
    """

    pair: ContactPair
    plane: Plane
    turn: float
    slopes: Reals
    curvatures: Reals
    changes: Reals

    @staticmethod
    def of(pair: ContactPair, state: State, load: float, direction: Direction) -> _Touch:
        """Gaps and their changes; the plane turns and shifts only if it is the moving plane."""
        plane, triangles = pair.plane(state, load), pair.face.triangles
        gaps = pair.gaps(state, load)
        turn, shift = direction.plane if on_moving_plane(pair.contact) else (0.0, 0.0)
        places = at_points(pair.face.nodes + state.displacement, triangles)
        changes = at_points(direction.displacement, triangles) @ plane.equation[:3]
        changes += turn * (places @ plane.turned[:3] + plane.turned[3]) + shift * plane.shifted
        curvatures = contact_slopes(pair.face, gaps)
        slopes = -pair.pressures(state, load)
        return _Touch(pair, plane, float(turn), slopes, curvatures, changes)

    @property
    def density(self) -> Reals:
        """Work per reference area (k, q), N/mm."""
        return self.slopes * self.changes

    def by_deformed_position(self) -> Reals:
        """Derivative (n, 3) by x, N."""
        weighted = self.pair.face.areas * self.curvatures * self.changes
        vectors = weighted[..., None] * self.plane.equation[:3]
        turning = self.turn * self.pair.face.areas * self.slopes
        vectors += turning[..., None] * self.plane.turned[:3]
        return spread(len(self.pair.face.nodes), self.pair.face.triangles, vectors)

    def by_area(self) -> Reals:
        """Derivative (n, 3) by the reference area at fixed gaps, N."""
        face = self.pair.face
        return area_derivative(face.nodes, face.triangles, self.density)

    def by_place_of_the_plane(self) -> Reals:
        """Derivative (n, 3) by the x of the moving plane, of which any of its nodes tells, N.

        It enters the plane's equation as the shift does.
        """
        problem, result = self.pair.problem, np.zeros_like(self.pair.face.nodes)
        if on_moving_plane(self.pair.contact) and problem.moving_plane is not None:
            changes = self.curvatures * self.changes * self.plane.shifted
            changes += self.slopes * self.turn * self.plane.shifted_turned
            node = problem.mesh.surface_nodes(problem.moving_plane)[0]
            result[node, 0] = (self.pair.face.areas * changes).sum()
        return result
