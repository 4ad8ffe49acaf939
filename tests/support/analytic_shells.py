"""Shells whose thickness is known everywhere, meshed as finely as one likes."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold
from numpy.typing import NDArray
from small_solids import arrays

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def sphere(thickness: float, segments: int, radius: float = 6.0) -> Mesh:
    """A hollow sphere of the outer `radius`, mm; its thickness is the same everywhere."""
    outer, inner = (Manifold.sphere(r, segments) for r in (radius, radius - thickness))
    return arrays(outer - inner)


def tube(thickness: float, segments: int, radius: float = 5.0, length: float = 12.0) -> Mesh:
    """A tube open at both ends."""
    outer = Manifold.cylinder(length, radius, radius, segments)
    inner = Manifold.cylinder(length + 2, radius - thickness, radius - thickness, segments)
    return arrays(outer - inner.translate((0.0, 0.0, -1.0)))


def filleted_box(thickness: float, segments: int, size: float = 14.0, fillet: float = 3.0) -> Mesh:
    """A hollow box whose upright edges are round inside and outside, with one centre."""
    return arrays(
        _rounded(size, size, fillet, segments)
        - _rounded(
            size - 2 * thickness, size - 2 * thickness, fillet - thickness, segments
        ).translate((0.0, 0.0, thickness))
    )


def _rounded(side: float, height: float, fillet: float, segments: int) -> Manifold:
    core = CrossSection.square((side - 2 * fillet, side - 2 * fillet), True)
    return Manifold.extrude(core.offset(fillet, JoinType.Round, 2.0, segments), height)


SHELLS = {"sphere": sphere, "tube": tube, "filleted box": filleted_box}
