"""How the sections of two bodies match in which they are joined: their nodes do not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bellows_design.deformed.joined.motion import Motion, fitted
from solver.arrays import Integers, Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array

FOUR = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
"""Corners of the four flat triangles that stand for one of six nodes."""

NEIGHBOURS = 12
"""Nodes of a section whose mean a node beside it takes, weighted by inverse squared distances."""

SAME = 1e-6
"""mm. Nodes nearer to each other across the axis are at one place."""


@dataclass(frozen=True)
class Match:
    """Places of one body's section in that of another.

    ``nodes`` (k,): of the one body; ``weights`` (k, m): what they are among the other's m nodes.
    """

    nodes: Integers
    weights: csr_array

    @staticmethod
    def of(one: Mesh, section: str, other: Mesh, other_section: str) -> Match:
        """By where nodes lie across the axis, in the undeformed bodies."""
        nodes = one.surface_nodes(section)
        weights = _interpolation(one.nodes[nodes, 1:], other, other_section)
        return Match(nodes, weights)

    def carried(self, one: Reals, other: Reals, moved: Reals) -> Reals:
        """Where the other body's displacement takes the one's nodes of the section, (k, 3) in mm.

        ``one`` (n, 3): undeformed nodes of the one body; ``other`` and ``moved`` (m, 3): those of
        the other, undeformed and deformed. That the two outlines of a rounded section differ, each
        of its own edges, is no displacement: without load nothing moves.
        """
        places: Reals = self.weights @ moved
        places[:, 1:] += one[self.nodes, 1:] - self.weights @ other[:, 1:]
        return places

    def motion(self, one: Reals, carried: Reals) -> Motion:
        """What brings ``carried`` nodes (k, 3), mm, to the ``one`` body (n, 3), where they join."""
        return fitted(carried, one[self.nodes])

    def missed(self, one: Reals, carried: Reals) -> Reals:
        """From the carried nodes (k, 3) after that motion to those of the one body, mm."""
        missed: Reals = one[self.nodes] - self.motion(one, carried).applied(carried)
        return missed

    def spread(self, one: Mesh) -> csr_array:
        """Weights (n, k) of values at the section's nodes that continue them along the axis."""
        from scipy.sparse import csr_array
        from scipy.spatial import cKDTree

        count = min(NEIGHBOURS, len(self.nodes))
        distances, nearest = cKDTree(one.nodes[self.nodes, 1:]).query(one.nodes[:, 1:], k=count)
        weights = 1 / (distances**2 + SAME**2)
        weights /= weights.sum(axis=1, keepdims=True)
        rows = np.repeat(np.arange(len(one.nodes)), count)
        shape = (len(one.nodes), len(self.nodes))
        return csr_array((weights.ravel(), (rows, nearest.ravel())), shape)


def _interpolation(places: Reals, other: Mesh, section: str) -> csr_array:
    """Weights (k, m) of the other's nodes at places (k, 2) in its section, nearest if outside."""
    from scipy.sparse import csr_array

    triangles = other.surfaces[section]
    corners = np.concatenate([triangles[:, each] for each in FOUR])
    coordinates = _barycentric(places, other.nodes[corners][:, :, 1:])
    best = coordinates.min(axis=2).argmax(axis=1)
    weights = np.clip(coordinates[np.arange(len(places)), best], 0, None)
    weights /= weights.sum(axis=1, keepdims=True)
    rows = np.repeat(np.arange(len(places)), 3)
    shape = (len(places), len(other.nodes))
    return csr_array((weights.ravel(), (rows, corners[best].ravel())), shape)


def _barycentric(places: Reals, corners: Reals) -> NDArray[np.float64]:
    """Coordinates (k, t, 3) of places (k, 2) in triangles (t, 3, 2)."""
    origin = corners[:, 0]
    sides = np.stack([corners[:, 1] - origin, corners[:, 2] - origin], axis=2)
    inverse = np.linalg.inv(sides)
    two = np.einsum("tij,ktj->kti", inverse, places[:, None, :] - origin[None, :, :])
    return np.concatenate([1 - two.sum(axis=2, keepdims=True), two], axis=2)
