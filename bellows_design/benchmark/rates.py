"""How fast errors fall and times grow with the size of a mesh."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise


def observed_orders(
    elements: Sequence[int], errors: Sequence[float | None]
) -> tuple[float | None, ...]:
    """Slopes of log(error) over log(1 / elements) from each mesh to the next.

    In terms of the elements' size the order is three times that. None where an error is unknown
    or zero, or where the mesh did not change.
    """
    pairs = pairwise(zip(elements, errors, strict=True))
    return tuple(
        math.log(coarse / fine) / math.log(more / few) if coarse and fine and more != few else None
        for (few, coarse), (more, fine) in pairs
    )


def fitted_exponent(sizes: Sequence[float], seconds: Sequence[float]) -> float | None:
    """Least-squares p in seconds = c sizes^p; None without two different sizes."""
    x, y = [math.log(size) for size in sizes], [math.log(max(s, 1e-9)) for s in seconds]
    middle, level = sum(x) / max(len(x), 1), sum(y) / max(len(y), 1)
    spread = sum((a - middle) ** 2 for a in x)
    shared = sum((a - middle) * (b - level) for a, b in zip(x, y, strict=True))
    return shared / spread if spread > 0 else None
