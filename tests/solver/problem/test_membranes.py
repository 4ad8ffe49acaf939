"""Membranes that make no sense are refused in one sentence."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from solver import Membrane, Mesh, Ogden, Problem, Supports
from solver.errors import SolverError

Meshes = Callable[..., Mesh]
RUBBER = Ogden.neo_hooke(1.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"young_modulus": 0.0}, "membranes: young_modulus = 0 MPa must be positive and finite."),
        ({"thickness": float("inf")}, "membranes: thickness = inf mm must be positive and finite."),
        ({"poisson_ratio": 0.6}, "membranes: poisson_ratio = 0.6 must be above -1 and at most"),
        ({"poisson_ratio": float("nan")}, "membranes: poisson_ratio = nan must be above -1"),
        ({"thickness": "thin"}, r"membranes: thickness must be a number, got 'thin' \(str\)"),
        ({"wrinkles": 1}, "membranes: wrinkles must be a bool, got 1"),
        ({"surface": 3}, "membranes: surface must be a str, got 3"),
    ],
)
def test_constants_out_of_their_bounds_are_refused(change: dict[str, Any], message: str) -> None:
    given = {"surface": "z0", "young_modulus": 1.0, "poisson_ratio": 0.3, "thickness": 0.1}
    with pytest.raises(SolverError, match=message):
        Membrane(**given | change)


def test_surfaces_that_are_no_faces_are_refused(box: Meshes) -> None:
    mesh = box((1, 1, 1))
    askew = mesh.surfaces["z0"][:, [0, 1, 2, 4, 3, 5]]
    across = mesh.surfaces["z0"].copy()
    across[0, 0] = mesh.surfaces["z1"][0, 0]
    twice = mesh.surfaces["z0"][[0, 0]]
    mesh = mesh.with_surfaces({"askew": askew, "across": across, "twice": twice})
    for surface, message in (
        ("nowhere", "no surface is called 'nowhere'"),
        ("askew", "'askew' at .* is no face of a tetrahedron"),
        ("across", "'across' at .* is no face of a tetrahedron"),
        ("twice", "'twice' has a triangle twice"),
    ):
        film = Membrane(surface, 1.0, 0.3, 0.1)
        with pytest.raises(SolverError, match=message):
            Problem(mesh, RUBBER, Supports(("x0",)), membranes=(film,))


def test_what_is_no_tuple_of_membranes_is_refused(box: Meshes) -> None:
    film: Any = Membrane("z0", 1.0, 0.3, 0.1)
    with pytest.raises(SolverError, match="membranes must be a tuple of a Membrane"):
        Problem(box((1, 1, 1)), RUBBER, Supports(("x0",)), membranes=film)


def test_a_cell_with_a_moving_plane_takes_no_membranes(cell: Mesh) -> None:
    with pytest.raises(SolverError, match="membranes: a cell with a moving plane takes none"):
        Problem(
            cell, RUBBER, Supports(symmetry={"x0": 0, "y0": 1}), ("cavity",), moving_plane="x1",
            membranes=(Membrane("outside", 1.0, 0.3, 0.1),),
        )  # fmt: skip
