"""How a load is applied: sizes of steps, tolerances, the linear solver."""

from __future__ import annotations

from dataclasses import dataclass

from solver.errors import SolverError
from solver.input_types import check_instance, check_number

FIRST_STEP = 0.1
"""Default, as a fraction of the load."""


@dataclass(frozen=True)
class SolverOptions:
    """Step sizes, tolerances and linear solver.

    Attributes:
        first_step: fraction of the load. By default a tenth, or along an axis the step whose
            linear prediction moves the body by its own diagonal.
        growth: factor by which a step may grow after an accepted one.
        cut: factor of a step after a rejected one.
        smallest_step: fraction of the load; a path stops where a step would be shorter.
        maximum_iterations: of Newton's method at one load; twice as many where surfaces touch or
            films may wrinkle.
        tolerance: bound of the components of the last Newton correction at the whole load, in units
            of the body's diagonal; the error left after that correction is far smaller. That of the
            hydrostatic pressure may be a hundred times as large, relative to the material's initial
            shear modulus and the largest pressure.
        loose_tolerance: the same at smaller loads, or a twentieth of a mean edge of the mesh if
            that is less (a slender body is stiff against motions that are small against its
            length), of a correction by the tangent of the state itself.
        reuse: at the whole load a factorization is used again after a correction that was smaller
            than the one before by this factor; 0 for never.
        linear_solver: "auto", or the name of one.
        maximum_steps: accepted and rejected steps of a path together; it stops after so many.
        seconds: time limit of a solve, s; by default none.

    Raises:
        SolverError: a number out of its bounds.

    Examples:
        >>> from solver import Ogden, Problem, SolverOptions, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.002))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> slow = solve(bar, options=SolverOptions(first_step=0.1, growth=1.5, tolerance=1e-9))
        >>> print(slow.load_steps, slow.linear_solver != "")
        5 True
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
    maximum_steps: int = 500
    seconds: float | None = None

    def __post_init__(self) -> None:
        check_instance("solver: linear_solver", self.linear_solver, str)
        for name, low, high in OPTION_BOUNDS:
            value = getattr(self, name)
            if name in MAY_BE_MISSING and value is None:
                continue
            check_number(f"solver: {name}", value)
            if not low < value <= high:
                raise SolverError(
                    f"solver: {name} must be above {low} and at most {high}, got {value}."
                )


MAY_BE_MISSING = ("first_step", "seconds")

OPTION_BOUNDS = (
    ("first_step", 0, 1),
    ("growth", 1, 10),
    ("cut", 0, 0.9),
    ("smallest_step", 0, 1),
    ("maximum_iterations", 0, 1000),
    ("tolerance", 0, 0.1),
    ("loose_tolerance", 0, 0.1),
    ("reuse", -1, 0.9),
    ("maximum_steps", 0, 1_000_000),
    ("seconds", 0, 1e8),
)
