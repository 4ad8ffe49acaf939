"""Which tests need a linear solver that counts negative eigenvalues, or feral in particular."""

from __future__ import annotations

import pytest

from solver.linear.feral import Feral
from solver.linear.solvers import linear_solver


def _has_feral() -> bool:
    try:
        Feral()
    except ImportError:
        return False
    return True


needs_inertia = pytest.mark.skipif(
    linear_solver("auto").name == "superlu", reason="SuperLU does not tell what is stable"
)
needs_feral = pytest.mark.skipif(not _has_feral(), reason="feral-solver is not installed")
