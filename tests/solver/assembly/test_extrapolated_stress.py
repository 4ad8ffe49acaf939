"""The stress that the geometric part of a tangent on the way is formed with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from solver import Mesh, Ogden, Problem, SlenderAxis, SolverOptions, Supports, solve
from solver.assembly.assembly import Assembly
from solver.assembly.state import State

Meshes = Callable[..., Mesh]
MATERIALS = (
    Ogden((0.19825, 3.2778), (3.05, -0.0054)),
    Ogden((0.4, 0.3), (-1.5, 3.0), 5.0, (0.1, 0.02, -0.001), "logarithmic"),
)


def body(box: Meshes, material: Ogden) -> tuple[Assembly, State, State]:
    """A bent block with pressures inside, and a step from there."""
    mesh = box((2, 1, 1), (2.0, 1.0, 1.0), distortion=0.2)
    random = np.random.default_rng(2)
    x, y, z = mesh.nodes.T
    bent = 0.1 * np.stack([x * z, -y * z, -(x**2) / 2], axis=1)
    bent += random.uniform(-0.01, 0.01, mesh.nodes.shape)
    step = random.uniform(-1.0, 1.0, mesh.nodes.shape)
    pressures = random.uniform(-0.4, 0.4, (2, len(mesh.vertices)))
    problem = Problem(mesh, material, Supports(clamped=("x0",)), ("x1",))
    return Assembly(problem), State(bent, pressures[0]), State(step, pressures[1])


@pytest.mark.parametrize("material", MATERIALS)
def test_without_a_step_it_gives_the_states_own_tangent(box: Meshes, material: Ogden) -> None:
    assembly, state, step = body(box, material)
    stress = assembly.extrapolated_stress(state, step.scaled(0.0))
    given = assembly.evaluate(replace(state, geometric_stress=stress), 0.1)
    own = assembly.evaluate(state, 0.1)
    assert given.tangent == pytest.approx(own.tangent, rel=1e-11, abs=1e-11)
    assert np.array_equal(given.residual, own.residual)


@pytest.mark.parametrize("material", MATERIALS)
def test_it_is_the_stress_after_a_step_to_first_order(box: Meshes, material: Ogden) -> None:
    assembly, state, step = body(box, material)
    none = step.scaled(0.0)

    def after(length: float) -> np.ndarray:
        moved = State(
            state.displacement + length * step.displacement,
            state.hydrostatic_pressure + length * step.hydrostatic_pressure,
        )
        return assembly.extrapolated_stress(moved, none)

    slope = (after(1e-6) - after(-1e-6)) / 2e-6
    given = assembly.extrapolated_stress(state, step) - assembly.extrapolated_stress(state, none)
    assert given == pytest.approx(slope, abs=1e-7 * abs(slope).max())


def test_it_turns_with_the_body(box: Meshes) -> None:
    """Second Piola-Kirchhoff stress does not notice a rotation."""
    assembly, state, step = body(box, MATERIALS[0])
    turn = np.linalg.qr(np.array([[1.0, 2.0, 0.5], [-1.0, 0.3, 2.0], [0.2, 1.0, 1.0]]))[0]
    turn *= np.linalg.det(turn)
    nodes = assembly.problem.mesh.nodes
    turned = State((nodes + state.displacement) @ turn.T - nodes, state.hydrostatic_pressure)
    along = State(step.displacement @ turn.T, step.hydrostatic_pressure)
    stress = assembly.extrapolated_stress(state, step)
    assert assembly.extrapolated_stress(turned, along) == pytest.approx(stress, rel=1e-9, abs=1e-9)


@pytest.mark.thorough
def test_the_way_of_a_slender_body_hardly_depends_on_its_load_steps(
    bellows: Meshes, ninjaflex: Ogden
) -> None:
    mesh = bellows(8)
    axis = SlenderAxis((0.0, *(2.0 + 1.4 * np.arange(15)), mesh.nodes[:, 0].max()))
    supports = Supports(clamped=("root",), symmetry={"symmetry": 1})
    problem = Problem(mesh, ninjaflex, supports, ("cavity",), axis=axis)
    firsts = (0.05, 0.1, 0.2)
    ends = [solve(problem, 0.36, SolverOptions(first_step=first)) for first in firsts]
    assert all(end.converged and end.refused_steps == 0 for end in ends)
    # 19, 17 and 14; with own tangents alone 28, 29 and 20, and refused steps
    assert max(end.factorizations for end in ends) <= 21
    for end in ends[1:]:
        assert end.displacement == pytest.approx(ends[0].displacement, abs=1e-4)
