"""What the cases of slender and flat bodies share: reference values, nodes, states on a path."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
from references import DATA

from solver import Mesh, Problem, Solution, SolverOptions, solve
from solver.arrays import Reals


def reference(name: str) -> dict[str, Any]:
    """The case of ``data/structures.json`` whose name starts so: reference, source, status."""
    cases = json.loads((DATA / "structures.json").read_text(encoding="utf-8"))["cases"]
    return next(case for case in cases if case["name"].startswith(name))


def told(name: str) -> str:
    """Source and status of a case's reference values as sentences."""
    case = reference(name)
    return f"{case['source']}. Status: {case['status']}."


def node_at(mesh: Mesh, *position: float) -> int:
    """The node at a position, mm."""
    distances = np.linalg.norm(mesh.nodes - position, axis=1)
    node = int(distances.argmin())
    assert distances[node] < 1e-9 * mesh.size, f"no node at {position}"
    return node


def converged(solution: Solution) -> Solution:
    """The solution, if it is one."""
    assert solution.converged, solution.message
    return solution


def along(problem: Problem, pressures: Sequence[float], options: SolverOptions) -> list[Reals]:
    """Displacements (n, 3) at pressures (MPa) that grow from zero."""
    solution = converged(solve(problem, pressures[-1], options, stops=pressures[:-1]))
    return [stop.displacement for stop in (*solution.at_stops, solution)]
