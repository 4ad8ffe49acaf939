"""Derivatives of virtual work and stress in single elements, against differences."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from meshes import box_mesh
from numba import njit, prange
from numpy.typing import NDArray

from solver import Ogden, Problem, Supports
from solver.assembly.assembly import solid
from solver.kernels.assembly import total_energy
from solver.kernels.element import Solid
from solver.kernels.shape_derivatives import stress_derivatives, work_derivatives
from solver.kernels.stress import deviatoric_stress
from solver.material.law import Hyperelastic
from solver.material.mooney_rivlin import MooneyRivlin
from solver.sensitivity.surface_integrals import (
    area_derivative,
    areas,
    flux_derivative,
    tangents,
    volume_curvature,
    volume_derivative,
)

Array = NDArray[np.float64]
MESH = box_mesh((2, 1, 1), (1.0, 1.2, 0.9), 0.1)
NODAL = MESH.nodes.shape
STEP = 3e-4
"""mm. Longer ones err by their fourth power, shorter ones by rounding over their square."""
MATERIALS: dict[str, Hyperelastic] = {
    "incompressible": Ogden((0.2, 3.3), (3.05, -0.0054)),
    "quadratic": Ogden.yeoh(0.5, 0.05, -0.002, bulk_modulus=20.0),
    "logarithmic": Ogden((1.0,), (2.0,), 5.0, volumetric="logarithmic"),
    "mooney": MooneyRivlin(0.4, 0.1, 0.05, -0.02, 0.01, 30.0, "logarithmic"),
}


def draws(*shapes: tuple[int, ...]) -> list[Array]:
    random = np.random.default_rng(11)
    return [random.uniform(-1, 1, shape) for shape in shapes]


def slope(function: Callable[[float], float], h: float) -> float:
    """Derivative at zero by central differences of fourth order."""
    return (8 * (function(h) - function(-h)) - function(2 * h) + function(-2 * h)) / (12 * h)


@pytest.fixture(params=MATERIALS)
def body(request: pytest.FixtureRequest) -> Solid:
    return solid(Problem(MESH, MATERIALS[request.param], Supports(clamped=("x0",))))


def displaced() -> Array:
    """Stretched, sheared and uneven."""
    uneven, affine = draws(MESH.nodes.shape, (3, 3))
    displacement: Array = 0.02 * uneven + 0.3 * MESH.nodes @ affine
    return displacement


def test_work_derivatives_are_second_derivatives_of_the_energy(body: Solid) -> None:
    """The work along a direction is the energy's derivative; its own are by nodes and places."""
    u, (velocity, w, q, m) = displaced(), draws(NODAL, NODAL, *2 * [(len(MESH.vertices),)])
    parts = np.empty((2, 2, *MESH.tets.shape, 3))
    work_derivatives(body, u, q, np.stack([w, 2 * w]), np.stack([m, 2 * m]), *parts)

    def work(nodes: Array, displacement: Array) -> float:
        moving = body._replace(nodes=nodes)
        return slope(lambda h: total_energy(moving, displacement + h * w, q + h * m)[0], STEP)

    by_place = slope(lambda h: work(MESH.nodes + h * velocity, u), STEP)
    by_displacement = slope(lambda h: work(MESH.nodes, u + h * velocity), STEP)
    first, second = np.swapaxes((parts * velocity[MESH.tets]).sum(axis=(2, 3, 4)), 0, 1)
    assert first == pytest.approx([by_place, by_displacement], rel=1e-7)
    assert second == pytest.approx(2 * first, rel=1e-12)


def matrices() -> tuple[Array, Array, Array, Array]:
    nan = np.nan
    return np.full((3, 3), nan), np.full((3, 3), nan), np.full((3, 3), nan), np.full((3, 3), nan)


_matrices: Callable[[], tuple[Array, Array, Array, Array]] = njit(matrices)


@njit(parallel=True)
def soil(rounds: int) -> float:
    """Leave numbers that are none in the memory that small matrices are made of."""
    total = 0.0
    for _ in prange(rounds):
        held = (_matrices(), _matrices(), _matrices(), _matrices(), _matrices())
        total += held[4][3][2, 2]
    return total


def test_work_derivatives_have_the_same_bits_every_time(body: Solid) -> None:
    """Whatever the memory that the kernel takes held before."""
    u, (w, q, m) = displaced(), draws(NODAL, *2 * [(len(MESH.vertices),)])
    first, again = np.empty((2, 2, 1, *MESH.tets.shape, 3))
    work_derivatives(body, u, q, w[None], m[None], *first)
    assert np.isfinite(first).all()
    for _ in range(30):
        soil(64)
        work_derivatives(body, u, q, w[None], m[None], *again)
        assert np.array_equal(first, again)


@pytest.mark.thorough
def test_stress_derivatives_are_those_of_the_stress(body: Solid) -> None:
    u, count = displaced(), len(MESH.tets)
    velocity, weights, by_volume = draws(NODAL, (count, 4, 6), (count,))
    parts = np.empty((2, *MESH.tets.shape, 3))
    stress_derivatives(body, u, weights, by_volume, *parts)

    def total(nodes: Array, displacement: Array) -> float:
        stress, volumes = np.empty((count, 4, 6)), np.empty((count, 4))
        deviatoric_stress(body._replace(nodes=nodes), displacement, stress, volumes)
        return float((weights * stress).sum() + by_volume @ volumes.sum(axis=1))

    by_place = slope(lambda h: total(MESH.nodes + h * velocity, u), 1e-3)
    by_displacement = slope(lambda h: total(MESH.nodes, u + h * velocity), 1e-3)
    found = (parts * velocity[MESH.tets]).sum(axis=(1, 2, 3))
    assert found == pytest.approx([by_place, by_displacement], rel=1e-7)


def test_derivatives_of_integrals_over_a_surface() -> None:
    triangles = MESH.triangles("x1", "z1")
    velocity, bumps = draws(NODAL, NODAL)
    x, density = MESH.nodes + 0.05 * bumps, np.abs(draws((len(triangles), 6))[0])
    field = draws((len(triangles), 6, 3))[0]

    def flux(h: float) -> float:
        normal = np.cross(*tangents(x + h * velocity, triangles))
        return float(np.einsum("kqi,kqi,q->", field, normal, WEIGHTS))

    def area(h: float) -> float:
        return float((density * areas(x + h * velocity, triangles)).sum())

    found = [flux_derivative(x, triangles, field), area_derivative(x, triangles, density)]
    assert [(each * velocity).sum() for each in found] == pytest.approx(
        [slope(flux, STEP), slope(area, STEP)], rel=1e-8
    )


WEIGHTS = np.repeat([0.223381589678011, 0.109951743655322], 3) / 2


def test_the_second_derivative_of_the_enclosed_volume_is_exact() -> None:
    triangles = MESH.triangles("x1", "z1", "y1")
    direction, other = draws(NODAL, NODAL)
    curved = volume_curvature(MESH.nodes, triangles, direction)
    twice = volume_curvature(MESH.nodes, triangles, 1e-9 * direction)
    assert 1e9 * twice == pytest.approx(curved, rel=1e-12, abs=1e-12)

    def along(h: float) -> float:
        return float((volume_derivative(MESH.nodes + h * other, triangles) * direction).sum())

    assert (curved * other).sum() == pytest.approx(slope(along, 1e-2), rel=1e-9)
