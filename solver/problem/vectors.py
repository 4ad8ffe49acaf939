"""Numbers that users give as vectors or matrices."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals
from solver.errors import SolverError


def finite(what: str, given: object, *shapes: tuple[int, ...]) -> Reals:
    """``given`` as an array of one of the ``shapes``; ``SolverError`` unless it is, and finite."""
    try:
        values = np.array(given, float)
    except (TypeError, ValueError):
        values = np.full(0, np.nan)
    if values.shape not in shapes or not np.isfinite(values).all():
        wanted = " or ".join(_told(shape) for shape in shapes)
        raise SolverError(f"{what} must be {wanted}, got {given}.")
    return values


def _told(shape: tuple[int, ...]) -> str:
    """A shape in words."""
    if not shape:
        return "a finite number"
    return f"{' x '.join(map(str, shape))} finite numbers"
