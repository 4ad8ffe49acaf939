"""Stability of an equilibrium, and the stiffness of its tip, from the tangent."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bellows_design.force.chain.balance import Balance
from solver.arrays import Reals

TIP_Z = 1


def stability_margin(balance: Balance, holding: NDArray[np.bool_], softest: float) -> float:
    """Least real part of an eigenvalue λ of (C⁻¹ + P'') v = λ C⁻¹ v among motions v that are free.

    C is the compliance of the pieces, which may be rigid: the eigenvalues are those of I + C P''.
    Those of motions that the hold forbids are left out by the projection along C Bᵀ, with B the
    derivative of what is held. With friction P'' is not symmetric, and a negative real part means
    that a small motion against damping in proportion to C⁻¹ grows.

    Minus infinity where a piece is unstable by itself. Its stiffness then passed through zero and
    its compliance through infinity. A compliance that is negative but smaller than ``softest``, the
    largest one at rest, is an error of an interpolated law, and is not taken for that.
    """
    if np.linalg.eigvalsh(balance.response.compliance).min() < -softest:
        return -np.inf
    return float(np.linalg.eigvals(_free_operator(balance, holding)).real.min())


def least_stable_motion(balance: Balance, holding: NDArray[np.bool_]) -> Reals:
    """The eigenvector of that eigenvalue (n, 3), whose largest rotation is one."""
    values, vectors = np.linalg.eig(_free_operator(balance, holding))
    motion = np.real(vectors[:, values.real.argmin()]).reshape(-1, 3)
    return np.asarray(motion / motion[np.abs(motion[:, 0]).argmax(), 0], dtype=np.float64)


def _free_operator(balance: Balance, holding: NDArray[np.bool_]) -> Reals:
    """I + C P'' among motions that the hold allows, and the identity among others."""
    rows = balance.tip_jacobian[holding]
    operator = balance.operator
    if not len(rows):
        return operator
    across = balance.flexed(rows.T)
    inverse = np.linalg.pinv(rows @ across)
    return operator - across @ (inverse @ (rows @ operator)) + across @ (inverse @ rows)


def tip_stiffness(balance: Balance, holding: NDArray[np.bool_]) -> float:
    """Force by displacement along z at the tip's lower edge, N/mm, other holds kept."""
    others = holding.copy()
    others[TIP_Z] = False
    rows = balance.tip_jacobian[others]
    size, count = len(balance.force), len(rows)
    across = balance.flexed(rows.T)
    matrix = np.block([[balance.operator, -across], [rows, np.zeros((count, count))]])
    push = balance.flexed(balance.tip_jacobian[TIP_Z][:, None])[:, 0]
    try:
        moved = np.linalg.solve(matrix, np.concatenate([push, np.zeros(count)]))[:size]
    except np.linalg.LinAlgError:  # other holds already keep all that could move
        return np.inf
    flexibility = float(balance.tip_jacobian[TIP_Z] @ moved)
    return 1 / flexibility if flexibility else np.inf
