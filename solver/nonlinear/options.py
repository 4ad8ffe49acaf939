"""How a load is applied: sizes of steps, tolerances, the linear solver."""

from __future__ import annotations

from dataclasses import dataclass

from solver.errors import SolverError

FIRST_STEP = 0.1
"""Of the load, where no other is asked for."""


@dataclass(frozen=True)
class SolverOptions:
    """How the load is applied.

    Steps are fractions of the asked load. Without a ``first_step`` it is a tenth, or along an axis
    as much as would move the body by its own diagonal if it went on as it begins. A load counts as
    reached when the last Newton correction moved no node by more than ``tolerance``, in units of
    the body's diagonal; what is left after that correction is far smaller. Below the asked load
    ``loose_tolerance`` will do, or a twentieth of a mean edge of the mesh if that is less (a
    slender body is stiff against what is small against its length), of a correction by the state's
    own tangent. At the asked load a factorization is used again after a correction that was smaller
    than the one before by the factor ``reuse``; 0 is never.
    """

    first_step: float | None = None
    growth: float = 2.0
    cut: float = 0.35
    smallest_step: float = 1e-3
    maximum_iterations: int = 12
    tolerance: float = 1e-5
    loose_tolerance: float = 5e-3
    reuse: float = 0.25
    linear_solver: str = "auto"

    def __post_init__(self) -> None:
        for name, low, high in OPTION_BOUNDS:
            value = getattr(self, name)
            if name == "first_step" and value is None:
                continue
            if value is None or not low < value <= high:
                raise SolverError(
                    f"solver: {name} must be above {low} and at most {high}, got {value}."
                )


OPTION_BOUNDS = (
    ("first_step", 0, 1),
    ("growth", 1, 10),
    ("cut", 0, 0.9),
    ("smallest_step", 0, 1),
    ("maximum_iterations", 0, 1000),
    ("tolerance", 0, 0.1),
    ("loose_tolerance", 0, 0.1),
    ("reuse", -1, 0.9),
)
