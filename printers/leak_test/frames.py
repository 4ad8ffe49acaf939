"""From the frame of the G-code to the part's own coordinates: a turn about z and a shift."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike

from printers.arrays import Floats
from printers.errors import PrintersError
from printers.leak_test.result import Place

Transform: TypeAlias = ArrayLike | tuple[ArrayLike, ArrayLike] | Callable[[Floats], Floats]
"""A (4, 4) matrix, a (3, 3) rotation with a translation, or a function of (n, 3) points."""


def matrix_of(transform: Transform | None) -> Floats:
    """(4, 4).

    Raises:
        PrintersError: It has another shape, holds a number that is not finite, or is no rigid
            motion.
    """
    matrix = np.eye(4)
    if callable(transform):
        corners = transform(np.concatenate([np.zeros((1, 3)), np.eye(3)]))
        matrix[:3, 3] = corners[0]
        matrix[:3, :3] = (corners[1:] - corners[0]).T
    elif isinstance(transform, tuple):
        matrix[:3, :3], matrix[:3, 3] = transform
    elif transform is not None:
        matrix = np.array(transform, dtype=float)
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise PrintersError("transform is no (4, 4) matrix of finite numbers")
    if not np.allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.eye(3), atol=1e-6):
        raise PrintersError("transform is no rigid motion: it stretches or shears")
    return matrix


def moved(matrix: Floats, points: Floats) -> Floats:
    """(n, 3) points, mm."""
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])


def as_place(point: Floats) -> Place:
    """A point (3,) as plain numbers."""
    return cast(Place, tuple(float(value) + 0.0 for value in point))
