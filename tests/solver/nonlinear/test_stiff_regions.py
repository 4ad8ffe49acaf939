"""Newton's method where one region is stiffer than another by powers of ten."""

from __future__ import annotations

import numpy as np
import pytest
from film_strip import bent
from meshes import cell_mesh

from solver import Mesh, Ogden, Problem, Supports, solve


@pytest.mark.parametrize("ratio", [1e2, 1e5])
def test_a_stiff_film_takes_no_more_than_twice_the_iterations(ratio: float) -> None:
    """Without the stress extrapolated it is five times as many at 1e5: 34 instead of 7."""
    plain, stiff = bent(1.0), bent(ratio)
    assert stiff.converged
    assert stiff.newton_iterations <= 2 * plain.newton_iterations
    assert stiff.refused_steps == 0


def cell_over_film() -> Mesh:
    """Half a bubble whose floor has a film under it."""
    chamber, wall, gap = np.zeros((3, 2, 7), int)
    for section in (chamber, wall, gap):
        section[:, :4] = 1
        section[0, 2] = 2
    wall[:, 4:] = chamber[:, 4:] = 1
    chamber[0, 3:6] = 2
    lines = [[0.4, 0.6, 0.4], [3.4, 0.6], [0.02, 0.6, 1.0, 0.6, 2.0, 2.0, 0.6]]
    cells = np.stack([chamber, wall, gap])
    mesh = cell_mesh(cells, [np.cumsum([0.0, *sizes]) for sizes in lines])
    low = mesh.nodes[mesh.tets[:, :4]].mean(axis=1)[:, 2] < 0.02
    return mesh.with_regions({"film": np.flatnonzero(low)})


def test_nor_does_a_cell_whose_moving_plane_cuts_the_film() -> None:
    """Without the stress extrapolated, in the plane's own curvature too, it ends at a tenth of it.

    One material takes 12 iterations, at 1e5 it is 14.
    """
    problem = Problem(
        cell_over_film(),
        Ogden((1.0,), (2.0,)),
        Supports(symmetry={"x0": 0, "y0": 1}),
        ("cavity",),
        moving_plane="x1",
        materials={"film": Ogden((1e5,), (2.0,))},
    )
    found = solve(problem, 0.06)
    assert found.converged
    assert found.newton_iterations <= 24
    assert found.stable in (True, None)
