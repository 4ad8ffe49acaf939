"""Mirrored and moved copies of solved bodies as one mesh, whose nodes are shared where they join.

Which nodes two copies share is told by the surface at which the bodies are mirrored, not by how
near nodes come to each other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bellows_design.deformed.joined.motion import Motion
from solver.arrays import Integers, Reals
from solver.mesh.mesh import Mesh

MIRRORED_TRIANGLE = [0, 2, 1, 5, 4, 3]
MIRRORED_TETRAHEDRON = [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]
"""Nodes of a cell in the order that its mirror image needs."""


@dataclass(frozen=True)
class Copy:
    """One copy of a body in the whole.

    ``body``: its number. ``signs``: -1 for each axis along which it is mirrored. ``place``: number
    of the motion that brings it to where it belongs. ``shared``: surface -> number of the earlier
    copy of the same body whose nodes there it uses. ``named``: surface of the body -> its name in
    the whole; others are inside.
    """

    body: int
    signs: tuple[int, int, int]
    place: int
    shared: tuple[tuple[str, int], ...]
    named: Mapping[str, str]

    @property
    def turned_over(self) -> bool:
        """Whether it is a mirror image."""
        return bool(np.prod(self.signs) < 0)


@dataclass(frozen=True)
class Placed:
    """Nodes (n, 3) of each body, mm, and the motions that bring copies to their places."""

    bodies: tuple[Reals, ...]
    places: tuple[Motion, ...]


@dataclass(frozen=True)
class Assembled:
    """How the whole's n nodes and cells follow from those of the bodies.

    ``origin`` (n,): number of each node among those of all bodies, one body after the other;
    ``copy`` (n,): the copy that it belongs to. ``tets`` (e, 10), ``surfaces``: of the whole.
    """

    copies: tuple[Copy, ...]
    origin: NDArray[np.int64]
    copy: NDArray[np.int64]
    tets: Integers
    surfaces: Mapping[str, Integers]

    @staticmethod
    def of(bodies: Sequence[Mesh], copies: Sequence[Copy]) -> Assembled:
        """The whole of ``copies`` of bodies."""
        starts = np.cumsum([0, *(len(body.nodes) for body in bodies)])
        origins, owners, numbers = [], [], list[NDArray[np.int64]]()
        total = 0
        for index, each in enumerate(copies):
            number = _numbered(bodies[each.body], each, numbers)
            own = np.flatnonzero(number < 0)
            number[own] = total + np.arange(len(own))
            total += len(own)
            numbers.append(number)
            origins.append(starts[each.body] + own)
            owners.append(np.full(len(own), index))
        return Assembled(
            tuple(copies),
            np.concatenate(origins),
            np.concatenate(owners),
            _tets(bodies, copies, numbers),
            _surfaces(bodies, copies, numbers),
        )

    def positions(self, placed: Placed, nodes: Integers | None = None) -> Reals:
        """The nodes (n, 3), mm, or some of them, where the bodies and their copies are."""
        chosen = slice(None) if nodes is None else nodes
        origin, copy = self.origin[chosen], self.copy[chosen]
        points = np.concatenate(placed.bodies)[origin] * self._signs[copy]
        cosine, sine, x, z = _table(placed.places)[:, self._places[copy]]
        moved = points.copy()
        moved[:, 0] = cosine * points[:, 0] + sine * points[:, 2] + x
        moved[:, 2] = cosine * points[:, 2] - sine * points[:, 0] + z
        return moved

    def values(self, bodies: Sequence[Reals], nodes: Integers | None = None) -> Reals:
        """Values (n,) at the nodes, or at some of them, from those of the bodies."""
        return np.concatenate(bodies)[self.origin[slice(None) if nodes is None else nodes]]

    @cached_property
    def _signs(self) -> Reals:
        return np.array([each.signs for each in self.copies], float)

    @cached_property
    def _places(self) -> NDArray[np.int64]:
        return np.array([each.place for each in self.copies])


def _table(places: Sequence[Motion]) -> Reals:
    """Cosine, sine and shift of motions, (4, k)."""
    rows = [(np.cos(each.angle), np.sin(each.angle), each.x, each.z) for each in places]
    return np.array(rows).T


def _numbered(body: Mesh, copy: Copy, numbers: Sequence[NDArray[np.int64]]) -> NDArray[np.int64]:
    """Numbers in the whole of a copy's nodes that it shares with earlier ones; -1 for its own."""
    number = np.full(len(body.nodes), -1)
    for surface, other in copy.shared:
        nodes = body.surface_nodes(surface)
        number[nodes] = numbers[other][nodes]
    return number


def _tets(
    bodies: Sequence[Mesh], copies: Sequence[Copy], numbers: Sequence[NDArray[np.int64]]
) -> Integers:
    cells = [
        number[_oriented(bodies[copy.body].tets, copy.turned_over, MIRRORED_TETRAHEDRON)]
        for copy, number in zip(copies, numbers, strict=True)
    ]
    return np.concatenate(cells).astype(np.int32)


def _surfaces(
    bodies: Sequence[Mesh], copies: Sequence[Copy], numbers: Sequence[NDArray[np.int64]]
) -> dict[str, Integers]:
    parts: dict[str, list[NDArray[np.int64]]] = {}
    for copy, number in zip(copies, numbers, strict=True):
        for own, name in copy.named.items():
            triangles = bodies[copy.body].surfaces.get(own, np.empty((0, 6), np.int32))
            turned = _oriented(triangles, copy.turned_over, MIRRORED_TRIANGLE)
            parts.setdefault(name, []).append(number[turned])
    return {name: np.concatenate(each).astype(np.int32) for name, each in parts.items()}


def _oriented(cells: Integers, turned_over: bool, order: list[int]) -> Integers:
    return cells[:, order] if turned_over else cells
