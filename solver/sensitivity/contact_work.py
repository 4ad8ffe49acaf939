"""Derivatives of the virtual work of contacts (``solver.assembly.contact``) by positions.

A contact's energy is the integral of psi(g) over the reference area, g being the distance of a
point from its plane (or cylinder, sphere, other surface). Along a direction, which may also tilt
and shift the moving plane, the gap changes by dg, so that the work is the integral of psi' dg. Its
derivative has parts by the area, by the deformed positions (g and dg change) and, at the moving
plane, by where the plane is in the undeformed body. Which points touch is taken as it is: there
psi'' is continuous.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.pairs.pair import ContactPair
from solver.assembly.pairs.planes import PlanePair
from solver.assembly.state import State
from solver.kernels.contact import SLOPE, contact_values
from solver.problem.contacts import on_moving_plane
from solver.sensitivity.surface_integrals import area_derivative
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
    state: State
    load: float
    direction: Direction
    slopes: Reals
    curvatures: Reals
    changes: Reals

    @staticmethod
    def of(pair: ContactPair, state: State, load: float, direction: Direction) -> _Touch:
        """Gaps and their changes."""
        changes = pair.changes(state, load, direction.displacement, direction.plane)
        curvatures = contact_values(pair.face, pair.gaps(state, load), SLOPE)
        slopes = -pair.pressures(state, load)
        return _Touch(pair, state, load, direction, slopes, curvatures, changes)

    @property
    def density(self) -> Reals:
        """Work per reference area (k, q), N/mm."""
        return self.slopes * self.changes

    def by_deformed_position(self) -> Reals:
        """Derivative (n, 3) by x, N."""
        pair, areas = self.pair, self.pair.face.areas
        at, along = (self.state, self.load), (self.direction.displacement, self.direction.plane)
        pushed = pair.gathered(*at, areas * self.curvatures * self.changes)
        return pushed + pair.bent(*at, areas * self.slopes, *along)

    def by_area(self) -> Reals:
        """Derivative (n, 3) by the reference area at fixed gaps, N."""
        face = self.pair.face
        return area_derivative(face.nodes, face.triangles, self.density)

    def by_place_of_the_plane(self) -> Reals:
        """Derivative (n, 3) by the x of the moving plane, of which any of its nodes tells, N.

        It enters the plane's equation as the shift does.
        """
        problem, result = self.pair.problem, np.zeros_like(self.pair.face.nodes)
        if not isinstance(self.pair, PlanePair) or not on_moving_plane(self.pair.contact):
            return result
        assert problem.moving_plane is not None
        plane = self.pair.plane(self.state, self.load)
        changes = self.curvatures * self.changes * plane.shifted
        changes += self.slopes * float(self.direction.plane[0]) * plane.shifted_turned
        node = problem.mesh.surface_nodes(problem.moving_plane)[0]
        result[node, 0] = (self.pair.face.areas * changes).sum()
        return result
