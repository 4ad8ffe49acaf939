"""Contact with rigid cylinders and spheres.

The gap is g = |y| - R with y = Q (x - c), c a point of the axis or the centre and Q the projection
across the axis, or the identity. Its gradient by x is the normal n = y / |y|, and its second
derivative (Q - n n^T) / |y|, by which contact pressure enters the tangent.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.assembly.pairs.pair import ContactPair, PlaneUnknowns, at_nodes, at_points, face_of
from solver.assembly.pairs.passing import past_axis
from solver.assembly.state import State
from solver.kernels.contact import assemble_curved_contact
from solver.linear.sparsity import Pattern
from solver.problem.problem import Problem
from solver.problem.rigid_bodies import RigidCylinder, RigidSphere
from solver.problem.unknowns import Numbering

WITHIN = 0.5
"""Share of the radius: a node nearer to the axis or centre is not in contact but passed by it."""


class RoundPair(ContactPair):
    """Contact of a surface with a rigid cylinder or sphere."""

    contact: RigidCylinder | RigidSphere

    @staticmethod
    def of(
        problem: Problem, contact: RigidCylinder | RigidSphere, numbering: Numbering
    ) -> RoundPair:
        """The contact with its triangles' quadrature and numbers of unknowns."""
        dofs = numbering.of_triangles(problem.mesh.triangles(contact.surface))
        plane = np.full((len(dofs), 2), -1, np.int32)
        return RoundPair(problem, contact, face_of(problem, contact, np.hstack([dofs, plane])))

    def gaps(self, state: State, load: float) -> Reals:
        """Signed distances of the quadrature points from the round surface, (k, q), mm."""
        gaps: Reals = np.linalg.norm(self._offsets(state, load), axis=2) - self.contact.radius
        return gaps

    def normals(self, state: State, load: float) -> Reals:
        """Directions (k, q, 3) away from axis or centre; any across there."""
        offsets = self._offsets(state, load)
        distances = np.linalg.norm(offsets, axis=2, keepdims=True)
        anywhere = self.contact.across[np.abs(self.contact.across).sum(axis=1).argmax()]
        normals: Reals = np.where(distances > 0, offsets, anywhere)
        return normals / np.linalg.norm(normals, axis=2, keepdims=True)

    def passed(self, before: State, load: float, after: State, target: float) -> str:
        """The cylinder or sphere, if it gets into the body.

        Points or nodes have gone to its other side by a way near it, or nodes lie near its axis or
        centre: it is then between the points, which alone are pressed.
        """
        (start, _), (end, nodes) = self._all_offsets(before, load), self._all_offsets(after, target)
        near = self.contact.radius + self.problem.mesh.edge
        within = np.linalg.norm(nodes, axis=1).min() < WITHIN * self.contact.radius
        return f"the {self.contact.kind}" if within or past_axis(start, end, near).any() else ""

    def _all_offsets(self, state: State, load: float) -> tuple[Reals, Reals]:
        """Vectors as of ``_offsets`` to points and nodes (p, 3), and those to nodes alone."""
        places = self.face.nodes + state.displacement
        nodes = self._across(places[np.unique(self.face.triangles)], load)
        return np.concatenate([self._offsets(state, load).reshape(-1, 3), nodes]), nodes

    def add(
        self,
        state: State,
        load: float,
        plane: PlaneUnknowns,
        residual: Reals,
        values: Reals,
        pattern: Pattern | None,
    ) -> None:
        """Add forces and tangent; there is no moving plane beside rigid bodies."""
        assemble_curved_contact(
            self.face, self.entries(pattern), self.gaps(state, load), self.normals(state, load),
            self.contact.across, self.contact.radius, pattern is not None, residual, values,
        )  # fmt: skip

    def changes(self, state: State, load: float, along: Reals, motion: Reals) -> Reals:
        """Changes of the gaps along displacements."""
        changes = self.normals(state, load) * at_points(self.face, along)
        return np.asarray(changes.sum(axis=2))

    def gathered(self, state: State, load: float, weights: Reals) -> Reals:
        """Derivative (n, 3) of the weighted gaps by displacements."""
        return at_nodes(self.face, weights[..., None] * self.normals(state, load))

    def bent(self, state: State, load: float, weights: Reals, along: Reals, motion: Reals) -> Reals:
        """Derivative (n, 3) of the weighted changes: by the turning of the normals."""
        normals = self.normals(state, load)
        moved = at_points(self.face, along) @ self.contact.across
        turned = moved - (moved * normals).sum(axis=2, keepdims=True) * normals
        distances = self.gaps(state, load) + self.contact.radius
        bends = np.divide(weights, distances, np.zeros_like(weights), where=distances > 0)
        return at_nodes(self.face, bends[..., None] * turned)

    def _offsets(self, state: State, load: float) -> Reals:
        """Vectors (k, q, 3) from axis or centre to the quadrature points, across the axis, mm."""
        return self._across(at_points(self.face, self.face.nodes + state.displacement), load)

    def _across(self, places: Reals, load: float) -> Reals:
        """Vectors (..., 3) from axis or centre to places, across the axis, mm."""
        offsets: Reals = (places - self.contact.place(load)) @ self.contact.across
        return offsets
