"""Contact of two surfaces of one body.

The gap of a point x_s of one surface is its signed distance g = (x_s - x_m) . n from the closest
point x_m of the other one, n being its outward normal there. The closest point slides as the
surfaces move. With A the derivative of x_s - x_m by the nodes at fixed parameters of x_m, a_c the
tangents, k_cd = n . x_m,cd, m_cd = a_c . a_d, D = m - g k, and T_c the derivative of -n . a_c by
the nodes, eliminating the parameters from |x_s - x_m|^2 / 2 gives

    dg/dq     = A^T n,
    d2g/dq2   = -A^T a m^-1 k D^-1 a^T A - (A^T a D^-1 T^T + its transpose) - g T D^-1 T^T,

which holds as g vanishes (T. A. Laursen, *Computational Contact and Impact Mechanics*, 2002,
chapter 5, has the same in other symbols). Between triangles the surface has kinks: a point behind a
re-entrant one, of which no triangle has a closest point inside, has the distance from the edge or
corner, and that one's derivatives, with the term A^T (1 - n n^T - a m^-1 a^T) A / g in addition.
Beyond the rim of the other surface nothing is touched.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from solver.arrays import Integers, Reals
from solver.assembly.pairs.pair import ContactPair, PlaneUnknowns, at_nodes, at_points, face_of
from solver.assembly.pairs.passing import through_facets
from solver.assembly.state import State
from solver.kernels.closest_points import (
    Feet,
    Flags,
    Numbers,
    Surface,
    find_feet,
)
from solver.kernels.surface_contact import (
    assemble_surface_contact,
    bent_gaps,
)
from solver.linear.sparsity import Pattern
from solver.mesh.elements import quadratic_shapes, triangle_rule
from solver.mesh.proximity import OPPOSING, PARTS
from solver.problem.contacts import SurfaceContact
from solver.problem.problem import Problem
from solver.problem.unknowns import Numbering

CANDIDATES = 6
"""Nearest flat facets of the other surface in whose triangles a closest point is looked for."""


class Other(NamedTuple):
    """The other surface, unknowns ``dofs`` (k, 18) of its triangles, and how deep points count, mm.

    ``reach`` is that depth.
    """

    surface: Surface
    dofs: Integers
    reach: float

    @property
    def triangles(self) -> Integers:
        """Its triangles (k, 6)."""
        return self.surface.triangles


@dataclass(frozen=True)
class Places:
    """Where a state has ``points`` (p, 3), ``normals`` (p, 3) there, and flat ``facets`` (f, 3, 3).

    The facets are those of the other surface, four to a triangle, by their corners.
    """

    points: Reals
    normals: Reals
    facets: Reals

    @property
    def centres(self) -> Reals:
        """Of the facets (f, 3)."""
        centres: Reals = self.facets.mean(axis=1)
        return centres

    @property
    def across(self) -> Reals:
        """Unit normals (f, 3) of the facets."""
        edges = self.facets[:, 1:] - self.facets[:, :1]
        return _unit(np.cross(edges[:, 0], edges[:, 1]))


@dataclass
class Memory:
    """The feet found last and the positions (n, 3) that they belong to."""

    positions: Reals = field(default_factory=lambda: np.empty((0, 3)))
    feet: Feet | None = None


@dataclass(frozen=True)
class SurfacePair(ContactPair):
    """Contact of a surface with another one of the same body."""

    contact: SurfaceContact
    other: Other
    memory: Memory

    @staticmethod
    def of(problem: Problem, contact: SurfaceContact, numbering: Numbering) -> SurfacePair:
        """The contact with its triangles' quadrature and numbers of unknowns."""
        mesh = problem.mesh
        triangles = mesh.triangles(contact.other)
        other = Other(
            surface=Surface(
                triangles, neighbours := edge_neighbours(triangles), rim_of(triangles, neighbours)
            ),
            dofs=numbering.of_triangles(triangles),
            reach=contact.reach or mesh.edge,
        )
        dofs = numbering.of_triangles(mesh.triangles(contact.surface))
        return SurfacePair(problem, contact, face_of(problem, contact, dofs), other, Memory())

    def feet(self, state: State) -> Feet:
        """Closest points of the other surface to the quadrature points."""
        memory = self.memory
        positions = self.face.nodes + state.displacement
        if memory.feet is None or not np.array_equal(memory.positions, positions):
            memory.feet, memory.positions = self._found(state), positions
        return memory.feet

    def gaps(self, state: State, load: float) -> Reals:
        """Signed distances (k, q) from the other surface, mm; infinite where it is not near."""
        return self.feet(state).gaps.reshape(self.face.areas.shape)

    def normals(self, state: State, load: float) -> Reals:
        """Directions (k, q, 3) away from the other surface; zero where it is not near."""
        return self.feet(state).normals.reshape(*self.face.areas.shape, 3)

    def coupled(self, state: State) -> Numbers:
        """Pairs of triangles (j,) that touch, each as a number (``_numbers``)."""
        feet = self.feet(state)
        return np.unique(self._numbers(feet, np.flatnonzero(feet.gaps < 0)))

    def around(self, pairs: Numbers) -> Numbers:
        """Pairs of triangles and of those across their edges."""
        own, other = np.divmod(pairs, len(self.other.triangles))
        both = _with_neighbours(own, edge_neighbours(self.face.triangles))
        beyond = _with_neighbours(other, self.other.surface.neighbours)
        first = np.repeat(both, beyond.shape[1], axis=1).ravel()
        last = np.tile(beyond, (1, both.shape[1])).ravel()
        usable = (first >= 0) & (last >= 0)
        return np.unique(first[usable] * len(self.other.triangles) + last[usable])

    def pair_dofs(self, pairs: Numbers) -> Integers:
        """Unknowns (j, 36) of pairs of triangles."""
        own, other = np.divmod(pairs, len(self.other.triangles))
        return np.hstack([self.face.dofs[own], self.other.dofs[other]])

    def add(
        self,
        state: State,
        load: float,
        plane: PlaneUnknowns,
        residual: Reals,
        values: Reals,
        pattern: Pattern | None,
    ) -> None:
        """Add forces and tangent; there is no moving plane beside contact of surfaces."""
        feet = self.feet(state)
        points: Numbers = np.flatnonzero(feet.gaps < 0)
        pairs, numbers = np.unique(self._numbers(feet, points), return_inverse=True)
        dofs = np.ascontiguousarray(self.pair_dofs(pairs))
        entries = np.empty((len(dofs), 0), np.int32) if pattern is None else pattern.entries(dofs)
        assemble_surface_contact(
            self.face, feet, self.face.nodes + state.displacement, self.other.triangles, points,
            numbers, dofs, entries, pattern is not None, residual, values,
        )  # fmt: skip

    def changes(self, state: State, load: float, along: Reals, motion: Reals) -> Reals:
        """Changes of the gaps along displacements."""
        feet = self.feet(state)
        moved = at_points(self.face, along).reshape(-1, 3)
        beneath = np.einsum("pa,pai->pi", self._shapes(feet), along[self._nodes(feet)])
        changes = ((moved - beneath) * feet.normals).sum(axis=1)
        return np.asarray(changes.reshape(self.face.areas.shape))

    def gathered(self, state: State, load: float, weights: Reals) -> Reals:
        """Derivative (n, 3) of the weighted gaps by displacements."""
        feet = self.feet(state)
        vectors = weights[..., None] * self.normals(state, load)
        parts = -self._shapes(feet)[..., None] * vectors.reshape(-1, 1, 3)
        nodes, size = self._nodes(feet).ravel(), len(self.face.nodes)
        opposite = [np.bincount(nodes, parts[..., i].ravel(), size) for i in range(3)]
        return at_nodes(self.face, vectors) + np.stack(opposite, axis=1)

    def bent(self, state: State, load: float, weights: Reals, along: Reals, motion: Reals) -> Reals:
        """Derivative (n, 3) of the weighted changes by displacements."""
        positions = self.face.nodes + state.displacement
        feet, triangles = self.feet(state), self.other.triangles
        bent: Reals = bent_gaps(self.face, feet, positions, triangles, weights, along)
        return bent

    def passed(self, before: State, load: float, after: State, target: float) -> str:
        """The other surface, if points were in front of it and are too deep behind it to count."""
        ways = [self._places(state) for state in (before, after)]
        passed = (self._pass(ways[0], ways[1], facing) for facing in map(self._facing, ways))
        return f"the surface {self.contact.other!r}" if any(passed) else ""

    def _pass(self, start: Places, end: Places, facing: Numbers) -> bool:
        """Whether points pass through the facets (p,) that they are facing; -1 for none."""
        those = np.flatnonzero(facing >= 0)
        points = start.points[those], end.points[those]
        facets = start.facets[facing[those]], end.facets[facing[those]]
        return bool(through_facets(points, facets, self.other.reach).any())

    def _places(self, state: State) -> Places:
        """Where points and facets are at a state."""
        positions = self.face.nodes + state.displacement
        along = np.einsum(
            "qad,kai->dkqi", triangle_rule().gradients, positions[self.face.triangles]
        )
        return Places(
            points=at_points(self.face, positions).reshape(-1, 3),
            normals=_unit(np.cross(along[0], along[1]).reshape(-1, 3)),
            facets=np.stack(
                [positions[self.other.triangles[:, part]] for part in PARTS], axis=1
            ).reshape(-1, 3, 3),
        )

    def _found(self, state: State) -> Feet:
        """The closest points after a search among flat facets that oppose the points' own."""
        places = self._places(state)
        size = np.linalg.norm(places.facets - places.centres[:, None], axis=2).max()
        facets = self._opposing(places, CANDIDATES, self.other.reach + float(size))
        candidates = each_once(np.where(facets >= 0, facets // len(PARTS), -1))
        feet: Feet = find_feet(
            places.points, candidates, self.face.nodes + state.displacement, self.other.surface,
            self.other.reach,
        )  # fmt: skip
        return feet

    def _facing(self, places: Places) -> Numbers:
        """The facet (p,) nearest to each point if it opposes it, -1 if not."""
        return self._opposing(places, 1, np.inf)[:, 0]

    def _opposing(self, places: Places, count: int, within: float) -> Numbers:
        """Facets (p, c) nearest to the points, as far as they oppose them; -1 for none."""
        count = min(count, len(places.facets))
        _, found = cKDTree(places.centres).query(
            places.points, k=np.arange(1, count + 1), distance_upper_bound=within
        )
        near = found < len(places.facets)
        found = np.where(near, found, 0)
        across = places.across
        opposing = np.einsum("pi,pci->pc", places.normals, across[found]) <= OPPOSING
        return np.where(near & opposing, found, -1)

    def _numbers(self, feet: Feet, points: Numbers) -> Numbers:
        """Numbers of the pairs of triangles that points belong to."""
        own = points // self.face.areas.shape[1]
        return np.asarray(own * len(self.other.triangles) + feet.triangles[points])

    def _nodes(self, feet: Feet) -> Integers:
        """Nodes (p, 6) of the triangles beneath the points; any where there is none."""
        return self.other.triangles[feet.triangles]

    def _shapes(self, feet: Feet) -> Reals:
        """Shape functions (p, 6) of the closest points; zero where there is none."""
        r, s = feet.parameters.T
        shapes = quadratic_shapes(np.stack([1 - r - s, r, s], axis=1), ((0, 1), (1, 2), (2, 0)))
        return np.where(feet.triangles[:, None] >= 0, shapes, 0.0)


def edge_neighbours(triangles: Integers) -> Numbers:
    """Triangles (k, 3) across the edges of six-node triangles (k, 6), which share a mid-node."""
    middles = triangles[:, 3:].ravel()
    order = np.argsort(middles, kind="stable")
    sorted_middles = middles[order]
    same = np.flatnonzero(sorted_middles[1:] == sorted_middles[:-1])
    neighbours = np.full(len(middles), -1)
    one, other = order[same], order[same + 1]
    neighbours[one], neighbours[other] = other // 3, one // 3
    return neighbours.reshape(-1, 3)


def _unit(vectors: Reals) -> Reals:
    """Vectors (p, 3) with length 1."""
    unit: Reals = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return unit


def rim_of(triangles: Integers, neighbours: Numbers) -> Flags:
    """Which corners (k, 3) of triangles (k, 6) are ends of an edge without a neighbour."""
    ends = np.stack([triangles[:, :3], triangles[:, [1, 2, 0]]], axis=2)
    return np.isin(triangles[:, :3], ends[neighbours < 0])


def each_once(numbers: Numbers) -> Numbers:
    """Numbers (p, c) with those that a row has before replaced by -1."""
    same = numbers[:, :, None] == numbers[:, None, :]
    return np.where(np.tril(same, -1).any(axis=2), -1, numbers)


def _with_neighbours(triangles: Numbers, neighbours: Numbers) -> Numbers:
    """Triangles (j,) and those across their edges, (j, 4)."""
    return np.column_stack([triangles, neighbours[triangles]])
