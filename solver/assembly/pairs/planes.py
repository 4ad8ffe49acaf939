"""Contact with planes: of symmetry, the moving plane, and rigid ones.

All are written as g = n . x + c. A fixed plane has constant n and c; one that is led has a c that
depends on the load; the moving plane of a cell (``solver.assembly.moving_plane``) has

    n = (-cos t, 0, sin t),   c = (L + shift) cos t,   t = tilt,

whose derivatives go into the unknowns tilt and shift.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.pairs.pair import ContactPair, PlaneUnknowns, at_nodes, at_points, face_of
from solver.assembly.state import State
from solver.kernels.contact import Plane, assemble_contact, face_energy
from solver.linear.sparsity import Pattern
from solver.problem.contacts import Contact, on_moving_plane
from solver.problem.problem import Problem
from solver.problem.rigid_bodies import RigidPlane
from solver.problem.unknowns import Numbering


class PlanePair(ContactPair):
    """Contact of a surface with a plane."""

    contact: Contact | RigidPlane

    @staticmethod
    def of(problem: Problem, contact: Contact | RigidPlane, numbering: Numbering) -> PlanePair:
        """The contact with its triangles' quadrature and numbers of unknowns."""
        dofs = _dofs(problem, contact, problem.mesh.triangles(contact.surface), numbering)
        return PlanePair(problem, contact, face_of(problem, contact, dofs))

    def plane(self, state: State, load: float) -> Plane:
        """The plane at a state and a fraction of the load."""
        if isinstance(self.contact, RigidPlane):
            return _still(self.contact.equation(load))
        if self.contact.axis is None:
            return _moving_plane(_initial_x(self.problem), state.plane)
        middle = self.problem.mesh.nodes[:, self.contact.axis].mean()
        side = 1.0 if middle >= self.contact.position else -1.0  # where the body is
        equation = np.zeros(4)
        equation[self.contact.axis], equation[3] = side, -side * self.contact.position
        return _still(equation)

    def gaps(self, state: State, load: float) -> Reals:
        """Signed distances of the quadrature points from the plane, (k, q), mm."""
        *normal, constant = self.plane(state, load).equation
        along = (self.face.nodes + state.displacement) @ np.array(normal)
        gaps: Reals = along[self.face.triangles] @ self.face.shapes.T + constant
        return gaps

    def normals(self, state: State, load: float) -> Reals:
        """The plane's normal at the quadrature points, (k, q, 3)."""
        return np.broadcast_to(self.plane(state, load).equation[:3], (*self.face.areas.shape, 3))

    def energy(self, state: State, load: float) -> float:
        """Energy of the penetration, N mm."""
        return float(face_energy(self.face, self.plane(state, load), state.displacement))

    def add(
        self,
        state: State,
        load: float,
        plane: PlaneUnknowns,
        residual: Reals,
        values: Reals,
        pattern: Pattern | None,
    ) -> None:
        """Add forces and tangent, also those of the moving plane's unknowns."""
        assemble_contact(
            self.face, self.entries(pattern), self.plane(state, load), plane.heights, plane.tilt,
            np.ascontiguousarray(state.displacement), pattern is not None, residual, values,
        )  # fmt: skip

    def changes(self, state: State, load: float, along: Reals, motion: Reals) -> Reals:
        """Changes of the gaps; by ``motion`` only at the moving plane."""
        plane = self.plane(state, load)
        turn, shift = self._own(motion)
        places = at_points(self.face, self.face.nodes + state.displacement)
        changes = at_points(self.face, along) @ plane.equation[:3]
        changes += turn * (places @ plane.turned[:3] + plane.turned[3]) + shift * plane.shifted
        return np.asarray(changes)

    def gathered(self, state: State, load: float, weights: Reals) -> Reals:
        """Derivative (n, 3) of the weighted gaps by displacements."""
        return at_nodes(self.face, weights[..., None] * self.plane(state, load).equation[:3])

    def bent(self, state: State, load: float, weights: Reals, along: Reals, motion: Reals) -> Reals:
        """Derivative (n, 3) of the weighted changes: by the turning of the moving plane."""
        turn, _ = self._own(motion)
        turned = self.plane(state, load).turned[:3]
        return at_nodes(self.face, turn * weights[..., None] * turned)

    def _own(self, motion: Reals) -> tuple[float, float]:
        """The turn and shift of the moving plane as far as they are this plane's."""
        if not on_moving_plane(self.contact):
            return 0.0, 0.0
        return float(motion[0]), float(motion[1])


def _dofs(
    problem: Problem, contact: Contact | RigidPlane, triangles: Integers, numbering: Numbering
) -> Integers:
    """Unknowns of triangles (k, 20): the moving plane's where they couple, else -1."""
    moving = problem.moving_plane
    on_plane = () if moving is None else problem.mesh.surface_nodes(moving)
    plane = np.broadcast_to(numbering.plane, (len(triangles), 2)).copy()
    if not on_moving_plane(contact):
        plane[~np.isin(triangles, on_plane).any(axis=1)] = -1
    return np.hstack([numbering.of_triangles(triangles), plane])


def _still(equation: Reals) -> Plane:
    """A plane that no unknown moves."""
    return Plane(equation, np.zeros(4), np.zeros(4), 0.0, 0.0)


def _moving_plane(end: float, motion: Reals) -> Plane:
    """The moving plane, initially at x = ``end``, after ``motion`` (2,): tilt and shift."""
    sine, cosine, reach = np.sin(motion[0]), np.cos(motion[0]), end + motion[1]
    equation = np.array([-cosine, 0.0, sine, reach * cosine])
    turned = np.array([sine, 0.0, cosine, -reach * sine])
    return Plane(equation, turned, -equation, float(cosine), -float(sine))


def _initial_x(problem: Problem) -> float:
    """x of the moving plane in the undeformed body, mm."""
    assert problem.moving_plane is not None
    return float(problem.mesh.nodes[problem.mesh.surface_nodes(problem.moving_plane)[0], 0])
