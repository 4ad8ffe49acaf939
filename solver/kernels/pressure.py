"""Follower pressure on six-node triangles; see ``solver.assembly.pressure``."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solver.arrays import Integers, Reals
from solver.kernels.moving_plane import to_plane_unknowns
from solver.kernels.scatter import scatter
from solver.numerics.compiled import compiled

UNKNOWNS = 18
"""Number of a triangle's unknowns."""


class PressureFacets(NamedTuple):
    """Pressurised triangles, as arrays for the kernels.

    ``nodes`` (n, 3), ``triangles`` (k, 6); quadratic ``shapes`` (q, 6), their ``gradients``
    (q, 6, 2) and ``weights`` (q,) at the quadrature points; ``dofs`` (k, 18) and ``entries``
    (k, 171) are positions in force and CSR values, -1 where an unknown is prescribed. With a
    moving plane they are (k, 20) and (k, 210).
    """

    nodes: Reals
    triangles: Integers
    shapes: Reals
    gradients: Reals
    weights: Reals
    dofs: Integers
    entries: Integers


@compiled()
def triangle_response(facets: PressureFacets, x: Reals, tangent: bool, f: Reals, k: Reals) -> None:
    """Force f (18,) = integral of N_a n da and the upper half of its symmetric tangent k (18, 18).

    ``x`` (6, 3) deformed nodes, mm; per unit pressure, so f is in mm^2 and k in mm.
    """
    f[:] = 0.0
    if tangent:
        k[:, :] = 0.0
    x_r = np.empty(3)
    x_s = np.empty(3)
    v = np.empty(3)
    for point in range(facets.weights.size):
        w = facets.weights[point]
        for i in range(3):
            x_r[i] = 0.0
            x_s[i] = 0.0
            for a in range(6):
                x_r[i] += facets.gradients[point, a, 0] * x[a, i]
                x_s[i] += facets.gradients[point, a, 1] * x[a, i]
        for a in range(6):
            for i in range(3):
                m, n = (i + 1) % 3, (i + 2) % 3
                f[3 * a + i] += w * facets.shapes[point, a] * (x_r[m] * x_s[n] - x_r[n] * x_s[m])
        if not tangent:
            continue
        for a in range(6):
            for b in range(a + 1, 6):
                na, nb = 0.5 * w * facets.shapes[point, a], 0.5 * w * facets.shapes[point, b]
                along_r = na * facets.gradients[point, b, 1] - nb * facets.gradients[point, a, 1]
                along_s = na * facets.gradients[point, b, 0] - nb * facets.gradients[point, a, 0]
                for i in range(3):
                    v[i] = along_r * x_r[i] - along_s * x_s[i]
                k[3 * a, 3 * b + 1] -= v[2]
                k[3 * a, 3 * b + 2] += v[1]
                k[3 * a + 1, 3 * b] += v[2]
                k[3 * a + 1, 3 * b + 2] -= v[0]
                k[3 * a + 2, 3 * b] -= v[1]
                k[3 * a + 2, 3 * b + 1] += v[0]


@compiled()
def assemble_pressure(
    facets: PressureFacets,
    displacement: Reals,
    pressure: float,
    tangent: bool,
    force: Reals,
    values: Reals,
) -> None:
    """Add the unit-pressure forces to ``force`` and ``pressure`` times the tangent to ``values``.

    ``displacement`` (n, 3), mm. ``force`` is in mm^2.
    """
    f = np.empty(UNKNOWNS)
    k = np.empty((UNKNOWNS, UNKNOWNS))
    x = np.empty((6, 3))
    for triangle in range(facets.triangles.shape[0]):
        for a in range(6):
            for i in range(3):
                node = facets.triangles[triangle, a]
                x[a, i] = facets.nodes[node, i] + displacement[node, i]
        triangle_response(facets, x, tangent, f, k)
        scatter(
            f, k, facets.dofs[triangle], facets.entries[triangle], pressure, tangent, force, values
        )


@compiled()
def volume_response(facets: PressureFacets, x: Reals, f: Reals, k: Reals) -> None:
    """First and second derivatives f (18,), k (18, 18) of the integral of y n_y.

    With n_y = z_r x_s - x_r z_s. ``x`` (6, 3) deformed nodes, mm.
    """
    for point in range(facets.weights.size):
        w = facets.weights[point]
        y, x_r, x_s, z_r, z_s = 0.0, 0.0, 0.0, 0.0, 0.0
        for a in range(6):
            y += facets.shapes[point, a] * x[a, 1]
            x_r += facets.gradients[point, a, 0] * x[a, 0]
            x_s += facets.gradients[point, a, 1] * x[a, 0]
            z_r += facets.gradients[point, a, 0] * x[a, 2]
            z_s += facets.gradients[point, a, 1] * x[a, 2]
        for a in range(6):
            shape = w * facets.shapes[point, a]
            a_r, a_s = facets.gradients[point, a, 0], facets.gradients[point, a, 1]
            f[3 * a] += w * y * (z_r * a_s - a_r * z_s)
            f[3 * a + 1] += shape * (z_r * x_s - x_r * z_s)
            f[3 * a + 2] += w * y * (a_r * x_s - x_r * a_s)
            for b in range(6):
                b_r, b_s = facets.gradients[point, b, 0], facets.gradients[point, b, 1]
                along, up = shape * (z_r * b_s - b_r * z_s), shape * (b_r * x_s - x_r * b_s)
                k[3 * a + 1, 3 * b] += along
                k[3 * b, 3 * a + 1] += along
                k[3 * a + 1, 3 * b + 2] += up
                k[3 * b + 2, 3 * a + 1] += up
                across = w * y * (b_r * a_s - a_r * b_s)
                k[3 * a, 3 * b + 2] += across
                k[3 * b + 2, 3 * a] += across


@compiled()
def assemble_volume(
    facets: PressureFacets,
    heights: Reals,
    tilt: float,
    displacement: Reals,
    pressure: float,
    tangent: bool,
    force: Reals,
    values: Reals,
) -> None:
    """``assemble_pressure`` for a cavity whose opening lies in a moving plane.

    ``heights`` (n,) and ``tilt`` (rad) as for ``assemble_plane``.
    """
    f = np.empty(UNKNOWNS + 2)
    k = np.empty((UNKNOWNS + 2, UNKNOWNS + 2))
    for triangle in range(facets.triangles.shape[0]):
        nodes = facets.triangles[triangle]
        f[:] = 0.0
        k[:, :] = 0.0
        volume_response(facets, facets.nodes[nodes] + displacement[nodes], f, k)
        for a in range(6):
            if not np.isnan(heights[nodes[a]]):
                to_plane_unknowns(f, k, f, a, heights[nodes[a]], tilt)
        scatter(
            f, k, facets.dofs[triangle], facets.entries[triangle], pressure, tangent, force, values
        )
