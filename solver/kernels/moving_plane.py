"""Unknowns of a plane that turns and shifts, in place of those of the nodes on it."""

from __future__ import annotations

import math

from solver.arrays import Reals
from solver.numerics.compiled import compiled


@compiled()
def to_plane_unknowns(
    r: Reals, k: Reals, forces: Reals, node: int, height: float, tilt: float
) -> None:
    """Express r (m + 2,) and the full k (m + 2, m + 2) in the unknowns of a moving plane.

    A node on the plane is at x = L + shift + h sin(tilt), z = h cos(tilt). Of the cell's local
    ``node`` the z unknown becomes that of its ``height`` h, the x unknown disappears, and the last
    two unknowns are tilt and shift. ``forces`` (m,) on the cell's displacements act along the
    curved ways of its nodes: those of r, or of the stress that the tangent is formed with.
    """
    s, c = math.sin(tilt), math.cos(tilt)
    x, z, turn, shift = 3 * node, 3 * node + 2, r.size - 2, r.size - 1
    for i in range(r.size):
        along, up = k[i, x], k[i, z]
        k[i, z] = s * along + c * up
        k[i, turn] += height * (c * along - s * up)
        k[i, shift] += along
    for j in range(r.size):
        along, up = k[x, j], k[z, j]
        k[z, j] = s * along + c * up
        k[turn, j] += height * (c * along - s * up)
        k[shift, j] += along
    along, up = forces[x], forces[z]
    k[z, turn] += c * along - s * up
    k[turn, z] += c * along - s * up
    k[turn, turn] -= height * (s * along + c * up)
    along, up = r[x], r[z]
    r[z] = s * along + c * up
    r[turn] += height * (c * along - s * up)
    r[shift] += along
