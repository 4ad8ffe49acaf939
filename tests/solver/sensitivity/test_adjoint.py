"""Factorizations at hand, states near limit points, and what is refused."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest
from meshes import bellows_cell_mesh, box_mesh, sphere_mesh
from resolved import TIGHT

from solver import (
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    gradients,
    inflate,
    nodal_von_mises,
    peak_von_mises,
    sensitivities,
    solve,
)
from solver.assembly.assembly import Assembly, Equilibrium
from solver.assembly.state import State
from solver.errors import SolverError
from solver.linear.interface import SingularMatrix
from solver.nonlinear.linear_system import LinearSystem
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.sensitivity.adjoint import Tangent, Workspace
from solver.sensitivity.smooth_peak import SmoothPeak

RUBBER = Ogden((0.2, 3.3), (3.05, -0.0054))


def cell_problem() -> Problem:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    return Problem(bellows_cell_mesh(), RUBBER, supports, ("cavity",), moving_plane="x1")


@pytest.fixture(scope="module")
def bent() -> Solution:
    return solve(cell_problem(), 0.1, TIGHT)


@dataclass
class AtHand:
    """An assembly and a factorization of some state."""

    assembly: Assembly
    system: LinearSystem

    @staticmethod
    def of(problem: Problem, state: State, pressure: float) -> AtHand:
        assembly = Assembly(problem)
        system = LinearSystem(assembly, "auto")
        system.factorize(assembly.evaluate(state, pressure))
        return AtHand(assembly, system)


@pytest.mark.parametrize(("share", "factorizations"), [(1.0, 0), (0.9999, 0), (0.9, 1), (0.0, 1)])
def test_a_factorization_of_an_earlier_state_gives_the_same_derivatives(
    bent: Solution, share: float, factorizations: int
) -> None:
    """By refinement against the tangent of the state itself; a far one is replaced."""
    velocity = bent.problem.mesh.nodes * [0, 0, 1]
    fresh = sensitivities(bent, {"height": velocity})
    assert fresh.factorizations == 1 and not fresh.warnings
    before = solve(bent.problem, share * 0.1, TIGHT)
    hand = AtHand.of(bent.problem, before.state, share * 0.1)
    found = sensitivities(bent, {"height": velocity}, workspace=hand)
    assert found.factorizations == factorizations and found.adjoint_residual < 1e-9
    for response, row in found.derivatives.items():
        assert row == pytest.approx(fresh.derivatives[response], rel=1e-8), response


def test_newtons_method_is_a_workspace(bent: Solution) -> None:
    newton = Newton(bent.problem, Loading.of(bent.problem, 0.1), SolverOptions())
    newton.factorize(newton.evaluate(bent.state, 1.0))
    found = gradients(bent, newton, ("rotation",))
    assert found.factorizations == 0
    assert found.responses["rotation"].pressure == pytest.approx(
        gradients(bent).responses["rotation"].pressure, rel=1e-9
    )


def test_a_system_without_any_factorization_is_factorized(bent: Solution) -> None:
    newton = Newton(bent.problem, Loading.of(bent.problem, 0.1), SolverOptions())
    found = gradients(bent, newton, ("rotation",))
    assert found.factorizations == 1


@pytest.mark.parametrize("transposed", [False, True])
def test_products_with_the_tangent_are_those_of_the_factorized_matrix(transposed: bool) -> None:
    """Also where it is not symmetric, as with a free rim."""
    problem = Problem(box_mesh(), Ogden.neo_hooke(1.0, 10.0), Supports(("x0",)), ("z0",))
    hand = AtHand.of(problem, State.zero(problem), 0.05)
    equilibrium = hand.assembly.evaluate(State.zero(problem), 0.05)
    vector = np.random.default_rng(3).normal(size=hand.assembly.numbering.size)
    solved = hand.system.solve(vector, transposed)
    assert not hand.assembly.symmetric
    assert Tangent.of(equilibrium).times(solved, transposed) == pytest.approx(vector, abs=1e-9)
    other = Tangent.of(equilibrium).times(solved, not transposed)
    assert np.abs(other - vector).max() > 1e-3


def test_what_a_rough_solve_leaves_is_what_it_changes(bent: Solution) -> None:
    """``remaining`` is the first-order way from the state that was found to the equilibrium."""
    random = np.random.default_rng(4).normal(size=bent.hydrostatic_pressure.shape)
    off = replace(bent, hydrostatic_pressure=bent.hydrostatic_pressure + 1e-6 * random)
    found = gradients(off, responses=("volume",)).responses["volume"]
    assert abs(found.remaining) < 1e-9 * found.value  # pressures alone do not move the volume


def balloon() -> Problem:
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    return Problem(sphere_mesh(10.0, 11.0, 1, 2), Ogden.neo_hooke(1.0), supports, ("inside",))


@pytest.mark.parametrize("volume", [1.9, 2.42, 2.55])
def test_reach_is_the_distance_to_the_limit_point(volume: float) -> None:
    """Of a balloon whose pressure has a maximum; a warning says so where it is near."""
    problem = balloon()
    start = np.pi * 10.0**3 / 6
    limit = inflate(problem, 3.5 * start, TIGHT).limit
    solution = inflate(problem, volume * start, TIGHT)
    assert limit is not None and solution.converged
    found = sensitivities(solution)
    distance = limit / solution.pressure - 1
    assert found.reach == pytest.approx(distance, rel=0.4)
    assert ["near a limit point" in each for each in found.warnings] == [True] * (volume > 2)


def test_a_singular_tangent_is_refused(bent: Solution) -> None:
    class Singular:
        factorized = False

        def factorize(self, equilibrium: Equilibrium) -> None:
            raise SingularMatrix("a pivot is zero")

    hand = SimpleNamespace(assembly=Assembly(bent.problem), system=Singular())
    with pytest.raises(SolverError, match=r"tangent is singular at this state.*pivot is zero"):
        gradients(bent, hand)


def test_solutions_that_are_none_are_refused(bent: Solution) -> None:
    with pytest.raises(SolverError, match="did not converge"):
        gradients(replace(bent, converged=False, message="stopped."))
    with pytest.raises(SolverError, match="between two stages"):
        gradients(replace(bent, remaining_force=np.zeros_like(bent.displacement)))
    hand: Workspace = AtHand.of(cell_problem(), bent.state, 0.1)
    with pytest.raises(SolverError, match="workspace belongs to another problem"):
        gradients(bent, hand)


def test_what_is_asked_for_must_be_there(bent: Solution) -> None:
    with pytest.raises(SolverError, match="no response 'angle'; it has rotation, volume, peak_str"):
        gradients(bent, responses=("angle",))
    with pytest.raises(SolverError, match=r"sharpness = 1 must be above 1"):
        gradients(bent, sharpness=1.0)
    with pytest.raises(SolverError, match=r"counted must be a truth value for each of the \d+ nod"):
        gradients(bent, counted=np.ones(3, bool))
    with pytest.raises(SolverError, match="'pressure' stands there twice"):
        sensitivities(bent, {"pressure": bent.displacement})


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda nodes: nodes[:, :2], r"of the shape \(\d+, 3\), got \(\d+, 2\)"),
        (lambda nodes: np.full_like(nodes, np.nan), "must be finite"),
        (lambda nodes: nodes[:, [2, 2, 2]], "move all nodes of the moving plane alike along x"),
    ],
)
def test_velocities_that_fit_no_problem_are_refused(
    bent: Solution, change: object, text: str
) -> None:
    with pytest.raises(SolverError, match=text):
        gradients(bent).along(change(bent.problem.mesh.nodes))  # type: ignore[operator]


@pytest.mark.parametrize("sharpness", [8.0, 64.0, 400.0])
def test_the_smooth_peak_tends_to_the_peak_from_above(bent: Solution, sharpness: float) -> None:
    peak: SmoothPeak = gradients(bent, sharpness=sharpness).smooth_peak
    count = len(bent.problem.mesh.nodes)
    assert peak.peak == pytest.approx(peak_von_mises(bent).value, rel=1e-12)
    values = nodal_von_mises(bent) / peak.peak
    exact = float((values**sharpness).sum() ** (1 / sharpness))
    assert peak.ratio == pytest.approx(exact, rel=1e-10)
    assert 1 <= peak.ratio <= count ** (1 / sharpness)


def test_only_nodes_that_count_have_a_part_in_the_peak(bent: Solution) -> None:
    values = nodal_von_mises(bent)
    low = values < np.median(values)
    found = gradients(bent, responses=("peak_stress",), counted=low)
    assert found.smooth_peak.peak == pytest.approx(values[low].max(), rel=1e-12)
