"""Quadratic tetrahedral meshes with named surfaces and regions."""

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
from solver.mesh.regions import REST, checked_regions, region_numbers, sides_of


@dataclass(frozen=True)
class Mesh:
    """Ten-node tetrahedra, straight or curved, and named six-node triangles on their faces.

    Regions are named sets of tetrahedra that share nodes. A node between them has one side in each:
    the hydrostatic pressure and recovered stresses may jump there.

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
        SolverError: a shape is wrong, a coordinate is not finite, a number of a node or element is
            out of range, or a region is empty, has no name or shares an element.

    Examples:
        >>> from solver import Mesh
        >>> from solver.mesh import block
        >>> bar = block((30, 4, 4), (6, 1, 1))
        >>> print(bar.nodes.shape, bar.tets.shape, bar.surfaces["x1"].shape)
        (117, 3) (36, 10) (2, 6)
        >>> half = bar.nodes[bar.tets[:, :4]].mean(axis=1)[:, 2] > 2  # by the elements' centres
        >>> layered = bar.with_regions({"upper": half.nonzero()[0]})
        >>> larger = Mesh(2 * bar.nodes, bar.tets, bar.surfaces)
        >>> print(layered.region_names, f"{larger.size:.1f} mm")
        ('', 'upper') 61.1 mm
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
        regions = checked_regions(self.regions, len(tets))
        object.__setattr__(self, "regions", MappingProxyType(regions))

    @property
    def region_names(self) -> tuple[str, ...]:
        """Names of the regions by their numbers: first that of the rest, which is empty."""
        return (REST, *self.regions)

    @cached_property
    def region_of_tet(self) -> Integers:
        """Number of each tetrahedron's region, 0 in the rest. (e,)"""
        return region_numbers(self.regions, len(self.tets))

    @property
    def vertices(self) -> Integers:
        """Node of each unknown of the hydrostatic pressure, ascending. (v,)

        These are the nodes at corners of tetrahedra, once for each region around them.
        """
        return self._corner_sides[0]

    @property
    def region_of_vertex(self) -> Integers:
        """Number of the region of each unknown of the pressure. (v,)"""
        return self._corner_sides[1]

    @property
    def tet_vertices(self) -> Integers:
        """The corners of each tetrahedron as positions in ``vertices``. (e, 4)"""
        return self._corner_sides[2]

    @property
    def sides(self) -> Integers:
        """Nodes, once for each region around them, ascending; without regions all. (s,)"""
        return self._node_sides[0]

    @property
    def region_of_side(self) -> Integers:
        """Number of the region that each of the ``sides`` lies in. (s,)"""
        return self._node_sides[1]

    @property
    def tet_sides(self) -> Integers:
        """The nodes of each tetrahedron as positions in ``sides``. (e, 10)"""
        return self._node_sides[2]

    @cached_property
    def _corner_sides(self) -> tuple[Integers, Integers, Integers]:
        corners = self.tets[:, :4]
        if self.regions:
            return sides_of(corners, self.region_of_tet, len(self.region_names))
        vertices = np.unique(corners)
        positions = np.searchsorted(vertices, corners).astype(np.int32)
        return vertices, np.zeros(len(vertices), np.int32), positions

    @cached_property
    def _node_sides(self) -> tuple[Integers, Integers, Integers]:
        if self.regions:
            return sides_of(self.tets, self.region_of_tet, len(self.region_names))
        nodes = np.arange(len(self.nodes), dtype=np.int32)
        return nodes, np.zeros(len(nodes), np.int32), self.tets

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
        """The same tetrahedra, surfaces and regions with nodes elsewhere.

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
        return self._known_to(replace(self, nodes=nodes), (*OF_CELLS, *OF_SURFACES, *OF_REGIONS))

    def with_surfaces(self, surfaces: Mapping[str, Integers]) -> Mesh:
        """The same mesh with more named surfaces, or others of the same names.

        Args:
            surfaces: name -> node numbers of triangles as in ``surfaces``.

        Raises:
            SolverError: a table of another shape, or a node number out of range.
        """
        other = replace(self, surfaces={**self.surfaces, **surfaces})
        return self._known_to(other, (*OF_CELLS, *OF_REGIONS))

    def with_regions(self, regions: Mapping[str, Integers]) -> Mesh:
        """The same mesh with more named regions, or others of the same names.

        Args:
            regions: name -> numbers of tetrahedra as in ``regions``.

        Raises:
            SolverError: as for a new mesh: regions that are not disjoint, empty or out of range.
        """
        other = replace(self, regions={**self.regions, **regions})
        return self._known_to(other, (*OF_CELLS, *OF_SURFACES))

    def _known_to(self, other: Mesh, properties: tuple[str, ...]) -> Mesh:
        """``other`` with those properties that are known already and the same."""
        known = {name: self.__dict__[name] for name in properties if name in self.__dict__}
        other.__dict__.update(known)
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


OF_CELLS = ("outer_faces",)
OF_SURFACES = ("boundary_surfaces",)
OF_REGIONS = ("region_of_tet", "_corner_sides", "_node_sides")
"""Properties of a mesh that depend on its tetrahedra and, besides, on surfaces or regions; not on
where its nodes are."""


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
        if array.dtype.kind == "i" and (array != given).any():  # a fraction, or too large
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
