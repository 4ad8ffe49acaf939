"""What all contacts of a problem on its mesh have in common: a gap at each quadrature point.

See ``solver.assembly.contact`` for the energy of a gap.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.state import State
from solver.kernels.contact import ENERGY, PRESSURE, Face, contact_values
from solver.linear.sparsity import Pattern
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.contacts import AnyContact, surfaces_of
from solver.problem.problem import Problem

SMOOTHING = 0.1
"""s over the penetration of a contact."""


@dataclass(frozen=True)
class PlaneUnknowns:
    """Where a state has the nodes of the moving plane: their ``heights`` (n,), NaN elsewhere."""

    heights: Reals
    tilt: float


@dataclass(frozen=True)
class ContactPair(ABC):
    """One contact of a problem on its mesh; ``face``: the surface that may not cross."""

    problem: Problem
    contact: AnyContact
    face: Face

    @abstractmethod
    def gaps(self, state: State, load: float) -> Reals:
        """Signed distances of the quadrature points from what they may not cross, (k, q), mm."""

    @abstractmethod
    def normals(self, state: State, load: float) -> Reals:
        """Directions in which the gaps grow with the points, of length 1, (k, q, 3)."""

    @abstractmethod
    def add(
        self,
        state: State,
        load: float,
        plane: PlaneUnknowns,
        residual: Reals,
        values: Reals,
        pattern: Pattern | None,
    ) -> None:
        """Add forces to ``residual``, and the tangent to the ``values`` of a ``pattern`` if any."""

    @abstractmethod
    def changes(self, state: State, load: float, along: Reals, motion: Reals) -> Reals:
        """Changes of the gaps (k, q) along displacements (n, 3) and of a moving plane (2,)."""

    @abstractmethod
    def gathered(self, state: State, load: float, weights: Reals) -> Reals:
        """Derivative (n, 3) of the gaps times fixed ``weights`` (k, q) by displacements."""

    @abstractmethod
    def bent(self, state: State, load: float, weights: Reals, along: Reals, motion: Reals) -> Reals:
        """Derivative (n, 3) of the ``changes`` times fixed ``weights`` by displacements."""

    def softer(self, factor: float) -> Self:
        """The same contact with ``factor`` times its penetration."""
        depth = factor * self.contact.penetration
        stiffness, smoothing = self.face.stiffness / factor, SMOOTHING * depth
        face = self.face._replace(stiffness=stiffness, smoothing=smoothing)
        return replace(self, contact=replace(self.contact, penetration=depth), face=face)

    def entries(self, pattern: Pattern | None) -> Integers:
        """Positions of the triangles' entries in a pattern, (k, 210); (k, 0) without one."""
        if pattern is None:
            return np.empty((len(self.face.triangles), 0), np.int32)
        return pattern.entries(self.face.dofs)

    def touches(self, state: State, load: float) -> bool:
        """True if a quadrature point is beyond what it may not cross."""
        return bool((self.gaps(state, load) < 0).any())

    def pressures(self, state: State, load: float) -> Reals:
        """Pressure per reference area at the quadrature points, (k, q), MPa."""
        pressures: Reals = contact_values(self.face, self.gaps(state, load), PRESSURE)
        return pressures

    def forces(self, state: State, load: float) -> Reals:
        """Nodal forces (n, 3) on the body, N; of two surfaces those on both, in balance."""
        return self.gathered(state, load, self.face.areas * self.pressures(state, load))

    def passed(self, before: State, load: float, after: State, target: float) -> str:
        """What points have passed through between two states and fractions of the load; or none.

        They are then where the contact does not see them. A plane has no other side.
        """
        return ""

    def change(self, before: State, after: State, load: float) -> float:
        """Change of the pressures between two states, relative to those of the latter.

        Infinite if those are gone.
        """
        pressures = self.pressures(after, load)
        changes = np.abs(pressures - self.pressures(before, load))
        change, whole = (float((self.face.areas * p).sum()) for p in (changes, pressures))
        if not change:
            return 0.0
        return change / whole if whole else np.inf

    def energy(self, state: State, load: float) -> float:
        """Energy of the penetration, N mm."""
        energies = contact_values(self.face, self.gaps(state, load), ENERGY)
        return float((self.face.areas * energies).sum())


def face_of(problem: Problem, contact: AnyContact, dofs: Integers) -> Face:
    """Triangles of a contact's surface with their quadrature and numbers of unknowns."""
    mesh, triangles = problem.mesh, problem.mesh.triangles(contact.surface)
    distribution = problem.distribution
    softest = distribution.materials[distribution.softest_at(*surfaces_of(contact))]
    return Face(
        nodes=mesh.nodes,
        triangles=triangles,
        shapes=triangle_rule().quadratic,
        areas=_areas(mesh, triangles),
        dofs=np.ascontiguousarray(dofs),
        stiffness=softest.shear_modulus / contact.penetration,
        smoothing=SMOOTHING * contact.penetration,
    )


def at_points(face: Face, nodal: Reals) -> Reals:
    """Nodal vectors (n, 3) at the quadrature points of a face, (k, q, 3)."""
    values: Reals = face.shapes @ nodal[face.triangles]
    return values


def at_nodes(face: Face, vectors: Reals) -> Reals:
    """Sums (n, 3) of N_a times vectors (k, q, 3) at the quadrature points of a face."""
    nodes, parts = face.triangles.ravel(), face.shapes.T @ vectors
    size = len(face.nodes)
    return np.stack([np.bincount(nodes, parts[..., i].ravel(), size) for i in range(3)], axis=1)


def _areas(mesh: Mesh, triangles: Integers) -> Reals:
    """Reference areas (k, q) of the quadrature points of triangles (k, 6), mm^2."""
    rule = triangle_rule()
    along = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[triangles])
    areas: Reals = rule.weights * np.linalg.norm(np.cross(along[0], along[1]), axis=2)
    return areas
