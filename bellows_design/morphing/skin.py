"""The surface of a mesh: its nodes, where each lies, and how the ones follow the others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError
from bellows_design.morphing.classification import Places, classified
from bellows_design.morphing.extension import (
    Extension,
    extension,
    path_stiffness,
    simplex_stiffness,
)
from bellows_design.morphing.primitives import Boxes
from bellows_design.morphing.projection import projected
from solver import Mesh
from solver.arrays import Integers, Reals
from solver.mesh.mid_nodes import SWEEPS

FACETS = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))


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

    nodes: Integers
    ends: NDArray[np.int64]
    share: Reals
    points: Reals
    own: Reals
    places: Places
    along_curves: Extension
    over_faces: Extension

    @classmethod
    def of(cls, boxes: Boxes, mesh: Mesh) -> Skin:
        """The surface of a mesh of the body that the boxes bound.

        Raises ``BellowsError`` if one of its nodes lies on none of them.
        """
        triangles = mesh.triangles(*mesh.surfaces)
        nodes, local = np.unique(triangles, return_inverse=True)
        local = local.reshape(triangles.shape)
        given, ends = mesh.nodes[nodes], _ends(local, len(nodes))
        points, share, places = _unrelaxed(boxes, given, ends)
        _check_all_found(places, points)
        own, _ = projected(boxes, places, np.arange(len(nodes)), points)
        along, over = _followers(boxes, places, own, local)
        return cls(nodes, ends, share, points, own, places, along, over)

    def moved(self, own: Boxes, other: Boxes, predicted: Reals) -> tuple[Reals, float]:
        """The nodes on the other body (k, 3), mm, and how far they miss its surfaces at most.

        Corners first, then curves between them, then faces between these: each follows smoothly
        what bounds it and is projected onto its own surfaces.
        """
        level, missed = self.places.level, 0.0
        change = np.zeros_like(self.own)
        steps = ((3, lambda _: predicted - self.own), (2, self.along_curves), (1, self.over_faces))
        for rank, follow in steps:
            rows = np.flatnonzero(level == rank)
            start = self.own[rows] + follow(change)[rows]
            there, misses = projected(other, self.places, rows, start)
            change[rows] = there - self.own[rows]
            missed = max(missed, float(misses.max(initial=0.0)))
        return self._relaxed(self.points + change), missed

    def _relaxed(self, points: Reals) -> Reals:
        """The points with mid-nodes of elements that were unfolded back at their share."""
        straight = points[self.ends].mean(axis=1)
        return np.where(
            self.share[:, None] == 1.0, points, straight + self.share[:, None] * (points - straight)
        )


def _ends(triangles: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """The ends of each node's edge, (count, 2); of a vertex itself."""
    ends = np.tile(np.arange(count)[:, None], 2)
    for middle, (a, b) in zip((3, 4, 5), ((0, 1), (1, 2), (2, 0)), strict=True):
        ends[triangles[:, middle]] = np.sort(triangles[:, (a, b)], axis=1)
    return ends


def _unrelaxed(
    boxes: Boxes, given: Reals, ends: NDArray[np.int64]
) -> tuple[Reals, Reals, Places]:
    """Points where they would lie without unfolding, their shares, and their places.

    Unfolding halves a mid-node's distance from the straight edge again and again, so doubling it
    brings the node back to its surfaces: to as many of those of its edge's ends as possible.
    """
    straight = given[ends].mean(axis=1)
    places, count = classified(boxes, given), len(boxes.radius)
    conditions = places.conditions(count)
    common = conditions[ends[:, 0]] & conditions[ends[:, 1]]
    points, share = given.copy(), np.ones(len(given))
    best = (conditions & common).sum(axis=1)
    bent = np.linalg.norm(given - straight, axis=1) > 1e-9
    rows = np.flatnonzero(bent & (best < common.sum(axis=1)))
    for halvings in range(1, SWEEPS + 1):
        tried = straight[rows] + 2.0**halvings * (given[rows] - straight[rows])
        found = (classified(boxes, tried).conditions(count) & common[rows]).sum(axis=1)
        better = found > best[rows]
        points[rows[better]], share[rows[better]] = tried[better], 0.5**halvings
        best[rows] = np.maximum(best[rows], found)
    return points, share, classified(boxes, points)


def _check_all_found(places: Places, points: Reals) -> None:
    lost = np.flatnonzero(places.level == 0)
    if len(lost):
        x, y, z = points[lost[0]]
        raise BellowsError(
            f"{len(lost)} nodes of the mesh lie on no surface of the design, the first one at "
            f"({x:.4g}, {y:.4g}, {z:.4g}) mm: it is a mesh of another body"
        )


def _followers(
    boxes: Boxes, places: Places, points: Reals, triangles: NDArray[np.int64]
) -> tuple[Extension, Extension]:
    """Extensions from corners to curves, and from curves to faces."""
    corner, curve = places.level == 3, places.level >= 2
    edges = _edges(triangles)
    conditions = places.conditions(len(boxes.radius))
    joint = (conditions[edges[:, 0]] & conditions[edges[:, 1]]).sum(axis=1) >= 2
    along = edges[joint & curve[edges].all(axis=1)]
    facets = np.concatenate([triangles[:, part] for part in FACETS])
    return (
        extension(path_stiffness(points, along), corner, curve),
        extension(simplex_stiffness(points, facets), curve, np.ones(len(points), bool)),
    )


def _edges(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Both halves of the edges of six-node triangles, each once, (k, 2)."""
    halves = ((0, 3), (3, 1), (1, 4), (4, 2), (2, 5), (5, 0))
    pairs = np.concatenate([triangles[:, half] for half in halves])
    return np.unique(np.sort(pairs, axis=1), axis=0)
