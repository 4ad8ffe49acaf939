"""The laws' compiled functions, chosen by the number of a law in the table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from numba import njit

from solver.material.laws import LAWS


def _by_number(functions: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    """(number, *arguments) -> that function of the arguments: a compiled chain of comparisons."""
    first, rest = functions[0], functions[1:]
    if not rest:
        return njit(error_model="numpy")(lambda number, *arguments: first(*arguments))
    others = _by_number(rest)

    def chosen(number: int, *arguments: Any) -> Any:
        if number == 0:
            return first(*arguments)
        return others(number - 1, *arguments)

    return njit(error_model="numpy")(chosen)


law_energy = _by_number([law.implementation.energy for law in LAWS])
"""(law, e, constants) -> W; see ``solver.material.laws``."""

law_response = _by_number([law.implementation.response for law in LAWS])
"""(law, e, gaps, constants, stress, hessian, divided); see ``solver.material.laws``."""
