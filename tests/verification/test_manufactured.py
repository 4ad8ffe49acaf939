"""The made-up solutions are what they claim to be, before a solver is measured by them."""

from __future__ import annotations

import numpy as np
import pytest
from cases_manufactured import COMPRESSIBLE
from manufactured import Manufactured, Swirl
from references import NINJAFLEX

MADE = {
    "incompressible": Manufactured(Swirl(), NINJAFLEX),
    "compressible": Manufactured(Swirl(swelling=0.03), COMPRESSIBLE),
}
POINTS = np.random.default_rng(2).uniform(0, 1, (50, 3))


def test_shears_keep_the_volume_exactly() -> None:
    volume = np.linalg.det(MADE["incompressible"].motion.gradient(POINTS))
    assert volume == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("made", MADE.values(), ids=MADE)
def test_the_gradient_is_that_of_the_motion(made: Manufactured) -> None:
    h = 1e-5
    slopes = [
        made.motion.displacement(POINTS + h * e) - made.motion.displacement(POINTS - h * e)
        for e in np.eye(3)
    ]
    gradient = np.eye(3) + np.stack(slopes, axis=2) / (2 * h)
    assert made.motion.gradient(POINTS) == pytest.approx(gradient, abs=1e-9)


@pytest.mark.parametrize("made", MADE.values(), ids=MADE)
def test_body_force_and_tractions_balance(made: Manufactured) -> None:
    x, w = np.polynomial.legendre.leggauss(12)
    x, w = (1 + x) / 2, w / 2
    inside = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
    total = np.einsum("i,j,k->ijk", w, w, w).ravel() @ made.body_force(inside)
    flat, weights = inside[: 12 * 12, 1:], np.outer(w, w).ravel()
    for axis in range(3):
        for side in (0.0, 1.0):
            normal = (2 * side - 1) * np.eye(3)[axis]
            total += weights @ made.traction(tuple(normal))(np.insert(flat, axis, side, axis=1))
    assert abs(made.body_force(POINTS)).max() > 1
    assert total == pytest.approx(np.zeros(3), abs=1e-9)


@pytest.mark.parametrize("made", MADE.values(), ids=MADE)
def test_the_stress_is_the_slope_of_the_energy(made: Manufactured) -> None:
    """Another formula than the one under test: W of the stretches, and the pressure's part."""
    point, h = POINTS[:1], 1e-5
    gradient, (pressure,) = made.motion.gradient(point)[0], made.pressure(point)

    def energy(f: np.ndarray) -> float:
        logs = np.log(np.linalg.svd(f, compute_uv=False))
        return made.material.energy(logs - logs.mean()) - pressure * np.linalg.det(f)

    steps = h * np.eye(9).reshape(9, 3, 3)
    slope = [(energy(gradient + s) - energy(gradient - s)) / (2 * h) for s in steps]
    assert made.stress(point)[0].ravel() == pytest.approx(slope, abs=1e-8)
