"""Kinds of values that are common to all paths: ``solve``, ``trace`` and ``inflate``."""

from __future__ import annotations

from solver.errors import SolverError
from solver.input_types import check_function, check_instance, shown
from solver.nonlinear.checkpoint import Checkpoint
from solver.nonlinear.options import SolverOptions
from solver.problem.problem import Problem
from solver.results.solution import Solution


def check_call(
    problem: object, options: object, listener: object, after: object, resume: object = None
) -> None:
    """Raise ``SolverError`` for another kind of value than belongs there."""
    check_instance("problem", problem, Problem)
    check_instance("options", options, SolverOptions, optional=True)
    check_function("listener", listener, "an Event")
    check_instance("after", after, Solution, optional=True)
    check_instance("resume", resume, Checkpoint, optional=True)


def check_initial(initial: object) -> None:
    """Raise ``SolverError`` unless it is a pair, whose members are checked with the mesh."""
    if initial is not None and not (isinstance(initial, tuple | list) and len(initial) == 2):
        raise SolverError(
            "initial must be a pair of displacements (n, 3) in mm and hydrostatic pressures (v,) "
            f"in MPa, got {shown(initial)}."
        )
