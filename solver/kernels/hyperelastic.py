"""Kirchhoff stress and its tangent in principal axes, for any law of the table."""

from __future__ import annotations

import math

import numpy as np

from solver.arrays import Reals
from solver.material.by_number import law_response
from solver.numerics.compiled import compiled
from solver.numerics.special_functions import x_coth_x


@compiled()
def shear_stiffness(divided: float, gap: float, stress_sum: float) -> float:
    """(tau_i l_j^2 - tau_j l_i^2) / (l_i^2 - l_j^2), l = stretches with log gap ``gap``."""
    return 0.5 * divided * x_coth_x(gap) - 0.5 * stress_sum


@compiled()
def principal_response(
    law: int,
    logs: Reals,
    b: Reals,
    spherical: float,
    constants: Reals,
    stress: Reals,
    normal: Reals,
    shear: Reals,
) -> None:
    """Kirchhoff stress and its spatial tangent in principal axes.

    ``logs`` and the diagonal of ``b`` as ``spectrum`` fills them; ``spherical`` = -q J is added
    to the deviatoric part. Fills ``stress`` (3,), ``normal`` (3, 3) = d tau_i / d ln(l_j)
    - 2 tau_i delta_ij, and ``shear`` (3,) of the pairs (0, 1) (1, 2) (2, 0).
    """
    gaps = np.empty(3)
    for i in range(3):
        j = (i + 1) % 3
        gaps[i] = 0.5 * math.log1p((b[i, i] - b[j, j]) / (1.0 + b[j, j]))
    law_response(law, logs, gaps, constants, stress, normal, shear)
    _make_deviatoric(spherical, stress, normal)
    for i in range(3):
        shear[i] = shear_stiffness(shear[i], gaps[i], stress[i] + stress[(i + 1) % 3])


@compiled()
def _make_deviatoric(spherical: float, stress: Reals, normal: Reals) -> None:
    """From derivatives of the energy to Kirchhoff stress and ``normal``, in place.

    With P the projection on deviators, H = ``normal`` becomes P H P, to which the derivatives of
    -q J and of the stress measure are added.
    """
    rows = np.empty(3)
    for i in range(3):
        rows[i] = normal[i, 0] + normal[i, 1] + normal[i, 2]
    mean_stress = (stress[0] + stress[1] + stress[2]) / 3.0
    mean_stiffness = (rows[0] + rows[1] + rows[2]) / 9.0
    for i in range(3):
        stress[i] += spherical - mean_stress
    for i in range(3):
        for j in range(3):
            own = normal[i, j] - 2.0 * stress[i] if i == j else normal[i, j]
            normal[i, j] = spherical + mean_stiffness - (rows[i] + rows[j]) / 3.0
            normal[i, j] += own
