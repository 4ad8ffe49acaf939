"""Boxes of two materials: a region on one side of a plane."""

from __future__ import annotations

import numpy as np
from meshes import box_mesh
from numpy.typing import NDArray

from solver import Mesh, Ogden
from solver.material.law import Hyperelastic
from solver.material.mooney_rivlin import MooneyRivlin

SOFT = Ogden((1.0,), (2.0,))
HARD = Ogden((10.0,), (2.0,))
OTHER: Hyperelastic = MooneyRivlin(4.0, 1.0, 0.5, 0.0, 0.0, 300.0, "logarithmic")
"""Another law, compressible, with more constants."""


def beyond(mesh: Mesh, axis: int, position: float) -> NDArray[np.int64]:
    """Elements whose middles lie beyond a plane normal to an axis, mm."""
    middles = mesh.nodes[mesh.tets[:, :4]].mean(axis=1)
    return np.flatnonzero(middles[:, axis] > position)


def layered(
    divisions: tuple[int, int, int] = (2, 2, 2),
    size: tuple[float, float, float] = (1.0, 1.0, 1.0),
    axis: int = 2,
    position: float = 0.5,
    distortion: float = 0.0,
) -> Mesh:
    """A box with the region ``hard`` beyond a plane, which a grid plane of elements must be."""
    mesh = box_mesh(divisions, size, distortion)
    return mesh.with_regions({"hard": beyond(mesh, axis, position)})
