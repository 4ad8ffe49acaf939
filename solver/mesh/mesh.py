"""Quadratic tetrahedral meshes with named surfaces."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.input_types import mapping, shown
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.faces import lie_outside, outer_faces


@dataclass(frozen=True)
class Mesh:
    """Ten-node tetrahedra, straight or curved, and named six-node triangles on their faces.

    All arrays are read-only views of the given ones.

    Attributes:
        nodes: reference coordinates.

            *Shape:* (n, 3) in mm.
        tets: node numbers in Gmsh's order: four vertices, then the mid-nodes of the edges (0, 1)
            (1, 2) (0, 2) (0, 3) (2, 3) (1, 3).

            *Shape:* (e, 10).
        surfaces: name -> node numbers of triangles in Gmsh's order: three vertices, then the
            mid-nodes of (0, 1) (1, 2) (2, 0); normals point out of the solid.

            *Shape:* (k, 6) each.
        regions: name -> numbers of tetrahedra; those in none make the rest.

            *Shape:* (k,) each.

    Raises:
        SolverError: a shape is wrong, a coordinate is not finite, or a node number is out of range.
    """

    nodes: Reals
    tets: Integers
    surfaces: Mapping[str, Integers] = field(default_factory=dict)
    regions: Mapping[str, Integers] = field(default_factory=dict)

    def __post_init__(self) -> None:
        nodes = _table("nodes", self.nodes, 3, np.float64)
        if not np.isfinite(nodes).all():
            raise SolverError("mesh: nodes must be finite numbers in mm, found NaN or infinity.")
        given = mapping("mesh: surfaces", self.surfaces, "name -> triangles")
        surfaces = {
            name: _table(f"surface {name!r}", triangles, 6, np.int32)
            for name, triangles in given.items()
        }
        tets = _table("tets", self.tets, 10, np.int32)
        for name, table in {"tets": tets, **surfaces}.items():
            _check_range(name, table, len(nodes))
        object.__setattr__(self, "nodes", nodes)
        object.__setattr__(self, "tets", tets)
        object.__setattr__(self, "surfaces", MappingProxyType(surfaces))
        object.__setattr__(self, "regions", MappingProxyType(dict(self.regions)))

    @cached_property
    def vertices(self) -> Integers:
        """Sorted numbers of the nodes at corners of tetrahedra; they carry the pressure. (v,)"""
        return np.unique(self.tets[:, :4])

    @cached_property
    def tet_vertices(self) -> Integers:
        """The corners of each tetrahedron as positions in ``vertices``. (e, 4)"""
        return np.searchsorted(self.vertices, self.tets[:, :4]).astype(np.int32)

    @cached_property
    def outer_faces(self) -> NDArray[np.int64]:
        """Keys (k,) of the faces of one tetrahedron only, see ``solver.mesh.faces``.

        Raises ``SolverError`` if more than two tetrahedra share a face.
        """
        return outer_faces(self.nodes, self.tets)

    @cached_property
    def boundary_surfaces(self) -> frozenset[str]:
        """Names of the surfaces that have triangles, all of them ``outer_faces``."""
        outer, size = self.outer_faces, len(self.nodes)
        return frozenset(
            name
            for name, triangles in self.surfaces.items()
            if len(triangles) and lie_outside(triangles, self.tets, outer, size)
        )

    @property
    def size(self) -> float:
        """Diagonal of the bounding box, mm."""
        return float(np.linalg.norm(np.ptp(self.nodes, axis=0)))

    @cached_property
    def edge(self) -> float:
        """Mean length of the tetrahedra's edges, mm; 0 without any."""
        a, b = (
            self.nodes[self.tets[:, list(ends)]] for ends in zip(*TETRAHEDRON_EDGES, strict=True)
        )
        return float(np.linalg.norm(a - b, axis=2).mean()) if len(self.tets) else 0.0

    def moved(self, nodes: Reals) -> Mesh:
        """The same tetrahedra and surfaces with nodes elsewhere.

        Args:
            nodes: their new reference coordinates.

                *Shape:* (n, 3) in mm.

        Raises:
            SolverError: another number of nodes, or a coordinate that is not finite.
        """
        if np.shape(nodes) != self.nodes.shape:
            raise SolverError(
                f"mesh: moved nodes must have the shape {self.nodes.shape}, got {np.shape(nodes)}."
            )
        other = replace(self, nodes=nodes)
        known = {name: self.__dict__[name] for name in CONNECTIVITY if name in self.__dict__}
        other.__dict__.update(known)
        return other

    def with_surfaces(self, surfaces: Mapping[str, Integers]) -> Mesh:
        """The same mesh with more named surfaces, or others of the same names.

        Args:
            surfaces: name -> node numbers of triangles as in ``surfaces``.

        Raises:
            SolverError: a table of another shape, or a node number out of range.
        """
        other = replace(self, surfaces={**self.surfaces, **surfaces})
        kept = (name for name in CONNECTIVITY if name != "boundary_surfaces")
        other.__dict__.update({name: self.__dict__[name] for name in kept if name in self.__dict__})
        return other

    @property
    def skin(self) -> Integers:
        """All triangles (k, 6) of the named surfaces, each once."""
        triangles = self.triangles(*self.surfaces)
        _, first = np.unique(triangles, axis=0, return_index=True)
        return triangles[np.sort(first)]

    def triangles(self, *names: str) -> Integers:
        """All six-node triangles of the named surfaces, (k, 6); ``SolverError`` if unknown."""
        for name in names:
            if not isinstance(name, str) or name not in self.surfaces:
                known = ", ".join(sorted(self.surfaces)) or "none"
                raise SolverError(f"mesh: no surface is called {name!r}; known surfaces: {known}.")
        parts = [self.surfaces[name] for name in names]
        return np.concatenate([np.empty((0, 6), np.int32), *parts])

    def surface_nodes(self, *names: str) -> Integers:
        """Sorted unique node numbers of the named surfaces; ``SolverError`` if one is unknown."""
        return np.unique(self.triangles(*names))


CONNECTIVITY = ("vertices", "tet_vertices", "outer_faces", "boundary_surfaces")
"""Properties of a mesh that do not depend on where its nodes are."""


def _table(name: str, values: ArrayLike, width: int, dtype: DTypeLike) -> NDArray[Any]:
    array = _numbers(name, values, dtype).view()
    if array.ndim != 2 or array.shape[1] != width:
        raise SolverError(f"mesh: {name} must have the shape (n, {width}), got {array.shape}.")
    array.flags.writeable = False
    return array


def _numbers(name: str, values: ArrayLike, dtype: DTypeLike) -> NDArray[Any]:
    """Values as an array; ``SolverError`` if they are no numbers, or no whole ones of nodes."""
    try:
        given = np.asarray(values)
        if given.dtype.kind == "c":
            raise ValueError
        with np.errstate(invalid="ignore"):  # NaN is no whole number, which is found below
            array = np.ascontiguousarray(given, dtype=dtype)
        if given.dtype.kind == "f" and array.dtype.kind == "i" and (array != given).any():
            raise ValueError
    except (TypeError, ValueError):
        kind = "whole numbers of nodes" if dtype is np.int32 else "numbers in mm"
        raise SolverError(f"mesh: {name} must be {kind}, got {shown(values)}.") from None
    return array


def _check_range(name: str, table: Integers, number_of_nodes: int) -> None:
    if table.size and not 0 <= table.min() <= table.max() < number_of_nodes:
        raise SolverError(
            f"mesh: {name} names node {table.max() if table.min() >= 0 else table.min()}, "
            f"but the nodes are numbered 0 to {number_of_nodes - 1}."
        )
