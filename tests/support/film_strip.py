"""A strip bent over a thin film at its lower side, which is stiffer by a ratio."""

from __future__ import annotations

import numpy as np
from meshes import cell_mesh
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, solve

LENGTH, FILM = 8.0, 0.01


def strip(film: float = FILM) -> Mesh:
    """Half of a strip of 8 × 2 × 1 mm with the region ``film``."""
    lines = [np.linspace(0, LENGTH, 7), np.array([0, 1.0]), np.array([0, film, 0.5, 1.0])]
    mesh = cell_mesh(np.ones((6, 1, 3), int), lines)
    low = mesh.nodes[mesh.tets[:, :4]].mean(axis=1)[:, 2] < film
    return mesh.with_regions({"film": np.flatnonzero(low)})


def lowered(at: NDArray[np.float64], load: float) -> NDArray[np.float64]:
    """An end that goes down by a quarter of the length and may slide along x."""
    free, held = np.full(len(at), np.nan), np.zeros(len(at))
    return np.stack([free, held, held - load * LENGTH / 4], axis=1)


def bent(ratio: float) -> Solution:
    """The strip of incompressible neo-Hookean rubber, its end led down."""
    problem = Problem(
        strip(),
        Ogden((1.0,), (2.0,)),
        Supports(("x0",), {"y0": 1}, {"x1": lowered}),
        materials={"film": Ogden((ratio,), (2.0,))},
    )
    return solve(problem, 0.0, SolverOptions(maximum_steps=30))
