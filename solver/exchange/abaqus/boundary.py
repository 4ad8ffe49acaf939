"""Supports of a problem in an input file."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from solver.errors import SolverError
from solver.mesh.mesh import Mesh
from solver.problem.loads import node_at
from solver.problem.problem import Problem
from solver.problem.supports import axes_of, prescribed_motion

PROPORTIONAL = 1e-9
"""Largest difference from proportion of a motion, as a fraction of the largest displacement."""

LOADS = (0.25, 0.5, 0.75)
"""Fractions of the load at which a motion must be in proportion."""


def held_lines(problem: Problem) -> Iterator[str]:
    """``*BOUNDARY`` of what does not move: clamps, symmetry, single nodes."""
    mesh, supports = problem.mesh, problem.supports
    lines = [f"{name}, 1, 3" for name in supports.clamped]
    for name, axes in supports.symmetry.items():
        lines += [f"{name}, {axis + 1}, {axis + 1}" for axis in axes_of(axes)]
    for position, axes in supports.nodes.items():
        node = node_at(mesh, position, "supports") + 1
        lines += [f"{node}, {axis + 1}, {axis + 1}" for axis in axes_of(axes)]
    if lines:
        yield "*BOUNDARY"
        yield from lines


def moved_lines(problem: Problem) -> Iterator[str]:
    """``*BOUNDARY`` of prescribed motions at the whole load, for a step that leads there.

    Raises ``SolverError`` for a motion that is not in proportion to the load.
    """
    lines = [
        line
        for surface in problem.supports.prescribed
        for line in _motion(problem.mesh, problem, surface)
    ]
    if lines:
        yield "*BOUNDARY"
        yield from lines


def _motion(mesh: Mesh, problem: Problem, surface: str) -> Iterator[str]:
    whole = prescribed_motion(mesh, problem.supports, surface, 1.0)
    size = np.nanmax(np.abs(whole), initial=0.0)
    for load in LOADS:
        part = prescribed_motion(mesh, problem.supports, surface, load)
        if np.nanmax(np.abs(part - load * whole), initial=0.0) > PROPORTIONAL * size:
            raise SolverError(
                f"write_deck: the motion of {surface!r} does not grow in proportion to the load, "
                "as a step of an input file does."
            )
    for node, motion in zip(mesh.surface_nodes(surface), whole, strict=True):
        for axis in np.flatnonzero(~np.isnan(motion)):
            yield f"{node + 1}, {axis + 1}, {axis + 1}, {float(motion[axis])!r}"
