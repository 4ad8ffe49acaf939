"""Kinds of values that calls which follow a path take."""

from __future__ import annotations

from solver.errors import SolverError
from solver.input_types import check_function, check_instance, shown
from solver.nonlinear.options import SolverOptions
from solver.problem.problem import Problem
from solver.results.solution import Solution


def check_arguments(problem: object, options: object, listener: object, after: object) -> None:
    """Raise ``SolverError`` unless they are of the kinds that ``solve`` takes."""
    check_instance("problem", problem, Problem)
    check_instance("options", options, SolverOptions, optional=True)
    check_function("listener", listener)
    check_instance("after", after, Solution, optional=True)


def check_initial(initial: object) -> None:
    """Raise ``SolverError`` unless it is None or two arrays."""
    if initial is not None and not (isinstance(initial, tuple | list) and len(initial) == 2):
        raise SolverError(
            "initial must be a pair of displacement (n, 3) and hydrostatic pressure (v,), got "
            f"{shown(initial)}."
        )
