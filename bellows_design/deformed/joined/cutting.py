"""A mesh of quadratic tetrahedra cut at a plane x = constant, exactly.

Tetrahedra across the plane are split at their edges, one edge after the other in the order of the
edges' numbers, so that neighbours split a common face alike. A piece of a tetrahedron takes its
mid-nodes from the quadratic map of the whole one and so fills the same place: volumes and
displacements stay what they are. Nodes of the pieces are linear combinations of those of the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.mesh.elements import TETRAHEDRON_EDGES, TRIANGLE_EDGES, quadratic_shapes
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array

SECTION = "section"
"""Surface of a piece where it was cut."""

ON_PLANE = 1e-3
"""Of a mean edge. Nodes nearer to the plane count as on it: less would leave needles."""

BISECTIONS = 50


@dataclass(frozen=True)
class Piece:
    """What lies on one side of the plane.

    ``mesh``: with the surfaces of the whole, as far as they reach, and ``section``, whose normals
    point out. ``positions`` (n, m) and ``values`` (n, m): its nodes' vectors and scalars from those
    of the whole's m nodes; the former follow the quadratic map, the latter are averages with
    positive weights, so that they keep the bounds of what they are of.
    """

    mesh: Mesh
    positions: csr_array
    values: csr_array

    @staticmethod
    def whole(mesh: Mesh) -> Piece:
        """All of a mesh."""
        from scipy.sparse import eye_array

        same = eye_array(len(mesh.nodes), format="csr")
        return Piece(mesh, same, same)

    def of(self, former: Piece) -> Piece:
        """This piece of a ``former`` one, as a piece of what that is a piece of."""
        return Piece(self.mesh, self.positions @ former.positions, self.values @ former.values)


@dataclass(frozen=True)
class _Points:
    """Nodes of a mesh and cut points on its edges: ``ends`` (k, 2), ``middles`` (k,), ``at`` (k,)
    the share of the way from one end to the other. Numbers of cut points follow those of nodes.
    ``sides`` (n + k,): -1 and 1, and 0 on the plane.
    """

    nodes: int
    ends: Integers
    middles: Integers
    at: Reals
    sides: NDArray[np.int8]


def cut(mesh: Mesh, x: float, section: str = SECTION) -> tuple[Piece, Piece]:
    """The pieces of ``mesh`` before and behind the plane at ``x``, mm. Regions are not kept."""
    points = _points(mesh, x)
    return _piece(mesh, points, -1, section), _piece(mesh, points, 1, section)


def _points(mesh: Mesh, x: float) -> _Points:
    """The nodes with their sides, and the cut points of all edges across the plane."""
    heights = mesh.nodes[:, 0] - x
    sides = np.where(np.abs(heights) < ON_PLANE * mesh.edge, 0, np.sign(heights)).astype(np.int8)
    edges = np.concatenate([mesh.tets[:, [a, b, 4 + i]] for i, (a, b) in _numbered()])
    edges[:, :2] = np.sort(edges[:, :2], axis=1)
    edges = edges[sides[edges[:, 0]] * sides[edges[:, 1]] < 0]
    ends = np.unique(edges, axis=0)  # ascending, as the numbers of the cut points
    at = _roots(*heights[ends].T)
    return _Points(
        len(mesh.nodes),
        ends[:, :2],
        ends[:, 2],
        at,
        np.concatenate([sides, np.zeros(len(ends), np.int8)]),
    )


def _numbered() -> enumerate[tuple[int, int]]:
    return enumerate(TETRAHEDRON_EDGES)


def _roots(first: Reals, second: Reals, middle: Reals) -> Reals:
    """Where quadratics through values at 0, 1 and 1/2, of both signs at the ends, vanish."""
    low, high = np.zeros(len(first)), np.ones(len(first))
    for _ in range(BISECTIONS):
        t = (low + high) / 2
        value = first * (1 - t) * (1 - 2 * t) + second * t * (2 * t - 1) + 4 * middle * t * (1 - t)
        before = value * first > 0
        low, high = np.where(before, t, low), np.where(before, high, t)
    roots: Reals = (low + high) / 2
    return roots


@dataclass(frozen=True)
class _Cells:
    """Simplices: ``corners`` (e, d + 1), points; ``parents`` (e,): what each is a part of."""

    corners: Integers
    parents: NDArray[np.int64]


def _split(cells: _Cells, points: _Points) -> _Cells:
    """The cells, split until none is across the plane."""
    while True:
        pairs = _crossing(cells.corners, points)
        across = pairs.min(axis=1) < len(points.ends)
        if not across.any():
            return cells
        corners, cut = cells.corners[across], pairs[across].min(axis=1)
        new = (points.nodes + cut).astype(corners.dtype)[:, None]
        halves = [
            np.where(corners == points.ends[cut, end][:, None], new, corners) for end in (0, 1)
        ]
        cells = _Cells(
            np.concatenate([cells.corners[~across], *halves]),
            np.concatenate([cells.parents[~across], *[cells.parents[across]] * 2]),
        )


def _crossing(corners: Integers, points: _Points) -> NDArray[np.int64]:
    """Numbers of the cut points on each edge of cells (e, d + 1); too large where there is none."""
    size = corners.shape[1]
    pairs = [(a, b) for a in range(size) for b in range(a + 1, size)]
    keys = points.ends[:, 0].astype(np.int64) * points.nodes + points.ends[:, 1]
    found = np.full((len(corners), len(pairs)), len(keys))
    for column, (a, b) in enumerate(pairs):
        ends = np.sort(corners[:, [a, b]], axis=1).astype(np.int64)
        across = points.sides[ends[:, 0]] * points.sides[ends[:, 1]] < 0
        wanted = ends[across, 0] * points.nodes + ends[across, 1]
        found[across, column] = np.searchsorted(keys, wanted)
    return found


def _piece(mesh: Mesh, points: _Points, side: int, section: str) -> Piece:
    """What lies on one side."""
    every = np.arange(len(mesh.tets))
    cells = _on(side, _split(_Cells(mesh.tets[:, :4], every), points), points)
    middles = _Middles.of(mesh, cells, points)
    tets = middles.completed(cells.corners, TETRAHEDRON_EDGES)
    surfaces = _surfaces(mesh, points, side, section, _section(cells.corners, points))
    named = {name: middles.completed(each, TRIANGLE_EDGES) for name, each in surfaces.items()}
    return _compact(mesh, tets, named, *_combinations(mesh, points, middles))


def _surfaces(
    mesh: Mesh, points: _Points, side: int, section: str, faces: Integers
) -> dict[str, Integers]:
    """Triangles (k, 3) of the surfaces on one side, and of the section.

    ``faces`` (k, 3): of the piece in the plane, some of which may lie on a surface of the mesh.
    """
    surfaces = {}
    for name in mesh.surfaces.keys() - {section}:
        triangles = mesh.surfaces[name][:, :3]
        corners = _split(_Cells(triangles, np.arange(len(triangles))), points).corners
        beside = (points.sides[corners] == side).any(axis=1)
        flat = (points.sides[corners] == 0).all(axis=1)
        surfaces[name] = corners[beside | (flat & _among(corners, faces))]
    known = np.concatenate([*surfaces.values(), np.empty((0, 3), np.int32)])
    return {**surfaces, section: faces[~_among(faces, known)]}


def _on(side: int, cells: _Cells, points: _Points) -> _Cells:
    """Those on one side of the plane, not flat in it."""
    there = (points.sides[cells.corners] == side).any(axis=1)
    return _Cells(cells.corners[there], cells.parents[there])


def _among(faces: Integers, others: Integers) -> NDArray[np.bool_]:
    """Which faces (k, 3) are the same as one of the others (j, 3)."""
    both = np.sort(np.concatenate([faces, others]), axis=1)
    _, numbers = np.unique(both, axis=0, return_inverse=True)
    numbers = numbers.reshape(-1)
    return np.isin(numbers[: len(faces)], numbers[len(faces) :])


def _section(corners: Integers, points: _Points) -> Integers:
    """Faces (k, 3) of tetrahedra in the plane, with normals out of them."""
    from solver.mesh.faces import FACES

    faces = np.concatenate([corners[:, face] for face in FACES])
    return faces[(points.sides[faces] == 0).all(axis=1)]


@dataclass(frozen=True)
class _Middles:
    """Mid-nodes of the edges of cells: those of the mesh, and new ones.

    ``keys`` (k,): of the edges, ascending, ``numbers`` (k,): their mid-nodes. ``ends`` (j, 2):
    points between which the new ones lie; ``parents`` (j,): a tetrahedron each of them is in.
    """

    size: int
    keys: NDArray[np.int64]
    numbers: NDArray[np.int64]
    ends: Integers
    parents: NDArray[np.int64]

    @staticmethod
    def of(mesh: Mesh, cells: _Cells, points: _Points) -> _Middles:
        """Those of all edges of ``cells``."""
        size = points.nodes + len(points.ends)
        pairs = [list(edge) for edge in TETRAHEDRON_EDGES]
        ends = np.sort(np.concatenate([cells.corners[:, pair] for pair in pairs]), axis=1)
        keys, first = np.unique(_keys(ends, size), return_index=True)
        ends, parents = ends[first], np.tile(cells.parents, len(pairs))[first]
        known, middles = _known_middles(mesh, size)
        place = np.minimum(np.searchsorted(known, keys), len(known) - 1)
        new = known[place] != keys
        numbers = middles[place].astype(np.int64)
        numbers[new] = size + np.arange(new.sum())
        return _Middles(size, keys, numbers, ends[new], parents[new])

    def completed(self, corners: Integers, edges: tuple[tuple[int, int], ...]) -> Integers:
        """Cells with the mid-nodes of their ``edges`` behind their corners."""
        keys = [_keys(np.sort(corners[:, list(edge)], axis=1), self.size) for edge in edges]
        middles = [self.numbers[np.searchsorted(self.keys, each)] for each in keys]
        return np.column_stack([corners, *middles])


def _keys(ends: Integers, size: int) -> NDArray[np.int64]:
    """One number for each edge (k, 2), its ends in ascending order."""
    keys: NDArray[np.int64] = ends[:, 0].astype(np.int64) * size + ends[:, 1]
    return keys


def _known_middles(mesh: Mesh, size: int) -> tuple[NDArray[np.int64], Integers]:
    """Keys of the mesh's edges, ascending, and their mid-nodes."""
    edges = np.concatenate([mesh.tets[:, [a, b, 4 + i]] for i, (a, b) in _numbered()])
    keys, first = np.unique(_keys(np.sort(edges[:, :2], axis=1), size), return_index=True)
    return keys, edges[first, 2]


def _combinations(mesh: Mesh, points: _Points, middles: _Middles) -> tuple[csr_array, csr_array]:
    """How positions and values at nodes, cut points and new mid-nodes follow from the nodes."""
    from scipy.sparse import csr_array, eye_array, vstack

    t, nodes, count = points.at, points.nodes, len(points.ends)
    line = np.column_stack([points.ends, points.middles])
    rows = np.repeat(np.arange(count), 3)

    def on_edges(weights: Reals) -> csr_array:
        return csr_array((weights.ravel(), (rows, line.ravel())), (count, nodes))

    curved = np.column_stack([(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)])
    bent = np.column_stack(
        [np.maximum(0, 1 - 2 * t), np.maximum(0, 2 * t - 1), 1 - np.abs(1 - 2 * t)]
    )
    corner_values = vstack([eye_array(nodes), on_edges(bent)]).tocsr()
    means = (corner_values[middles.ends[:, 0]] + corner_values[middles.ends[:, 1]]) / 2
    inside = _in_tetrahedra(mesh, points, middles)
    positions = vstack([eye_array(nodes), on_edges(curved), inside]).tocsr()
    return positions, vstack([corner_values, means]).tocsr()


def _in_tetrahedra(mesh: Mesh, points: _Points, middles: _Middles) -> csr_array:
    """The new mid-nodes by the quadratic map of the tetrahedra that they are in."""
    from scipy.sparse import csr_array

    parents = mesh.tets[middles.parents]
    places = sum(_barycentric(parents, points, middles.ends[:, end]) for end in (0, 1)) / 2
    weights = quadratic_shapes(np.asarray(places), TETRAHEDRON_EDGES)
    rows = np.repeat(np.arange(len(parents)), 10)
    shape = (len(parents), points.nodes)
    return csr_array((weights.ravel(), (rows, parents.ravel())), shape)


def _barycentric(parents: Integers, points: _Points, which: Integers) -> Reals:
    """Coordinates (k, 4) of a point each in a tetrahedron (k, 10) that it is a corner or cut of."""
    corners, own = parents[:, :4], which < points.nodes
    at = (corners == which[:, None]).astype(float)
    cut = which[~own] - points.nodes
    t = points.at[cut][:, None]
    first, second = (corners[~own] == points.ends[cut, end][:, None] for end in (0, 1))
    at[~own] = (1 - t) * first + t * second
    return at


def _compact(
    mesh: Mesh,
    tets: Integers,
    surfaces: dict[str, Integers],
    positions: csr_array,
    values: csr_array,
) -> Piece:
    """The piece with its own nodes only."""
    used = np.unique(tets)
    renumber = np.zeros(positions.shape[0], np.int64)
    renumber[used] = np.arange(len(used))
    positions, values = positions[used], values[used]
    own = renumber[tets].astype(np.int32)
    named = {name: renumber[each].astype(np.int32) for name, each in surfaces.items()}
    return Piece(Mesh(positions @ mesh.nodes, own, named), positions, values)
