"""Root and tip of a bubble without neighbours, which was solved without them: stubs of its section.

A stub is the section in the gap's middle drawn out along the plane's normal, and plugged where the
channel ends. It moves with the plane; what the section does in it fades out towards the stub's end.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bellows_design.deformed.joined.copies import MIRRORED_TETRAHEDRON
from bellows_design.geometry.face_names import CAVITY, GAP_MIDDLE, OUTSIDE, SYMMETRY
from solver.arrays import Integers, Reals
from solver.mesh.elements import TETRAHEDRON_EDGES, TRIANGLE_EDGES
from solver.mesh.faces import FACES
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array


@dataclass(frozen=True)
class Stub:
    """A body with a stub behind its gap's middle.

    ``mesh``: of both, undeformed; its new nodes come last. ``weights`` (n, m): which of the m nodes
    of the body each node follows. ``beyond`` (n,): how far it lies behind the plane,
    mm; ``rigid`` (n,): how much of its motion is the plane's, from 0 at the plane to 1 at the end.
    """

    mesh: Mesh
    weights: csr_array
    beyond: Reals
    rigid: Reals


NO_KIND, *KINDS = ("", OUTSIDE, CAVITY, SYMMETRY)
"""What an edge of the section lies on."""


@dataclass(frozen=True)
class _Section:
    """The section, with normals out of the body.

    ``wall`` (k, 6) and ``hole`` (j, 6): triangles of the material and of the channel's opening.
    Their nodes are numbered as in the body; one in the middle of the hole, and those on the lines
    to it, follow. ``weights`` (n, m): the body's nodes that each is the mean of. ``kinds`` (n,): of
    mid-nodes, the place in ``KINDS`` of what their edge lies on, from 1; else 0.
    """

    wall: Integers
    hole: Integers
    weights: csr_array
    kinds: NDArray[np.int8]


def with_stub(mesh: Mesh, open_length: float, plug: float, end: str) -> Stub:
    """The body with its channel going on for ``open_length``, then a ``plug`` (mm).

    ``end``: name of the surface that ends it. Without an ``open_length`` the plug closes the
    channel in the middle of the gap.
    """
    section = _section(mesh)
    lengths = [open_length, plug] if open_length > 0 else [plug]
    layers = [section.wall] * len(lengths)
    layers[-1] = np.concatenate([section.wall, section.hole])
    size = section.weights.shape[0]
    tets = np.concatenate([_prisms(each, 2 * n * size, size) for n, each in enumerate(layers)])
    depths = np.interp(np.arange(2 * len(lengths) + 1) / 2, *_levels(lengths))
    return _joined(mesh, section, depths, tets, _faces(tets, section, len(depths) - 1, end))


def _levels(lengths: list[float]) -> tuple[NDArray[np.int64], Reals]:
    depths = np.cumsum([0.0, *lengths])
    return np.arange(len(depths)), depths


def _section(mesh: Mesh) -> _Section:
    from scipy.sparse import csr_array, eye_array, vstack

    wall, count = mesh.surfaces[GAP_MIDDLE], len(mesh.nodes)
    edges = np.concatenate([wall[:, [a, b, 3 + n]] for n, (a, b) in enumerate(TRIANGLE_EDGES)])
    rim = edges[np.isin(edges[:, 2], mesh.surface_nodes(CAVITY))]
    corners, spokes = np.unique(rim[:, :2], return_inverse=True)
    spokes = count + 1 + spokes.reshape(-1, 2)
    centre = np.full(len(rim), count)
    hole = np.column_stack([rim[:, 1], rim[:, 0], centre, rim[:, 2], spokes[:, 0], spokes[:, 1]])
    ends = np.isin(corners, mesh.surface_nodes(SYMMETRY))
    middle = csr_array((ends / ends.sum(), (np.zeros(len(ends), int), corners)), (1, count))
    same = eye_array(count, format="csr")
    halfway = (same[corners] + vstack([middle] * len(corners))) / 2
    kinds = np.zeros(count + 1 + len(corners), np.int8)
    for number, name in enumerate(KINDS, start=1):
        kinds[np.intersect1d(edges[:, 2], mesh.surface_nodes(name))] = number
    kinds[count + 1 + np.flatnonzero(ends)] = 1 + KINDS.index(SYMMETRY)
    return _Section(wall, hole.astype(np.int32), vstack([same, middle, halfway]).tocsr(), kinds)


PARTS = (
    ((0, 0), (1, 0), (2, 0), (2, 1)),
    ((0, 0), (1, 0), (2, 1), (1, 1)),
    ((0, 0), (0, 1), (1, 1), (2, 1)),
)
"""Tetrahedra of a prism: corners of its triangles, in ascending order of their numbers; levels."""

MIDDLES = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
"""Node of a six-node triangle between two of its corners, or at one."""


def _prisms(triangles: Integers, first: int, size: int) -> NDArray[np.int64]:
    """Tetrahedra (3 k, 10) of triangles (k, 6) drawn out by one level, which is two half ones.

    A node is numbered by that of the section, plus ``size`` for each half level, plus ``first``.
    Neighbours split their common side alike, by the numbers of its nodes.
    """
    order = np.argsort(triangles[:, :3], axis=1)
    turned_over = (order[:, [1, 2, 0]] - order) % 3 == 2
    rows = np.arange(len(triangles))

    def node(one: tuple[int, int], other: tuple[int, int]) -> NDArray[np.int64]:
        column = MIDDLES[order[:, one[0]], order[:, other[0]]]
        return first + triangles[rows, column].astype(np.int64) + size * (one[1] + other[1])

    cells = []
    for part in PARTS:
        pairs = [
            *((each, each) for each in part),
            *((part[a], part[b]) for a, b in TETRAHEDRON_EDGES),
        ]
        tets = np.column_stack([node(*pair) for pair in pairs])
        cells.append(np.where(turned_over[:, :1], tets[:, MIRRORED_TETRAHEDRON], tets))
    return np.concatenate(cells)


def _faces(
    tets: NDArray[np.int64], section: _Section, last: int, end: str
) -> dict[str, NDArray[np.int64]]:
    """What bounds the stub, but for the section it begins at: name -> triangles (k, 6)."""
    size, wall = section.weights.shape[0], section.weights.shape[1]
    faces = np.concatenate([tets[:, _with_middles(face)] for face in FACES])
    keys = np.sort(faces[:, :3], axis=1)
    _, first, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
    outer = faces[first[counts == 1]]
    level, node = outer // size, outer % size
    flat = (level[:, :3] == level[:, :1]).all(axis=1)
    begins = flat & (level[:, 0] == 0) & (node[:, :3] < wall).all(axis=1)
    ends = flat & (level[:, 0] == last)
    kinds = np.where(flat, 1 + KINDS.index(CAVITY), section.kinds[node[:, 3:]].max(axis=1))
    kinds[begins | ends] = 0
    named = {name: outer[kinds == number] for number, name in enumerate(KINDS, start=1)}
    return {**named, end: outer[ends]}


def _with_middles(face: tuple[int, int, int]) -> list[int]:
    """The six nodes of a ten-node tetrahedron's face."""
    edges = [set(edge) for edge in TETRAHEDRON_EDGES]
    middles = (edges.index({face[a], face[b]}) for a, b in TRIANGLE_EDGES)
    return [*face, *(4 + middle for middle in middles)]


def _joined(
    mesh: Mesh,
    section: _Section,
    depths: Reals,
    tets: NDArray[np.int64],
    faces: dict[str, NDArray[np.int64]],
) -> Stub:
    """Body and stub as one, with numbers from 0."""
    from scipy.sparse import eye_array, vstack

    size, count = section.weights.shape
    used = np.unique(tets)
    new = used[(used >= size) | (used % size >= count)]
    numbers = np.zeros(size * len(depths), np.int64)
    numbers[:count], numbers[new] = np.arange(count), count + np.arange(len(new))
    weights = vstack([eye_array(count, format="csr"), section.weights[new % size]]).tocsr()
    beyond = np.concatenate([np.zeros(count), depths[new // size]])
    nodes = weights @ mesh.nodes
    nodes[:, 0] += beyond
    surfaces = {name: each for name, each in mesh.surfaces.items() if name != GAP_MIDDLE}
    for name, each in faces.items():
        both = [surfaces.get(name, np.empty((0, 6), np.int32)), numbers[each]]
        surfaces[name] = np.concatenate(both).astype(np.int32)
    every = np.concatenate([mesh.tets, numbers[tets]]).astype(np.int32)
    return Stub(Mesh(nodes, every, surfaces), weights, beyond, beyond / depths[-1])
