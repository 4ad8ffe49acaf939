"""Loads of a problem in an input file: pressure on surfaces, dead loads as nodal forces."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from solver.problem.loads import nodal_forces
from solver.problem.problem import Problem


def load_lines(problem: Problem, pressure: float) -> Iterator[str]:
    """``*DSLOAD`` of a pressure, MPa, that follows the surfaces, and ``*CLOAD`` of dead loads."""
    if pressure and problem.pressurised:
        yield "*DSLOAD"
        yield from (f"{name}, P, {float(pressure)!r}" for name in problem.pressurised)
    forces = nodal_forces(problem.mesh, problem.loads)
    nodes, axes = np.nonzero(forces)
    if len(nodes):
        yield "*CLOAD"
    for node, axis in zip(nodes.tolist(), axes.tolist(), strict=True):
        yield f"{node + 1}, {axis + 1}, {float(forces[node, axis])!r}"
