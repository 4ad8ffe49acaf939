"""Which tests need a linear solver that counts negative eigenvalues: SuperLU does not."""

from __future__ import annotations

import pytest

from solver.linear.solvers import linear_solver

needs_inertia = pytest.mark.skipif(
    linear_solver("auto").name == "superlu", reason="SuperLU does not tell what is stable"
)
