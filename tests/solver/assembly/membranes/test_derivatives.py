"""Derivatives of the work of films by shape and displacement, against central differences."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Membrane, Mesh, Ogden, Problem, Supports
from solver.assembly.membranes.derivatives import membrane_derivatives
from solver.assembly.membranes.membranes import Membranes

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
FILM = Membrane("z1", 100.0, 0.3, 0.1)


@pytest.mark.parametrize("wrinkles", [True, False])
def test_derivatives_by_shape_and_displacement(box: Meshes, wrinkles: bool) -> None:
    """Of a curved film that is taut here and wrinkled or slack there."""
    mesh, random = box((2, 2, 1), (2.0, 2.0, 1.0)), np.random.default_rng(5)
    mesh = mesh.moved(mesh.nodes + 0.05 * np.sin(2 * mesh.nodes[:, [1, 2, 0]]))
    moved = 0.15 * np.sin(2 * mesh.nodes[:, [1, 0, 2]])
    along, velocity = random.normal(size=(2, *mesh.nodes.shape))
    film = replace(FILM, wrinkles=wrinkles)

    def problem(at: Mesh) -> Problem:
        return Problem(at, Ogden.neo_hooke(1.0), Supports(("x0",)), membranes=(film,))

    def work(step: float, displaced: float) -> float:
        at = problem(mesh.moved(mesh.nodes + step * velocity))
        forces = Membranes.of(at).forces(moved + displaced * velocity)
        return float((forces * along).sum())

    if wrinkles:
        bearing = replace(problem(mesh), membranes=(replace(film, wrinkles=False),))
        energies = [Membranes.of(each).energy(moved) for each in (problem(mesh), bearing)]
        assert energies[0] < 0.95 * energies[1]
    by_position, by_displacement = membrane_derivatives(problem(mesh), moved, along)
    shape = (work(1e-5, 0.0) - work(-1e-5, 0.0)) / 2e-5
    assert (by_position * velocity).sum() == pytest.approx(shape, rel=1e-5)
    displacement = (work(0.0, 1e-5) - work(0.0, -1e-5)) / 2e-5
    assert (by_displacement * velocity).sum() == pytest.approx(displacement, rel=1e-5)
