"""The linear solvers by name, and which of them ``auto`` is."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from solver.errors import SolverError
from solver.linear.fallback import Fallback
from solver.linear.feral import Feral
from solver.linear.interface import LinearSolver
from solver.linear.pardiso import GeneralPardiso, Pardiso
from solver.linear.superlu import SuperLU

SOLVERS: dict[str, Callable[[], LinearSolver]] = {
    "pardiso": Pardiso,
    "feral": lambda: Fallback(Feral(), SuperLU()),
    "superlu": SuperLU,
}
"""Where feral refuses a matrix SuperLU factorizes it, which does not know its inertia."""


GENERAL_SOLVERS: dict[str, Callable[[], LinearSolver]] = {
    "pardiso": GeneralPardiso,
    "feral": SuperLU,
    "superlu": SuperLU,
}
"""For matrices that are not symmetric, which feral cannot take."""


def linear_solver(name: str = "auto", symmetric: bool = True) -> LinearSolver:
    """The solver called ``name``; ``auto``: PARDISO if MKL can be loaded, else feral, else SuperLU.

    Unless ``symmetric``, one that takes other matrices; its own name says which. Raises
    ``SolverError`` for another name and ``ImportError`` when a solver was asked for by name and
    cannot be loaded.
    """
    solvers = SOLVERS if symmetric else GENERAL_SOLVERS
    if name == "auto":
        return _first_that_loads(solvers)
    if name not in solvers:
        known = ", ".join(("auto", *solvers))
        raise SolverError(f"linear_solver must be one of {known}, got {name!r}.")
    return solvers[name]()


def _first_that_loads(solvers: dict[str, Callable[[], LinearSolver]]) -> LinearSolver:
    for name in ("pardiso", "feral"):
        with suppress(ImportError):
            return solvers[name]()
    return SuperLU()
