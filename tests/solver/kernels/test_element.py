"""Element residual and tangent: derivatives, invariance, precision."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from solver import Mesh, Ogden, Problem, Supports
from solver.assembly.assembly import solid
from solver.kernels.element import Solid, element_energy, element_response
from solver.kernels.tensors import jacobi

MATERIALS = {
    "incompressible": Ogden((0.19825, 3.2778), (3.05, -0.0054)),
    "finite bulk modulus": Ogden((0.19825, 3.2778), (3.05, -0.0054), bulk_modulus=40.0),
    "three terms": Ogden((0.4095, 0.003, 0.01), (1.3, 5.0, -2.0)),
    "Hencky": Ogden((2.0,), (0.0,)),
    "Yeoh": Ogden.yeoh(0.6, -0.05, 0.008),
    "Yeoh and Ogden, logarithmic": Ogden(
        (0.4, 0.3), (-1.5, 3.0), 5.0, (0.1, 0.02, -0.001), "logarithmic"
    ),
}
OWN = np.empty((0, 6))
"""The geometric part of a tangent has the element's own stress."""

ROTATION = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
ROTATION *= np.linalg.det(ROTATION)
GRADIENTS = {
    "undeformed": np.eye(3),
    "rotated": ROTATION,
    "stretched": np.diag([1.7, 0.8, 1 / (1.7 * 0.8)]),
    "rotated and stretched": ROTATION @ np.diag([1.7, 0.8, 0.9]) @ ROTATION.T @ ROTATION.T,
    "two equal stretches": ROTATION @ np.diag([1.6, 1.6, 1 / 1.6**2]),
    "nearly equal stretches": ROTATION @ np.diag([1.6, 1.6 * (1 + 1e-9), 1 / 1.6**2]),
}


def element(material: Ogden, curved: float = 0.03) -> tuple[Solid, NDArray[np.float64]]:
    """One tetrahedron, its edges bent at random by ``curved``."""
    corners = np.array([[0.1, 0, 0], [1.2, 0.1, 0], [0.2, 0.9, 0.1], [0.1, 0.2, 1.1]])
    pairs = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
    nodes = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in pairs]])
    nodes[4:] += np.random.default_rng(1).uniform(-curved, curved, (6, 3))
    faces = {"all": np.array([[0, 2, 1, 6, 5, 4]])}
    problem = Problem(Mesh(nodes, np.arange(10)[None], faces), material, Supports(("all",)), ())
    return solid(problem), nodes


def state(gradient: NDArray[np.float64], nodes: NDArray[np.float64], bend: float = 0.02) -> tuple:
    """Displacements of an affine map plus random bending, and pressures."""
    random = np.random.default_rng(5)
    u = nodes @ (gradient - np.eye(3)).T + random.uniform(-bend, bend, (10, 3))
    return u, random.uniform(-0.4, 0.4, 4)


def response(body: Solid, nodes: NDArray, v: NDArray) -> tuple[NDArray, NDArray]:
    """Residual (34,) and whole tangent (34, 34) at unknowns v (34,)."""
    r, upper = np.empty(34), np.empty((34, 34))
    assert element_response(body, 0, nodes, v[:30].reshape(10, 3), v[30:], OWN, True, r, upper) > 0
    return r, np.triu(upper) + np.triu(upper, 1).T


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
@pytest.mark.parametrize("gradient", GRADIENTS.values(), ids=GRADIENTS)
def test_tangent_is_the_derivative_of_the_residual(material: Ogden, gradient: NDArray) -> None:
    body, nodes = element(material)
    u, q = state(gradient, nodes)
    v = np.concatenate([u.ravel(), q])
    _, tangent = response(body, nodes, v)
    step = 1e-4
    steps = step * np.eye(34)

    def central(h: float) -> NDArray:
        ahead = [response(body, nodes, v + h * e)[0] for e in steps]
        behind = [response(body, nodes, v - h * e)[0] for e in steps]
        return (np.array(ahead) - np.array(behind)) / (2 * h * step)

    numerical = (4 * central(0.5) - central(1.0)) / 3  # Richardson: error h^4
    assert abs(numerical - tangent).max() <= 1e-8 * abs(tangent).max()


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
@pytest.mark.parametrize("gradient", GRADIENTS.values(), ids=GRADIENTS)
def test_residual_is_the_gradient_of_the_energy(material: Ogden, gradient: NDArray) -> None:
    body, nodes = element(material)
    u, q = state(gradient, nodes)
    v = np.concatenate([u.ravel(), q])
    residual, _ = response(body, nodes, v)

    def energy(v: NDArray) -> float:
        return element_energy(body, 0, nodes, v[:30].reshape(10, 3), v[30:])[0]

    steps = 1e-3 * np.eye(34)
    slopes = [
        (8 * (energy(v + e) - energy(v - e)) - energy(v + 2 * e) + energy(v - 2 * e)) / 12e-3
        for e in steps
    ]
    assert abs(np.array(slopes) - residual).max() <= 1e-8 * max(abs(residual).max(), 1.0)


@pytest.mark.parametrize("gradient", GRADIENTS.values(), ids=GRADIENTS)
def test_energy_and_forces_turn_with_the_frame(gradient: NDArray) -> None:
    body, nodes = element(MATERIALS["finite bulk modulus"])
    u, q = state(gradient, nodes)
    turned = (nodes + u) @ ROTATION.T - nodes
    before, _ = response(body, nodes, np.concatenate([u.ravel(), q]))
    after, _ = response(body, nodes, np.concatenate([turned.ravel(), q]))
    forces = before[:30].reshape(10, 3) @ ROTATION.T
    assert after[:30].reshape(10, 3) == pytest.approx(forces, abs=1e-13)
    assert after[30:] == pytest.approx(before[30:], abs=1e-14)
    energies = [element_energy(body, 0, nodes, w, q)[0] for w in (u, turned)]
    assert energies[0] == pytest.approx(energies[1], rel=1e-13)


def test_an_element_in_any_state_is_in_balance_of_forces_and_moments() -> None:
    body, nodes = element(MATERIALS["incompressible"])
    u, q = state(GRADIENTS["rotated and stretched"], nodes)
    residual, _ = response(body, nodes, np.concatenate([u.ravel(), q]))
    forces = residual[:30].reshape(10, 3)
    assert forces.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-14)
    assert np.cross(nodes + u, forces).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-14)


def test_small_strains_keep_their_digits() -> None:
    body, nodes = element(MATERIALS["incompressible"], curved=0.0)
    strain = np.array([[1.0, 0.3, 0.0], [0.3, -0.2, 0.1], [0.0, 0.1, -0.8]])
    energies = []
    for size in (1e-3, 1e-6, 1e-9):
        energy, volume = element_energy(body, 0, nodes, size * nodes @ strain, np.zeros(4))
        energies.append(energy / (volume * 3.47605 * size**2 * (strain**2).sum()))
    assert energies == pytest.approx([1.0, 1.0, 1.0], rel=2e-3)
    assert energies[1:] == pytest.approx([1.0, 1.0], rel=3e-6)
    assert energies[2] == pytest.approx(1.0, rel=5e-9)


def test_eigenvalues_are_accurate_for_nearly_equal_and_for_spread_spectra() -> None:
    for spectrum in ([1, 1, 1], [1, 1 + 1e-12, 2], [1e-9, 1e-9, -2e-9], [48.0, 1.0, 0.09]):
        exact = np.array(spectrum, float)
        matrix = ROTATION @ np.diag(exact) @ ROTATION.T
        matrix = (matrix + matrix.T) / 2
        rest, vectors = matrix.copy(), np.empty((3, 3))
        jacobi(rest, vectors)
        assert np.sort(np.diag(rest)) == pytest.approx(np.sort(exact), abs=1e-15 * abs(exact).max())
        assert vectors.T @ vectors == pytest.approx(np.eye(3), abs=1e-15)
        rebuilt = vectors @ np.diag(np.diag(rest)) @ vectors.T
        assert rebuilt == pytest.approx(matrix, abs=2e-15 * abs(exact).max())


def test_an_element_turned_inside_out_is_reported() -> None:
    body, nodes = element(MATERIALS["incompressible"])
    u = nodes @ (np.diag([1.0, 1.0, -1.0]) - np.eye(3))
    r, tangent = np.empty(34), np.empty((34, 34))
    assert element_response(body, 0, nodes, u, np.zeros(4), OWN, True, r, tangent) < 0
    assert np.isnan(element_energy(body, 0, nodes, u, np.zeros(4))[0])


PLAIN_PYTHON = """
import sys
import numpy as np
from numba import config
from solver.kernels.element import Solid, element_response
assert config.DISABLE_JIT
data = np.load(sys.argv[1])
body = Solid(*(data[f"solid_{i}"] for i in range(len(Solid._fields))))
r, k = np.empty(34), np.empty((34, 34))
element_response(body, 0, data["nodes"], data["u"], data["q"], np.empty((0, 6)), True, r, k)
np.savez(sys.argv[2], r=r, k=k)
"""


def test_compiled_kernels_equal_plain_python(tmp_path: Path) -> None:
    body, nodes = element(MATERIALS["Yeoh and Ogden, logarithmic"])
    u, q = state(GRADIENTS["rotated and stretched"], nodes)
    arrays = {f"solid_{i}": np.asarray(part) for i, part in enumerate(body)}
    np.savez(tmp_path / "in.npz", nodes=nodes, u=u, q=q, **arrays)
    root = Path(__file__).parents[3]
    subprocess.run(
        [sys.executable, "-c", PLAIN_PYTHON, tmp_path / "in.npz", tmp_path / "out.npz"],
        check=True,
        cwd=root,
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
    )
    plain = np.load(tmp_path / "out.npz")
    r, tangent = np.empty(34), np.empty((34, 34))
    element_response(body, 0, nodes, u, q, OWN, True, r, tangent)
    assert plain["r"] == pytest.approx(r, rel=1e-12, abs=1e-15)
    assert np.triu(plain["k"]) == pytest.approx(np.triu(tangent), rel=1e-12, abs=1e-14)
