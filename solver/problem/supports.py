"""Displacement boundary conditions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from numbers import Real
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import is_axis, mapping, names, shown
from solver.mesh.mesh import Mesh
from solver.problem.loads import node_at

Placement: TypeAlias = Callable[[Reals, float], Reals]
"""(reference positions (k, 3) in mm, fraction of the load) -> displacements (k, 3) in mm.

NaN where a component is free; zero at no load.
"""


Axes: TypeAlias = int | tuple[int, ...]
"""An axis, 0, 1 or 2 (x, y or z), or several."""

Position: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Supports:
    """Displacement boundary conditions on named surfaces and single nodes.

    Attributes:
        clamped: surfaces with zero displacement.
        symmetry: surface -> axis (0, 1, 2), or axes such as ``(0, 2)``, along which its
            displacement is zero: a plane of symmetry, or a surface held in some components only.
        prescribed: surface -> ``Placement``, its displacement at each fraction of the load; takes
            precedence over the others on shared nodes. Two of them must agree there.

            *Shape:* reference positions (k, 3) in mm, load -> (k, 3) in mm, NaN where free.
        nodes: position of a node in mm -> axis or axes along which its displacement is zero. Three
            nodes can hold a body without any constraint on its shape; other forces on a single node
            are those of a mesh, not of a body, whose displacement there is unbounded.

    Raises:
        SolverError: an axis other than 0, 1 or 2, a position that is not three finite numbers, or
            anything but names, axes and functions where they belong.

    Examples:
        >>> from solver import Ogden, Problem, Supports, solve
        >>> from solver.mesh import block
        >>> held = Supports(
        ...     clamped=("x0",),
        ...     symmetry={"y0": 1},  # no displacement along y
        ...     prescribed={"x1": lambda at, load: at * 0 + (3.0 * load, 0, 0)},  # up to 3 mm
        ... )
        >>> stretched = solve(Problem(block((30, 4, 4), (6, 1, 1)), Ogden.neo_hooke(0.5), held))
        >>> print(f"{stretched.displacement[:, 0].max():.1f} mm")
        3.0 mm
    """

    clamped: tuple[str, ...] = ()
    symmetry: Mapping[str, Axes] = field(default_factory=dict)
    prescribed: Mapping[str, Placement] = field(default_factory=dict)
    nodes: Mapping[Position, Axes] = field(default_factory=dict)

    def __post_init__(self) -> None:
        clamped = names("supports: clamped", self.clamped)
        symmetry = mapping("supports: symmetry", self.symmetry, "surface -> axis")
        prescribed = mapping("supports: prescribed", self.prescribed, "surface -> function")
        nodes = mapping("supports: nodes", self.nodes, "position -> axes")
        names("supports: the surfaces of symmetry", tuple(symmetry))
        names("supports: the surfaces of prescribed", tuple(prescribed))
        for surface, axes in symmetry.items():
            _check_axes(f"the symmetry axis of {surface!r}", axes)
        for surface, motion in prescribed.items():
            _check_callable(surface, motion)
        for position, axes in nodes.items():
            _check_position(position)
            _check_axes(f"the axis of the node at {position} mm", axes)
        object.__setattr__(self, "clamped", clamped)
        object.__setattr__(self, "symmetry", MappingProxyType(symmetry))
        object.__setattr__(self, "prescribed", MappingProxyType(prescribed))
        object.__setattr__(self, "nodes", MappingProxyType(nodes))

    @property
    def immovable(self) -> tuple[str, ...]:
        """Surfaces held in more than one component: clamps, no planes of symmetry."""
        several = (name for name, axes in self.symmetry.items() if len(axes_of(axes)) > 1)
        return (*self.clamped, *several)


def axes_of(axes: Axes) -> list[int]:
    """An axis or several as a list."""
    return sorted(set(axes)) if isinstance(axes, tuple | list) else [axes]


def _check_axes(what: str, axes: object) -> None:
    """Raise ``SolverError`` unless they are 0, 1 or 2, one or several."""
    several = axes if isinstance(axes, tuple | list) and axes else (axes,)
    if not all(is_axis(axis) for axis in several):
        raise SolverError(
            f"supports: {what} must be 0, 1 or 2, got {shown(axes)}; several are such as (0, 2)."
        )


def _check_callable(surface: str, motion: object) -> None:
    if not callable(motion):
        raise SolverError(
            f"supports: the motion of {surface!r} must be a function of positions (k, 3) in mm and "
            f"of the fraction of the load, got {shown(motion)}."
        )


def _check_position(position: object) -> None:
    """Raise ``SolverError`` unless it is three finite numbers."""
    numbers = position if isinstance(position, tuple) else ()
    if len(numbers) != 3 or not all(isinstance(x, Real) and math.isfinite(x) for x in numbers):
        raise SolverError(
            f"supports: the position of a node must be three finite numbers in mm, got "
            f"{shown(position)}."
        )


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
    for surface, axes in supports.symmetry.items():
        given[mesh.surface_nodes(surface)[:, None], axes_of(axes)] = 0.0
    for position, axes in supports.nodes.items():
        given[node_at(mesh, position, "supports"), axes_of(axes)] = 0.0
    if moving_plane is not None:
        given[pin(mesh, moving_plane), 2] = 0.0
    for surface in supports.prescribed:
        nodes = mesh.surface_nodes(surface)
        motion = prescribed_motion(mesh, supports, surface, load)
        given[nodes] = np.where(np.isnan(motion), given[nodes], motion)
    return given


SINGLE_NODES = ""
"""Stands for ``Supports.nodes`` among the names of surfaces."""


def held_by_each(
    mesh: Mesh, supports: Supports, moving_plane: str | None = None
) -> dict[str, NDArray[np.bool_]]:
    """Which displacements (n, 3) each supported surface holds by itself, by its name.

    Single nodes are under ``SINGLE_NODES``; the moving plane holds the nodes on it in its motion.
    """
    held: dict[str, NDArray[np.bool_]] = {}
    for name in supports.clamped:
        _at(held, name, mesh)[mesh.surface_nodes(name)] = True
    for name, axes in supports.symmetry.items():
        _at(held, name, mesh)[mesh.surface_nodes(name)[:, None], axes_of(axes)] = True
    for name in supports.prescribed:
        motion = prescribed_motion(mesh, supports, name, 1.0)
        _at(held, name, mesh)[mesh.surface_nodes(name)] |= ~np.isnan(motion)
    for position, axes in supports.nodes.items():
        _at(held, SINGLE_NODES, mesh)[node_at(mesh, position, "supports"), axes_of(axes)] = True
    if moving_plane is not None:
        _at(held, moving_plane, mesh)[mesh.surface_nodes(moving_plane)[:, None], [0, 2]] = True
    return held


def _at(held: dict[str, NDArray[np.bool_]], name: str, mesh: Mesh) -> NDArray[np.bool_]:
    """The table (n, 3) of a name, all false at first."""
    return held.setdefault(name, np.zeros(mesh.nodes.shape, bool))


def prescribed_motion(mesh: Mesh, supports: Supports, surface: str, load: float) -> Reals:
    """Prescribed displacements (k, 3) in mm of a surface's nodes at a fraction of the load."""
    positions = mesh.nodes[mesh.surface_nodes(surface)]
    motion = _vectors(surface, supports.prescribed[surface](positions, load))
    if motion.shape != positions.shape:
        raise SolverError(
            f"supports: the motion of {surface!r} must have the shape {positions.shape}, "
            f"got {motion.shape}."
        )
    if np.isinf(motion).any():
        raise SolverError(f"supports: the motion of {surface!r} is infinite at load {load:g}.")
    return motion


def _vectors(surface: str, given: object) -> Reals:
    """What a motion returned as an array; ``SolverError`` if it is none of numbers."""
    try:
        return np.asarray(given, float)
    except (TypeError, ValueError):
        raise SolverError(
            f"supports: the motion of {surface!r} must return displacements in mm, got "
            f"{shown(given)}."
        ) from None


def pin(mesh: Mesh, moving_plane: str) -> int:
    """The node of a moving plane whose height in the plane is fixed: the first of the least z.

    Nothing else holds a cell along z. As no load acts along z, the reaction is zero.
    """
    nodes = mesh.surface_nodes(moving_plane)
    return int(nodes[mesh.nodes[nodes, 2].argmin()])
