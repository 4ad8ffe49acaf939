"""Load the solver while Gmsh meshes.

Numba, SciPy, MKL and the compiled kernels take about a second to load, which a small model does
not take to solve. Gmsh works outside of Python's interpreter lock, so a thread can load them in
the meantime. It solves one tetrahedron: whatever a solve needs is there afterwards.
"""

from __future__ import annotations

from contextlib import suppress
from functools import cache
from threading import Thread

import numpy as np

from solver import Mesh, Ogden, Problem, Supports

CORNERS = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
FLOOR, SLOPE = (0, 2, 1, 6, 5, 4), (1, 2, 3, 5, 8, 9)


@cache
def warm_up() -> Thread:
    """The thread that loads the solver, started with the first call; join it before solving.

    A daemon, so that an interrupted command need not wait for it.
    """
    thread = Thread(target=_load, name="warm-up", daemon=True)
    thread.start()
    return thread


def _load() -> None:
    with suppress(Exception):  # what fails here fails again in the solve, which says why
        solve_tetrahedron()


def solve_tetrahedron() -> None:
    """Take one tetrahedron through all that is done to a body: solve, stress, transfer."""
    from solver import peak_von_mises, solve, transfer

    supports = Supports(clamped=("floor",))
    problem = Problem(_tetrahedron(), Ogden(mu=(1.0,), alpha=(2.0,)), supports, ("slope",))
    solution = solve(problem, pressure=1e-3)
    peak_von_mises(solution)
    transfer(solution, problem.mesh)


def _tetrahedron() -> Mesh:
    from solver.elements import TETRAHEDRON_EDGES

    corners = np.array(CORNERS)
    middles = [(corners[a] + corners[b]) / 2 for a, b in TETRAHEDRON_EDGES]
    surfaces = {"floor": np.array([FLOOR], np.int32), "slope": np.array([SLOPE], np.int32)}
    numbers = np.arange(10, dtype=np.int32)
    return Mesh(np.concatenate([corners, middles]), numbers[None], surfaces)
