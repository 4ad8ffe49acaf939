"""From the equilibrium of one problem to that of a neighbouring one, at the whole load at once.

The problems differ by little: in the positions of nodes, the material, the loads. The state of the
first is a start for the second; a correction of it by the factorization of the first is the change
of the equilibrium to first order. What the connectivity of the mesh decides, the ordering of the
unknowns included, is kept from problem to problem.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from solver.assembly.state import State
from solver.errors import SolverError
from solver.nonlinear.attempts import Attempt, NoCorrection
from solver.nonlinear.call_checks import check_call
from solver.nonlinear.events import Listener
from solver.nonlinear.linear_system import LinearSystem
from solver.nonlinear.loading import Loading
from solver.nonlinear.newton import Newton
from solver.nonlinear.options import SolverOptions
from solver.paths.outcome import Path, solution_of
from solver.problem.problem import Problem
from solver.results.solution import Solution, check_solution
from solver.results.stress import Peak, peak_of

OPTIONS = SolverOptions(reuse=0.5)
"""Another iteration by the same factorization costs a quarter of a new one."""


@dataclass(frozen=True)
class Neighbouring:
    """The equilibrium of a neighbouring problem, or why none was found.

    Attributes:
        solution: with the only point of its path at the whole load; None if there is ``failure``.
        failure: why there is none, as text; empty if there is one.
        newton: what the next neighbour takes over.
        peak: the solution's largest stress.

    Examples:
        >>> from solver import Ogden, Problem, Supports, neighbouring, solve
        >>> from solver.mesh import block
        >>> bar, held = block((30, 4, 4), (6, 1, 1)), Supports(("x0", "x1"))
        >>> start = solve(Problem(bar, Ogden.neo_hooke(0.5), held, ("z1",)), 0.002)
        >>> stiffer = Problem(bar, Ogden.neo_hooke(0.52), held, ("z1",))
        >>> next_one = neighbouring(stiffer, 0.002, start)
        >>> print(next_one.failure or next_one.solution.message)
        reached 0.002 of 0.002 MPa.
    """

    solution: Solution | None
    failure: str
    newton: Newton
    peak: Peak | None = None


def neighbouring(
    problem: Problem,
    pressure: float,
    near: Solution,
    former: Newton | None = None,
    options: SolverOptions | None = None,
    at_hand: Newton | None = None,
    listener: Listener | None = None,
) -> Neighbouring:
    """Equilibrium of ``problem`` under ``pressure`` (MPa), from that of a neighbouring problem.

    Newton's method starts at the whole load from the state of ``near``, first corrected by the
    factorization at hand. What it finds is stable, as far as the linear solver can tell, and all
    its elements are admissible; whether it lies on the branch that the load leads to from zero is
    not known.

    Args:
        problem: on a mesh with the same tetrahedra and regions as that of ``near``; nodes,
            materials and loads may differ.
        pressure: on the pressurised surfaces.
        near: the equilibrium of the neighbouring problem.
        former: what the solve before left, of no use after this one; by default all is set up anew.
        options: tolerances and the linear solver.
        at_hand: what a solve left whose factorization is that of ``near``; by default ``former``.
        listener: called at every iteration; an exception of its ends the solve, and ``former`` is
            of no use either then.

    Raises:
        SolverError: invalid input, or a mesh with other tetrahedra or regions.

    Examples:
        >>> import numpy as np
        >>> from solver import Ogden, Problem, Supports, neighbouring, solve
        >>> from solver.mesh import block
        >>> bar, held = block((30, 4, 4), (6, 1, 1)), Supports(("x0", "x1"))
        >>> start = solve(Problem(bar, Ogden.neo_hooke(0.5), held, ("z1",)), 0.002)
        >>> longer_bar = bar.moved(bar.nodes * (1.02, 1, 1))
        >>> longer = Problem(longer_bar, Ogden.neo_hooke(0.5), held, ("z1",))
        >>> near, alone = neighbouring(longer, 0.002, start).solution, solve(longer, 0.002)
        >>> print(np.abs(near.displacement - alone.displacement).max() < 1e-3)
        True
        >>> print(near.newton_iterations < alone.newton_iterations)
        True
    """
    check_call(problem, options, None, None)
    check_solution(near)
    _check_same_cells(problem, near.problem)
    began = time.perf_counter()
    loading = Loading.of(problem, float(pressure))
    newton = Newton(problem, loading, options or OPTIONS, listener, former=former)
    start = newton.kinematics.start(near.displacement, near.hydrostatic_pressure)
    attempt = _found(newton, start, (at_hand or newton).system)
    if attempt.failure:
        newton.system.forget()
        return Neighbouring(None, attempt.failure, newton)
    newton.effort.load_steps += 1
    peak = peak_of(problem, attempt.state.displacement, newton.trusted)
    point = newton.point(attempt.state, 1.0, attempt.iterations, newton.system.stable, peak)
    solution = solution_of(newton, Path(attempt.state, (point,)), time.perf_counter() - began)
    return Neighbouring(solution, "", newton, peak)


def _found(newton: Newton, start: State, at_hand: LinearSystem) -> Attempt:
    """The equilibrium at the whole load from ``start``, by way of its first-order change."""
    tolerance = newton.options.tolerance
    if at_hand.factorized:
        try:
            change = newton.correction(start, 1.0, at_hand)
        except NoCorrection:
            return newton.correct(start, 1.0, tolerance)
        moved = newton.correct(change.moved, 1.0, tolerance, previous=newton.distance(change))
        if not moved.failure:
            return moved
    return newton.correct(start, 1.0, tolerance)


def _check_same_cells(problem: Problem, other: Problem) -> None:
    """Raise ``SolverError`` unless two problems' meshes have the same connectivity."""
    ours, theirs = problem.mesh.tets, other.mesh.tets
    if ours is not theirs and not np.array_equal(ours, theirs):
        raise SolverError("near: the mesh must have the same tetrahedra as that of the problem.")
    if not np.array_equal(problem.mesh.tet_vertices, other.mesh.tet_vertices):
        raise SolverError("near: the mesh must have the same regions as that of the problem.")
    if problem.moving_plane != other.moving_plane:
        raise SolverError(
            f"near: the moving plane is {problem.moving_plane!r}, that of the neighbour "
            f"{other.moving_plane!r}; it must be the same."
        )
