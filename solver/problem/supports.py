"""Displacement boundary conditions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.errors import SolverError
from solver.mesh.mesh import Mesh

Placement: TypeAlias = Callable[[Reals, float], Reals]
"""(reference positions (k, 3) in mm, fraction of the load) -> displacements (k, 3) in mm.

NaN where a component is free; zero at no load.
"""


@dataclass(frozen=True)
class Supports:
    """Displacement boundary conditions on named surfaces.

    Attributes:
        clamped: surfaces with zero displacement.
        symmetry: surface -> axis (0, 1, 2) whose displacement is zero on it.
        prescribed: surface -> ``Placement``, its displacement at each fraction of the load; takes
            precedence over the others on shared nodes.

            *Shape:* reference positions (k, 3) in mm, load -> (k, 3) in mm, NaN where free.

    Raises:
        SolverError: an axis other than 0, 1 or 2.
    """

    clamped: tuple[str, ...] = ()
    symmetry: Mapping[str, int] = field(default_factory=dict)
    prescribed: Mapping[str, Placement] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for surface, axis in self.symmetry.items():
            if axis not in (0, 1, 2):
                raise SolverError(
                    f"supports: the symmetry axis of {surface!r} must be 0, 1 or 2, got {axis}."
                )
        object.__setattr__(self, "clamped", tuple(self.clamped))
        object.__setattr__(self, "symmetry", MappingProxyType(dict(self.symmetry)))
        object.__setattr__(self, "prescribed", MappingProxyType(dict(self.prescribed)))


def fixed_displacements(
    mesh: Mesh, supports: Supports, moving_plane: str | None = None
) -> NDArray[np.bool_]:
    """Which displacements are given, (n, 3); on the moving plane only the height of the pin."""
    return ~np.isnan(given_displacements(mesh, supports, 1.0, moving_plane))


def given_displacements(
    mesh: Mesh, supports: Supports, load: float, moving_plane: str | None = None
) -> Reals:
    """Displacements (n, 3) in mm that are given at a fraction of the load, NaN where free.

    Raises ``SolverError`` if a prescribed motion has the wrong shape or infinite values.
    """
    given = np.full(mesh.nodes.shape, np.nan)
    given[mesh.surface_nodes(*supports.clamped)] = 0.0
    for surface, axis in supports.symmetry.items():
        given[mesh.surface_nodes(surface), axis] = 0.0
    if moving_plane is not None:
        given[pin(mesh, moving_plane), 2] = 0.0
    for surface in supports.prescribed:
        nodes = mesh.surface_nodes(surface)
        motion = prescribed_motion(mesh, supports, surface, load)
        given[nodes] = np.where(np.isnan(motion), given[nodes], motion)
    return given


def prescribed_motion(mesh: Mesh, supports: Supports, surface: str, load: float) -> Reals:
    """Prescribed displacements (k, 3) in mm of a surface's nodes at a fraction of the load."""
    positions = mesh.nodes[mesh.surface_nodes(surface)]
    motion = np.asarray(supports.prescribed[surface](positions, load), float)
    if motion.shape != positions.shape:
        raise SolverError(
            f"supports: the motion of {surface!r} must have the shape {positions.shape}, "
            f"got {motion.shape}."
        )
    if np.isinf(motion).any():
        raise SolverError(f"supports: the motion of {surface!r} is infinite at load {load:g}.")
    return motion


def pin(mesh: Mesh, moving_plane: str) -> int:
    """The node of a moving plane whose height in the plane is fixed: the first of the least z.

    Nothing else holds a cell along z. As no load acts along the plane, the reaction is zero.
    """
    nodes = mesh.surface_nodes(moving_plane)
    return int(nodes[mesh.nodes[nodes, 2].argmin()])
