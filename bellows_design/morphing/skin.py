"""The surface of a mesh: its nodes, where each lies, and how the ones follow the others."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from bellows_design.morphing.classification import PARALLEL, Places, classified
from bellows_design.morphing.errors import ForeignMesh
from bellows_design.morphing.extension import (
    Extension,
    extension,
    path_stiffness,
    simplex_stiffness,
)
from bellows_design.morphing.primitives import Boxes, Indices
from bellows_design.morphing.projection import projected
from solver import Mesh
from solver.arrays import Reals
from solver.mesh.elements import TRIANGLE_EDGES
from solver.mesh.mid_nodes import SWEEPS


@dataclass(frozen=True)
class Skin:
    """The k nodes on a mesh's surface.

    - ``nodes`` (k,): their numbers in the mesh.
    - ``ends`` (k, 2): for a mid-node the places in ``nodes`` of its edge's ends, else its own.
    - ``share`` (k,): how much of its distance from the straight edge a mid-node kept when elements
      were unfolded; 1 for all that lie on the surface.
    - ``points`` (k, 3): where they would lie with all of it, mm.
    - ``own`` (k, 3): the same projected onto the surfaces in closed form, mm.
    - ``places``: what holds them.
    - ``along_curves``, ``over_faces``: how curves follow corners, and faces follow curves.
    """

    nodes: Indices
    ends: Indices
    share: Reals
    points: Reals
    own: Reals
    places: Places
    along_curves: Extension
    over_faces: Extension

    @classmethod
    def of(cls, boxes: Boxes, mesh: Mesh, parallel: float = PARALLEL) -> Skin:
        """The surface of a mesh of the body that the boxes bound.

        Surfaces that are so ``parallel`` count as one where they meet. Raises
        :class:`ForeignMesh` if a node lies on none of them.
        """
        triangles = mesh.skin
        nodes, local = np.unique(triangles, return_inverse=True)
        local = local.reshape(triangles.shape)
        given, ends = mesh.nodes[nodes], _ends(local, len(nodes))
        points, share = _unrelaxed(boxes, given, ends)
        places = classified(boxes, points, parallel)
        _check_all_found(places, points)
        own, _ = projected(boxes, places, np.arange(len(nodes)), points)
        places, along, over = _followers(boxes, places, own, local[:, :3])
        return cls(nodes, ends, share, points, own, places, along, over)

    def moved(self, other: Boxes, predicted: Reals) -> tuple[Reals, float]:
        """The nodes on the other body (k, 3), mm, and how far they miss its surfaces at most.

        Corners first, then curves between them, then faces between these: the vertices of each
        follow smoothly what bounds it, and mid-nodes the ends of their edges; then they are
        projected onto their own surfaces.
        """
        change, missed = np.zeros_like(self.own), 0.0
        for rows, follow in self._stages(predicted - self.own):
            start = self.own[rows] + follow(change)[rows]
            there, misses = projected(other, self.places, rows, start)
            change[rows] = there - self.own[rows]
            missed = max(missed, float(misses.max(initial=0.0)))
        return self._relaxed(self.points + change), missed

    def _stages(self, prediction: Reals) -> Iterator[tuple[Indices, Callable[[Reals], Reals]]]:
        """Which nodes are moved together, and how much they move at first, given others' change."""
        vertex = self.ends[:, 0] == self.ends[:, 1]
        level = np.where(vertex, self.places.level, 0)
        yield np.flatnonzero(level == 3), lambda _: prediction
        yield np.flatnonzero(level == 2), self.along_curves
        yield np.flatnonzero(level == 1), self.over_faces
        yield (
            np.flatnonzero(~vertex),
            lambda change: (change[self.ends[:, 0]] + change[self.ends[:, 1]]) / 2,
        )

    def _relaxed(self, points: Reals) -> Reals:
        """The points with mid-nodes of elements that were unfolded back at their share."""
        rows = np.flatnonzero(self.share < 1.0)
        straight = points[self.ends[rows]].mean(axis=1)
        points[rows] = straight + self.share[rows, None] * (points[rows] - straight)
        return points


def _ends(triangles: Indices, count: int) -> Indices:
    """The ends of each node's edge, (count, 2); of a vertex itself."""
    ends = np.tile(np.arange(count)[:, None], 2)
    for middle, (a, b) in zip((3, 4, 5), TRIANGLE_EDGES, strict=True):
        ends[triangles[:, middle]] = np.sort(triangles[:, (a, b)], axis=1)
    return ends


def _unrelaxed(boxes: Boxes, given: Reals, ends: Indices) -> tuple[Reals, Reals]:
    """Points where they would lie without unfolding, and their shares.

    Unfolding halves a mid-node's distance from the straight edge again and again, so doubling it
    brings the node back to its surfaces: to as many of those of its edge's ends as possible.
    """
    straight = given[ends].mean(axis=1)
    places = classified(boxes, given)
    conditions = places.conditions(boxes)
    one, two = conditions[ends[:, 0]], conditions[ends[:, 1]]
    common = np.where((one & two).any(axis=1, keepdims=True), one & two, one | two)
    points, share = given.copy(), np.ones(len(given))
    best = (conditions & common).sum(axis=1)
    bent = np.linalg.norm(given - straight, axis=1) > 1e-9
    rows = np.flatnonzero(bent & (best < common.sum(axis=1)))
    for halvings in range(1, SWEEPS + 1):
        tried = straight[rows] + 2.0**halvings * (given[rows] - straight[rows])
        found = (classified(boxes, tried).conditions(boxes) & common[rows]).sum(axis=1)
        better = found > best[rows]
        points[rows[better]], share[rows[better]] = tried[better], 0.5**halvings
        best[rows] = np.maximum(best[rows], found)
    return points, share


def _check_all_found(places: Places, points: Reals) -> None:
    lost = np.flatnonzero(places.level == 0)
    if len(lost):
        x, y, z = points[lost[0]]
        raise ForeignMesh(
            f"{len(lost)} nodes of the mesh lie on no surface of the design, the first one at "
            f"({x:.4g}, {y:.4g}, {z:.4g}) mm: it is a mesh of another body"
        )


def _followers(
    boxes: Boxes, places: Places, points: Reals, triangles: Indices
) -> tuple[Places, Extension, Extension]:
    """Extensions from corners to curves, and from curves to faces.

    The points of a curve without corners count as corners.
    """
    edges = _edges(triangles)
    joint = places.shared(boxes, edges[:, 0], edges[:, 1]) >= 2
    along = edges[joint & (places.level[edges] >= 2).all(axis=1)]
    places = replace(places, level=_with_corners(places.level, along))
    vertex = np.zeros(len(points), bool)
    vertex[triangles] = True
    corner, curve = vertex & (places.level == 3), vertex & (places.level >= 2)
    return (
        places,
        extension(path_stiffness(points, along), corner, curve),
        extension(simplex_stiffness(points, triangles), curve & vertex, vertex),
    )


def _with_corners(level: Indices, along: Indices) -> Indices:
    """Levels with those of curves that no corner ends raised to corners."""
    count = len(level)
    graph = csr_matrix((np.ones(len(along)), (along[:, 0], along[:, 1])), shape=(count, count))
    _, part = connected_components(graph, directed=False)
    ended = np.bincount(part, level == 3) > 0
    return np.where((level == 2) & ~ended[part], 3, level)


def _edges(triangles: Indices) -> Indices:
    """The edges of triangles (k, 3), each once, (j, 2)."""
    pairs = np.concatenate([triangles[:, edge] for edge in TRIANGLE_EDGES])
    return np.unique(np.sort(pairs, axis=1), axis=0)
