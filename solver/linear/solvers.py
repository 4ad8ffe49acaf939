"""The linear solvers by name: PARDISO where it exists, SuperLU anywhere."""

from __future__ import annotations

from solver.linear.interface import LinearSolver
from solver.linear.pardiso import Pardiso
from solver.linear.superlu import SuperLU

NAMES = ("auto", "pardiso", "superlu")


def linear_solver(name: str = "auto") -> LinearSolver:
    """The solver called ``name``; ``auto``: PARDISO if MKL can be loaded, else SuperLU.

    Raises ``ValueError`` for another name and ``ImportError`` when PARDISO was asked for by name
    and cannot be loaded.
    """
    if name not in NAMES:
        raise ValueError(f"linear_solver must be one of {', '.join(NAMES)}, got {name!r}.")
    if name == "superlu":
        return SuperLU()
    try:
        return Pardiso()
    except ImportError:
        if name != "auto":
            raise
        return SuperLU()
