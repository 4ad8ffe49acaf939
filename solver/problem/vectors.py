"""Numbers that users give as vectors or matrices."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import shown


def finite(what: str, given: object, *shapes: tuple[int, ...]) -> Reals:
    """``given`` as an array of one of the ``shapes``; ``SolverError`` unless it is, and finite."""
    try:
        values = np.array(given, float)
    except (TypeError, ValueError):
        values = np.full(0, np.nan)
    usable = values.shape in shapes and not isinstance(given, bool)
    if not (usable and np.isfinite(values).all()):
        wanted = " or ".join(_told(shape) for shape in shapes)
        raise SolverError(f"{what} must be {wanted}, got {' '.join(str(given).split())}.")
    return values


def check_displacement(what: str, given: object, nodes: int) -> None:
    """Raise ``SolverError`` unless these are finite displacements (n, 3) of so many nodes."""
    values = given if isinstance(given, np.ndarray) else np.zeros(0)
    usable = values.shape == (nodes, 3) and values.dtype.kind in "fiu"
    if not (usable and np.isfinite(values).all()):
        raise SolverError(
            f"{what} must be finite numbers of mm of the shape ({nodes}, 3), got {shown(given)}."
        )


def _told(shape: tuple[int, ...]) -> str:
    """A shape in words."""
    if not shape:
        return "a finite number"
    return f"{' x '.join(map(str, shape))} finite numbers"
