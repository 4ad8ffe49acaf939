"""Surfaces for pages: flat triangles that close, from the six-node ones of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.deformed.joined.sections import FOUR
from solver.arrays import Integers, Reals

MOST_POINTS = 25_000
"""Above so many points of a surface only the corners of its triangles are shown."""


@dataclass(frozen=True)
class SurfaceFrames:
    """A surface in several states.

    Attributes:
        triangles: node numbers, with outward normals.

            *Shape:* (m, 3).
        positions: of the nodes; those of frame 0 at rest.

            *Shape:* (k, n, 3) in mm.
        von_mises: Cauchy stress at the nodes.

            *Shape:* (k, n) in MPa.
        pressures_mpa: of the frames; negative for a vacuum.

            *Shape:* (k,).
        angles_deg: bending angles of the frames, past 360 where the tip curls on.

            *Shape:* (k,).

    Examples:
        >>> import numpy as np
        >>> from bellows_design.deformed import SurfaceFrames
        >>> flat = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])  # mm
        >>> upright = np.array([[0.0, 0, 0], [0, 0, 1], [0, 1, 0]])
        >>> frames = SurfaceFrames(
        ...     triangles=np.array([[0, 1, 2]]),
        ...     positions=np.stack([flat, upright]),
        ...     von_mises=np.zeros((2, 3)),
        ...     pressures_mpa=np.array([0.0, 0.1]),
        ...     angles_deg=np.array([0.0, 90.0]),
        ... )
        >>> print(frames.positions.shape)
        (2, 3, 3)
    """

    triangles: Integers
    positions: Reals
    von_mises: Reals
    pressures_mpa: Reals
    angles_deg: Reals


@dataclass(frozen=True)
class FlatSurface:
    """Flat triangles (m, 3) on some of a mesh's nodes: ``nodes`` (k,), ascending."""

    triangles: Integers
    nodes: Integers

    @staticmethod
    def of(six: Integers) -> FlatSurface:
        """Four for each six-node triangle (t, 6); one where these would be too many points."""
        fine = len(np.unique(six)) <= MOST_POINTS
        flat = np.concatenate([six[:, each] for each in FOUR]) if fine else six[:, :3]
        nodes, numbers = np.unique(flat, return_inverse=True)
        return FlatSurface(numbers.reshape(flat.shape).astype(np.int32), nodes.astype(np.int32))
