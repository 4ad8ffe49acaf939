"""What a file says of a mesh, before it becomes one: cells and named sets of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from numpy.typing import NDArray

from solver.arrays import Reals

Numbers: TypeAlias = NDArray[Any]
"""Whole numbers of any width: files have 64 bit, a mesh 32."""


@dataclass(frozen=True)
class Found:
    """Tetrahedra and named sets of a file; all numbers count from 0.

    Attributes:
        nodes: coordinates (n, 3) in mm; some may belong to no tetrahedron.
        tets: nodes (e, 4) or, in Gmsh's order, (e, 10).
        triangles: name -> nodes (k, 3), (k, 6) or more of triangles, whose corners come first.
        faces: name -> element and its face, a number in ``solver.mesh.faces.FACES`` (k, 2).
        node_sets: name -> nodes (k,).
        element_sets: name -> tetrahedra (k,).
    """

    nodes: Reals
    tets: Numbers
    triangles: Mapping[str, Numbers] = field(default_factory=dict)
    faces: Mapping[str, Numbers] = field(default_factory=dict)
    node_sets: Mapping[str, Numbers] = field(default_factory=dict)
    element_sets: Mapping[str, Numbers] = field(default_factory=dict)
