"""Contact of six-node triangles with planes and with rigid cylinders and spheres.

See ``solver.assembly.contact``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solver.arrays import Integers, Reals
from solver.kernels.moving_plane import to_plane_unknowns
from solver.kernels.scatter import mirror_upper, scatter
from solver.numerics.compiled import compiled

UNKNOWNS = 20
"""Unknowns of a triangle: three for each of six nodes, then tilt and shift of the moving plane."""


ENERGY, PRESSURE, SLOPE = 0, 1, 2
"""What ``contact_law`` gives: psi (N/mm), -dpsi/dg (MPa), d2psi/dg2 (MPa/mm)."""


class Face(NamedTuple):
    """Triangles that may touch a plane, as arrays for the kernels.

    ``nodes`` (n, 3), ``triangles`` (k, 6), quadratic ``shapes`` (q, 6), reference ``areas`` (k, q)
    that the quadrature points stand for, ``dofs`` (k, 20), ``stiffness`` (MPa/mm) and
    ``smoothing`` (mm).
    """

    nodes: Reals
    triangles: Integers
    shapes: Reals
    areas: Reals
    dofs: Integers
    stiffness: float
    smoothing: float


class Plane(NamedTuple):
    """g = n . x + c with its derivatives: by tilt (``turned``), twice by tilt, by shift, by both.

    Each of the first three is (4,): n and c.
    """

    equation: Reals
    turned: Reals
    turned_twice: Reals
    shifted: float
    shifted_turned: float


@compiled()
def contact_law(gap: float, stiffness: float, smoothing: float) -> tuple[float, float, float]:
    """psi (N/mm), pressure -dpsi/dg (MPa) and its slope d2psi/dg2 (MPa/mm) at a signed gap, mm."""
    depth = -gap
    if depth <= 0.0:
        return 0.0, 0.0, 0.0
    if depth < smoothing:
        slope = stiffness * depth / smoothing
        return slope * depth * depth / 6.0, slope * depth / 2.0, slope
    energy = stiffness * (depth * (depth - smoothing) / 2.0 + smoothing * smoothing / 6.0)
    return energy, stiffness * (depth - smoothing / 2.0), stiffness


@compiled()
def contact_values(face: Face, gaps: Reals, which: int) -> Reals:
    """``ENERGY``, ``PRESSURE`` or ``SLOPE`` (k, q) at signed gaps (k, q) of quadrature points."""
    values = np.empty(gaps.shape)
    for triangle in range(gaps.shape[0]):
        for point in range(gaps.shape[1]):
            law = contact_law(gaps[triangle, point], face.stiffness, face.smoothing)
            values[triangle, point] = law[which]
    return values


@compiled()
def face_energy(face: Face, plane: Plane, displacement: Reals) -> float:
    """Contact energy of a face, N mm."""
    energy = 0.0
    for triangle in range(face.triangles.shape[0]):
        nodes = face.triangles[triangle]
        x = face.nodes[nodes] + displacement[nodes]
        for point in range(face.shapes.shape[0]):
            gap = plane.equation[3]
            for a in range(6):
                for i in range(3):
                    gap += face.shapes[point, a] * plane.equation[i] * x[a, i]
            energy += (
                face.areas[triangle, point] * contact_law(gap, face.stiffness, face.smoothing)[0]
            )
    return energy


@compiled()
def triangle_response(
    face: Face, triangle: int, plane: Plane, x: Reals, r: Reals, k: Reals
) -> bool:
    """Residual r (20,) and upper half of the tangent k (20, 20) of one triangle; False if zero.

    ``x`` (6, 3) deformed nodes, mm. Unknowns are positions of nodes, tilt and shift.
    """
    gradient = np.empty(UNKNOWNS)
    touches = False
    for point in range(face.shapes.shape[0]):
        gap, turned, curved = plane.equation[3], plane.turned[3], plane.turned_twice[3]
        for a in range(6):
            for i in range(3):
                place = face.shapes[point, a] * x[a, i]
                gap += place * plane.equation[i]
                turned += place * plane.turned[i]
                curved += place * plane.turned_twice[i]
                gradient[3 * a + i] = face.shapes[point, a] * plane.equation[i]
        gradient[18], gradient[19] = turned, plane.shifted
        _, pressure, slope = contact_law(gap, face.stiffness, face.smoothing)
        if pressure == 0.0:
            continue
        touches = True
        area = face.areas[triangle, point]
        for i in range(UNKNOWNS):
            r[i] -= area * pressure * gradient[i]
            for j in range(i, UNKNOWNS):
                k[i, j] += area * slope * gradient[i] * gradient[j]
        for a in range(6):
            for i in range(3):
                k[3 * a + i, 18] -= area * pressure * face.shapes[point, a] * plane.turned[i]
        k[18, 18] -= area * pressure * curved
        k[18, 19] -= area * pressure * plane.shifted_turned
    return touches


@compiled()
def assemble_contact(
    face: Face,
    entries: Integers,
    plane: Plane,
    heights: Reals,
    tilt: float,
    displacement: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
) -> None:
    """Add a face's contact forces to ``residual`` (N) and the tangent to the CSR ``values``.

    ``entries`` (k, 210) are positions in the values; ``heights`` (n,) of the nodes on the moving
    plane, NaN for all others, and its ``tilt`` (rad).
    """
    r = np.empty(UNKNOWNS)
    k = np.empty((UNKNOWNS, UNKNOWNS))
    for triangle in range(face.triangles.shape[0]):
        nodes = face.triangles[triangle]
        r[:] = 0.0
        k[:, :] = 0.0
        x = face.nodes[nodes] + displacement[nodes]
        if not triangle_response(face, triangle, plane, x, r, k):
            continue
        mirror_upper(k)
        for a in range(6):
            if not np.isnan(heights[nodes[a]]):
                to_plane_unknowns(r, k, r, a, heights[nodes[a]], tilt)
        scatter(r, k, face.dofs[triangle], entries[triangle], 1.0, tangent, residual, values)


@compiled()
def add_curved(
    pressure: float,
    slope: float,
    distance: float,
    area: float,
    shapes: Reals,
    normal: Reals,
    across: Reals,
    r: Reals,
    k: Reals,
) -> None:
    """Add a point's part of residual r (20,) and tangent k (20, 20); ``distance`` from the axis."""
    bend = pressure / distance if distance > 0.0 else 0.0
    for i in range(3):
        for j in range(3):
            stiffness = (slope + bend) * normal[i] * normal[j] - bend * across[i, j]
            for a in range(6):
                for b in range(6):
                    k[3 * a + i, 3 * b + j] += area * stiffness * shapes[a] * shapes[b]
        for a in range(6):
            r[3 * a + i] -= area * pressure * shapes[a] * normal[i]


@compiled()
def assemble_curved_contact(
    face: Face,
    entries: Integers,
    gaps: Reals,
    normals: Reals,
    across: Reals,
    radius: float,
    tangent: bool,
    residual: Reals,
    values: Reals,
) -> None:
    """Add forces and tangent of contact with a cylinder or sphere; see ``assemble_contact``.

    ``gaps`` (k, q) and ``normals`` (k, q, 3) of the quadrature points; ``across`` (3, 3): the
    projection across the axis, or the identity; ``radius`` in mm.
    """
    r = np.empty(UNKNOWNS)
    k = np.empty((UNKNOWNS, UNKNOWNS))
    for triangle in range(face.triangles.shape[0]):
        r[:] = 0.0
        k[:, :] = 0.0
        touches = False
        for point in range(face.shapes.shape[0]):
            gap, normal = gaps[triangle, point], normals[triangle, point]
            _, pressure, slope = contact_law(gap, face.stiffness, face.smoothing)
            if pressure == 0.0:
                continue
            touches = True
            add_curved(
                pressure, slope, gap + radius, face.areas[triangle, point], face.shapes[point],
                normal, across, r, k,
            )  # fmt: skip
        if touches:
            scatter(r, k, face.dofs[triangle], entries[triangle], 1.0, tangent, residual, values)
