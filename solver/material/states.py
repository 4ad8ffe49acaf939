"""Any law's stress and stiffness at many homogeneous states at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solver.arrays import Reals
from solver.material.by_number import law_response
from solver.material.constants import Constants
from solver.numerics.compiled import compiled


class Responses(NamedTuple):
    """Derivatives of the energy at n states, MPa; see ``solver.material.laws``.

    ``stress`` (n, 3), ``hessian`` (n, 3, 3); ``divided`` (n, 3) of the pairs 01, 12, 20.
    """

    stress: Reals
    hessian: Reals
    divided: Reals


def responses(logs: Reals, constants: Constants) -> Responses:
    """At isochoric principal log stretches (n, 3), in any order."""
    logs = np.ascontiguousarray(logs, float)
    count = len(logs)
    result = Responses(np.empty((count, 3)), np.empty((count, 3, 3)), np.empty((count, 3)))
    _fill(constants.number, logs, constants.values, *result)
    return result


@compiled()
def _fill(
    law: int, logs: Reals, values: Reals, stress: Reals, hessian: Reals, divided: Reals
) -> None:
    gaps = np.empty(3)
    for state in range(logs.shape[0]):
        for i in range(3):
            gaps[i] = logs[state, i] - logs[state, (i + 1) % 3]
        law_response(law, logs[state], gaps, values, stress[state], hessian[state], divided[state])
