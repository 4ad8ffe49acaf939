"""Mooney-Rivlin with five constants: digits, derivatives, special cases, stability, a block."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal, getcontext

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, SolverOptions, Supports, Traction, solve
from solver.assembly.assembly import Assembly
from solver.assembly.state import State
from solver.errors import SolverError
from solver.material.homogeneous import MODES, UNIAXIAL, nominal_stress
from solver.material.mooney_rivlin import MooneyRivlin
from solver.material.stability import drucker_margin, shear_margin, stability
from solver.material.states import responses

getcontext().prec = 50
Meshes = Callable[..., Mesh]
MIXED = MooneyRivlin(0.3, -0.05, 0.02, -0.01, 0.004)
"""Constants of either sign."""

STATES = np.array([[0.5, -0.1, -0.4], [0.3, 0.3, -0.6], [1e-6, 2e-6, -3e-6], [0.0, 0.0, 0.0]])


def by_definition(material: MooneyRivlin, logs: list[Decimal]) -> Decimal:
    """W in 50 digits, as the textbook has it."""
    x = sum((2 * e).exp() for e in logs) - 3
    y = sum((-2 * e).exp() for e in logs) - 3
    c10, c01, c20, c11, c02 = (Decimal(value) for value in material.values)
    return c10 * x + c01 * y + c20 * x**2 + c11 * x * y + c02 * y**2


@pytest.mark.parametrize("size", ["1e-9", "1e-4", "0.3", "1.5"])
def test_the_energy_keeps_the_digits_of_its_definition(size: str) -> None:
    logs = [Decimal(size), Decimal(size) / 3, -Decimal(size) * 4 / 3]
    exact = by_definition(MIXED, logs)
    assert MIXED.energy([float(e) for e in logs]) == pytest.approx(float(exact), rel=1e-13)


@pytest.mark.parametrize("stretch", ["0.3", "0.9999999", "1.001", "1.5", "4"])
def test_the_nominal_stress_keeps_the_digits_of_its_definition(stretch: str) -> None:
    """P = 2 (λ₁² − λ₃²)/λ W₁ − 2 (λ₁⁻² − λ₃⁻²)/λ W₂."""
    exact = Decimal(float(stretch))
    c10, c01, c20, c11, c02 = (Decimal(value) for value in MIXED.values)
    for mode in MODES.values():
        squares = [exact ** (2 * Decimal(exponent)) for exponent in mode.exponents]
        x, y = sum(squares) - 3, sum(1 / square for square in squares) - 3
        first, second = c10 + 2 * c20 * x + c11 * y, c01 + c11 * x + 2 * c02 * y
        differences = squares[0] - squares[2], 1 / squares[0] - 1 / squares[2]
        expected = 2 * (first * differences[0] - second * differences[1]) / exact
        ours = nominal_stress(mode, np.array([float(stretch)]), MIXED.constants)[0]
        assert ours == pytest.approx(float(expected), rel=1e-12)


def test_stress_and_stiffness_are_the_derivatives_of_the_energy() -> None:
    directions = np.array([[2.0, -1.0, -1.0], [0.0, 1.0, -1.0]])
    step = 1e-4
    for logs in STATES[:2]:
        found = responses(logs[None], MIXED.constants)
        for along in directions:
            ahead, behind = (MIXED.energy(logs + s * along) for s in (step, -step))
            slope, curvature = ahead - behind, ahead - 2 * MIXED.energy(logs) + behind
            assert slope / (2 * step) == pytest.approx(float(found.stress[0] @ along), rel=1e-6)
            exact = float(along @ found.hessian[0] @ along)
            assert curvature / step**2 == pytest.approx(exact, rel=1e-5)


def test_divided_differences_are_those_of_the_stress_and_exact_where_stretches_are_equal() -> None:
    found = responses(STATES, MIXED.constants)
    stress, logs = found.stress[0], STATES[0]
    quotients = [(stress[i] - stress[j]) / (logs[i] - logs[j]) for i, j in ((0, 1), (1, 2), (2, 0))]
    assert found.divided[0] == pytest.approx(quotients, rel=1e-12)
    slope = found.hessian[1, 0, 0] - found.hessian[1, 0, 1]
    assert found.divided[1, 0] == pytest.approx(slope, rel=1e-13)
    assert found.divided[3] == pytest.approx(2 * MIXED.shear_modulus, rel=1e-15)


def test_two_constants_are_ogdens_mooney_rivlin_and_two_others_yeohs() -> None:
    pairs = (
        (MooneyRivlin(0.3, 0.1), Ogden.mooney_rivlin(0.3, 0.1)),
        (MooneyRivlin(0.3, c20=-0.02), Ogden.yeoh(0.3, -0.02)),
    )
    for ours, theirs in pairs:
        assert ours.shear_modulus == pytest.approx(theirs.shear_modulus)
        for logs in STATES:
            assert ours.energy(logs) == pytest.approx(theirs.energy(logs), rel=1e-13)
            stresses = theirs.principal_stresses(logs)
            assert ours.principal_stresses(logs) == pytest.approx(stresses, rel=1e-12, abs=1e-20)
        for margin in (drucker_margin, shear_margin):
            others = margin(STATES, theirs.constants)
            assert margin(STATES, ours.constants) == pytest.approx(others, rel=1e-12)


def test_positive_constants_are_stable_in_every_test() -> None:
    """Both invariants and their products are convex along the tests."""
    assert stability(MooneyRivlin(0.2, 0.05, 0.01, 0.0, 0.01).constants).everywhere


@pytest.mark.parametrize(
    "material", [MIXED, MooneyRivlin(0.3, c11=-0.02), MooneyRivlin(0.4, 0.1, -0.01, 0.0, 0.0)]
)
def test_constants_of_mixed_signs_are_stable_up_to_where_the_energy_loses_its_convexity(
    material: MooneyRivlin,
) -> None:
    """Against second differences of the energy on either side of the end that is stated."""
    found = stability(material.constants)
    assert not found.everywhere and found.shear_modulus == pytest.approx(material.shear_modulus)
    for each in found.ranges:
        for end, out in ((each.lowest, 0.999), (each.highest, 1.001)):
            if 0.1 < end < 10:
                assert convex(material, each.mode, end / out)
                assert not convex(material, each.mode, end * out)


def convex(material: MooneyRivlin, mode: str, stretch: float) -> bool:
    """Whether the energy curves upwards in all isochoric directions, and shear is resisted."""
    logs = np.log(stretch) * np.array(MODES[mode].exponents)
    basis = np.array([[2.0, -1.0, -1.0], [0.0, 3**0.5, -(3**0.5)]]) / 6**0.5
    step = 1e-4
    curvature = np.empty((2, 2))
    for i, a in enumerate(basis):
        for j, b in enumerate(basis):
            corners = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
            total = sum(p * q * material.energy(logs + step * (p * a + q * b)) for p, q in corners)
            curvature[i, j] = total / (4 * step**2)
    stress = material.principal_stresses(logs)
    pairs = [(i, j) for i, j in ((0, 1), (1, 2), (2, 0)) if abs(logs[i] - logs[j]) > 1e-9]
    shear = min((stress[i] - stress[j]) / (logs[i] - logs[j]) for i, j in pairs)
    return bool(np.linalg.eigvalsh(curvature)[0] > 0 and shear > 0)


def test_the_tangent_of_a_body_is_the_derivative_of_its_residual(box: Meshes) -> None:
    mesh = box((1, 1, 1), distortion=0.2)
    problem = Problem(mesh, MIXED, Supports(clamped=("x0",)), ("x1",))
    assembly, random = Assembly(problem), np.random.default_rng(2)
    displacement = 0.05 * random.standard_normal(mesh.nodes.shape)
    displacement[mesh.surface_nodes("x0")] = 0.0
    state = State(displacement, 0.1 * random.standard_normal(len(mesh.vertices)))
    here = assembly.evaluate(state, 0.0)
    vector = random.standard_normal(assembly.numbering.size)
    move = State(*assembly.numbering.expand(vector))

    def residual(step: float) -> np.ndarray:
        moved = State(
            state.displacement + step * move.displacement,
            state.hydrostatic_pressure + step * move.hydrostatic_pressure,
        )
        return assembly.evaluate(moved, 0.0, tangent=False).residual

    from scipy.sparse import csr_array, triu

    upper = csr_array((here.tangent, here.pattern.indices, here.pattern.indptr))
    exact = (upper + triu(upper, 1).T) @ vector
    numerical = (residual(1e-5) - residual(-1e-5)) / 2e-5
    assert numerical == pytest.approx(exact, abs=1e-6 * np.abs(exact).max())


def test_a_pulled_block_stretches_as_the_closed_form_says(box: Meshes) -> None:
    stretch = 1.8
    mesh = box((1, 1, 1))
    nominal = float(nominal_stress(UNIAXIAL, np.array([stretch]), MIXED.constants)[0])
    problem = Problem(
        mesh,
        MIXED,
        Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}),
        loads=(Traction("x1", (nominal, 0.0, 0.0)),),
    )
    solution = solve(problem, options=SolverOptions(tolerance=1e-9, maximum_iterations=40))
    assert solution.converged, solution.message
    expected = mesh.nodes * (np.array([stretch, stretch**-0.5, stretch**-0.5]) - 1)
    assert solution.displacement == pytest.approx(expected, abs=1e-7)


@pytest.mark.parametrize(
    ("constants", "words"),
    [
        ((float("nan"),), "constants must be finite"),
        ((0.1, -0.2), "initial shear modulus 2 \\(c10 \\+ c01\\) must be positive, got -0.2 MPa"),
        ((0.1, 0.0, 0.0, 0.0, 0.0, -1.0), "bulk_modulus must be positive"),
    ],
)
def test_what_is_no_material_is_refused(constants: tuple[float, ...], words: str) -> None:
    with pytest.raises(SolverError, match=words):
        MooneyRivlin(*constants)
