"""Folded elements of deformed bodies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, Supports, folded_elements, peak_von_mises, solve
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.results.folds import folded_around


def pushed(mesh: Mesh, by: float) -> Callable[..., np.ndarray]:
    return lambda at, load: np.stack([load * by * at[:, 0], *np.full((2, len(at)), np.nan)], axis=1)


def test_a_body_that_is_only_stretched_has_no_folds(
    box: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    mesh = box((2, 2, 2), distortion=0.25)
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}, prescribed={"x1": pushed(mesh, 0.5)})
    solution = solve(Problem(mesh, ninjaflex, supports))
    assert solution.converged and solution.warnings == ()
    assert folded_elements(solution).elements.size == 0


def test_a_fold_is_told_with_its_number_and_its_place(
    box: Callable[..., Mesh], ninjaflex: Ogden
) -> None:
    mesh = box((3, 3, 3))
    solution = solve(Problem(mesh, ninjaflex, Supports(clamped=("x0",)), ("x1",)), 0.01)
    tet = mesh.tets[11]
    displacement = solution.displacement.copy()
    one, other = (mesh.nodes + displacement)[tet[list(TETRAHEDRON_EDGES[3])]]
    displacement[tet[7]] = one + 0.2 * (other - one) - mesh.nodes[tet[7]]
    spoilt = replace(solution, displacement=displacement)
    folds = folded_elements(spoilt)
    sharing = np.flatnonzero((mesh.tets[:, 4:] == tet[7]).any(axis=1))
    assert np.array_equal(folds.elements, sharing)  # all around that edge
    assert folds.positions == pytest.approx(mesh.nodes[mesh.tets[sharing, :4]].mean(axis=1))
    (warning,) = spoilt.warnings
    assert warning.startswith(f"{len(sharing)} elements are folded")
    assert f"{folds.positions[0, 0]:.4g}, {folds.positions[0, 1]:.4g}" in warning
    assert folded_around(mesh, folds, int(tet[0]))
    far = int(np.linalg.norm(mesh.nodes - mesh.nodes[tet[0]], axis=1).argmax())
    assert not folded_around(mesh, folds, far)
    assert not solution.warnings
    assert peak_von_mises(spoilt).value > 0
