"""The linear solvers by name, and which of them ``auto`` is."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from solver.errors import SolverError
from solver.linear.fallback import Fallback
from solver.linear.feral import Feral
from solver.linear.interface import LinearSolver
from solver.linear.pardiso import Pardiso
from solver.linear.superlu import SuperLU

SOLVERS: dict[str, Callable[[], LinearSolver]] = {
    "pardiso": Pardiso,
    "feral": lambda: Fallback(Feral(), SuperLU()),
    "superlu": SuperLU,
}
"""Where feral refuses a matrix SuperLU factorizes it, which does not know its inertia."""


def linear_solver(name: str = "auto") -> LinearSolver:
    """The solver called ``name``; ``auto``: PARDISO if MKL can be loaded, else feral, else SuperLU.

    Raises ``SolverError`` for another name and ``ImportError`` when a solver was asked for by name
    and cannot be loaded.
    """
    if name == "auto":
        return _first_that_loads()
    if name not in SOLVERS:
        known = ", ".join(("auto", *SOLVERS))
        raise SolverError(f"linear_solver must be one of {known}, got {name!r}.")
    return SOLVERS[name]()


def _first_that_loads() -> LinearSolver:
    for name in ("pardiso", "feral"):
        with suppress(ImportError):
            return SOLVERS[name]()
    return SuperLU()
