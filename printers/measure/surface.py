"""The boundary of a printed part as one indexed triangle surface."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from printers.arrays import Floats, Ints
from printers.measure.box_tree import BoxTree, build_tree

MERGE_DISTANCE = 1e-5  # mm: above the rounding of a binary STL at 100 mm, far below any feature


@dataclass(frozen=True)
class Surface:
    """Triangles over merged vertices.

    *Shape:* `vertices` (n, 3) mm, `triangles` (m, 3) counted from 0, anticlockwise from outside.
    """

    vertices: Floats
    triangles: Ints

    @cached_property
    def corners(self) -> Floats:
        """(m, 3, 3) mm."""
        return np.asarray(self.vertices[self.triangles])

    @cached_property
    def area_vectors(self) -> Floats:
        """(m, 3): outward normals as long as the triangle's area in mm²."""
        edges = self.corners[:, 1:] - self.corners[:, :1]
        return np.asarray(np.cross(edges[:, 0], edges[:, 1]) / 2)

    @cached_property
    def areas(self) -> Floats:
        """(m,) mm²."""
        return np.asarray(np.linalg.norm(self.area_vectors, axis=1))

    @cached_property
    def normals(self) -> Floats:
        """(m, 3) unit outward normals; zero for triangles without area."""
        return self.area_vectors / np.maximum(self.areas, 1e-300)[:, None]

    @cached_property
    def tree(self) -> BoxTree:
        return build_tree(self.corners)

    @cached_property
    def bounds(self) -> Floats:
        """(2, 3) mm: lower and upper corner."""
        return np.array([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    @cached_property
    def half_edges(self) -> Ints:
        """(3m, 2): edge k of triangle i is row 3i + k, directed along the triangle."""
        return self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)

    @cached_property
    def edge_number(self) -> Ints:
        """(3m,): the number of the undirected edge of every half-edge."""
        ends = np.sort(self.half_edges, axis=1)
        keys = ends[:, 0] * len(self.vertices) + ends[:, 1]
        return np.asarray(np.unique(keys, return_inverse=True)[1])

    @cached_property
    def edge_uses(self) -> Ints:
        """(e,): how many triangles share each undirected edge."""
        return np.bincount(self.edge_number)

    @cached_property
    def edge_balance(self) -> Ints:
        """(e,): how many more triangles run along each edge in one sense than in the other."""
        forward = self.half_edges[:, 0] < self.half_edges[:, 1]
        return np.abs(
            2 * np.bincount(self.edge_number, weights=forward).astype(np.int64) - self.edge_uses
        )

    @property
    def is_closed(self) -> bool:
        """Whether every edge lies between two triangles that run along it in opposite senses."""
        return bool((self.edge_uses == 2).all() and (self.edge_balance == 0).all())

    @cached_property
    def neighbours(self) -> tuple[Ints, Ints, Ints]:
        """Pairs of triangles that share an edge, and the half-edge of the first: three (k,) arrays.

        Where more than two triangles share an edge, consecutive ones are paired.
        """
        order = np.argsort(self.edge_number, kind="stable")
        same = np.flatnonzero(np.diff(self.edge_number[order]) == 0)
        return order[same] // 3, order[same + 1] // 3, order[same]

    @cached_property
    def shell_of_triangle(self) -> Ints:
        """(m,): number of the connected piece of surface every triangle belongs to."""
        return label(len(self.triangles), *self.neighbours[:2])

    def volume(self) -> float:
        """Signed enclosed volume in mm³, by the divergence theorem; negative for a void."""
        return float(np.einsum("ij,ij->", self.corners.mean(axis=1), self.area_vectors) / 3)

    def euler_characteristic(self) -> int:
        """Vertices - edges + triangles; 2 - 2 genus for a closed shell."""
        used = len(np.unique(self.triangles))
        return used - int(self.edge_number.max(initial=-1) + 1) + len(self.triangles)


def label(count: int, first: Ints, second: Ints) -> Ints:
    """Number the connected components of a graph with `count` nodes: (count,)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(first), dtype=np.int8), (first, second)), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def merged_surface(vertices: Floats, triangles: Ints) -> Surface:
    """Join vertices closer than 0.01 µm, as a triangle soup from an STL needs; drop what collapses.

    `vertices` (n, 3) mm, `triangles` (m, 3).
    """
    from scipy.spatial import cKDTree

    distinct, number = np.unique(vertices, axis=0, return_inverse=True)
    pairs = cKDTree(distinct).query_pairs(MERGE_DISTANCE, output_type="ndarray")
    group = label(len(distinct), pairs[:, 0], pairs[:, 1])
    representative = np.unique(group, return_index=True)[1]
    joined = group[number.ravel()][triangles]
    kept = (joined != np.roll(joined, 1, axis=1)).all(axis=1)
    return Surface(distinct[representative], joined[kept])
