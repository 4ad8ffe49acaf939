"""Addition of element vectors and matrices to the global ones."""

from __future__ import annotations

from solver.arrays import Integers, Reals
from solver.numerics.compiled import compiled


@compiled()
def mirror_upper(k: Reals) -> None:
    """Copy the upper triangle of a square matrix to its lower one."""
    for i in range(k.shape[0]):
        for j in range(i):
            k[i, j] = k[j, i]


@compiled()
def scatter(
    r: Reals,
    k: Reals,
    dofs: Integers,
    entries: Integers,
    factor: float,
    tangent: bool,
    residual: Reals,
    values: Reals,
) -> None:
    """Add r (m,) to ``residual``, ``factor`` times the upper half of k (m, m) to ``values``."""
    entry = 0
    for i in range(r.size):
        if dofs[i] >= 0:
            residual[dofs[i]] += r[i]
        if tangent:
            for j in range(i, r.size):
                if entries[entry] >= 0:
                    values[entries[entry]] += factor * k[i, j]
                entry += 1
