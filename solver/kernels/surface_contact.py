"""Contact of points with six-node triangles; see ``solver.assembly.pairs.surfaces``."""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.kernels.closest_points import (
    EDGE,
    INTERIOR,
    Feet,
    Numbers,
    dot,
    edge_parameters,
    position,
    second_derivatives,
    shapes_at,
)
from solver.kernels.contact import Face, contact_law
from solver.kernels.scatter import mirror_upper, scatter
from solver.numerics.compiled import compiled

UNKNOWNS = 36
"""Unknowns of two triangles: three for each of six nodes, first of the point's own triangle."""


@compiled()
def inverse(matrix: Reals, result: Reals) -> None:
    """Of a symmetric matrix (2, 2)."""
    determinant = matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]
    result[0, 0], result[1, 1] = matrix[1, 1] / determinant, matrix[0, 0] / determinant
    result[0, 1] = result[1, 0] = -matrix[0, 1] / determinant


@compiled()
def free_directions(
    x: Reals,
    slopes: Reals,
    along: Reals,
    kind: int,
    edge: int,
    normal: Reals,
    tangents: Reals,
    changes: Reals,
    bends: Reals,
) -> None:
    """What a foot does as it slides: in both parameters, along its edge, or not at all.

    Fills ``tangents`` (2, 3), ``changes`` (2, 6) of the shape functions, and ``bends`` (2, 2):
    second derivatives of the place times the normal. Zero in directions that are not free.
    """
    curved = np.empty((3, 3))
    second_derivatives(x, curved)
    rr, rs, ss = dot(normal, curved[0]), dot(normal, curved[1]), dot(normal, curved[2])
    tangents[:, :], changes[:, :], bends[:, :] = 0.0, 0.0, 0.0
    if kind == INTERIOR:
        tangents[:, :] = along
        changes[:, :] = slopes.T
        bends[0, 0], bends[0, 1], bends[1, 0], bends[1, 1] = rr, rs, rs, ss
    elif kind == EDGE:
        (r0, s0), (r1, s1) = edge_parameters(edge, 0.0), edge_parameters(edge, 1.0)
        dr, ds = r1 - r0, s1 - s0
        tangents[0] = dr * along[0] + ds * along[1]
        changes[0] = dr * slopes[:, 0] + ds * slopes[:, 1]
        bends[0, 0] = dr * dr * rr + 2 * dr * ds * rs + ds * ds * ss


@compiled()
def gap_gradient(
    shapes: Reals, r: float, s: float, normal: Reals, share: Reals, first: Reals
) -> None:
    """First derivatives (36,) of a gap by the nodes of both triangles, ``share`` (12,) of each.

    ``shapes`` (6,) of the point in its own triangle, r and s of its foot in the other one.
    """
    other, slopes = np.empty(6), np.empty((6, 2))
    shapes_at(r, s, other, slopes)
    share[:6], share[6:] = shapes, -other
    for a in range(12):
        for i in range(3):
            first[3 * a + i] = share[a] * normal[i]


@compiled()
def sliding(
    tangents: Reals, bends: Reals, kind: int, gap: float, flat: Reals, stiff: Reals, bending: Reals
) -> None:
    """m^-1, D^-1 and m^-1 k D^-1, each (2, 2), of the free directions of a foot.

    See ``solver.assembly.pairs.surfaces``; the identity in directions that are not free.
    """
    metric, curved = np.zeros((2, 2)), np.zeros((2, 2))
    for c in range(2):
        if c >= 2 - kind:
            metric[c, c] = curved[c, c] = 1.0
            continue
        for d in range(2 - kind):
            metric[c, d] = dot(tangents[c], tangents[d])
            curved[c, d] = metric[c, d] - gap * bends[c, d]
    inverse(metric, flat)
    inverse(curved, stiff)
    bending[:, :] = 0.0
    for c in range(2):
        for d in range(2):
            for e in range(2):
                for f in range(2):
                    bending[c, d] += flat[c, e] * bends[e, f] * stiff[f, d]


@compiled()
def by_nodes(
    share: Reals, tangents: Reals, changes: Reals, normal: Reals, slid: Reals, turned: Reals
) -> None:
    """How a foot slides, and its tangents turn, with the nodes of both triangles: each (2, 36)."""
    turned[:, :] = 0.0
    for c in range(2):
        for a in range(12):
            for i in range(3):
                slid[c, 3 * a + i] = share[a] * tangents[c, i]
                if a >= 6:
                    turned[c, 3 * a + i] = changes[c, a - 6] * normal[i]


@compiled()
def gap_curvature(
    share: Reals,
    x: Reals,
    r: float,
    s: float,
    kind: int,
    edge: int,
    gap: float,
    normal: Reals,
    second: Reals,
) -> None:
    """Second derivatives of a gap, the upper half of (36, 36); x (6, 3) of the other triangle."""
    other, slopes, place, along = np.empty(6), np.empty((6, 2)), np.empty(3), np.empty((2, 3))
    shapes_at(r, s, other, slopes)
    position(x, other, slopes, place, along)
    tangents, changes, bends = np.empty((2, 3)), np.empty((2, 6)), np.empty((2, 2))
    free_directions(x, slopes, along, kind, edge, normal, tangents, changes, bends)
    flat, stiff, bending = np.empty((2, 2)), np.empty((2, 2)), np.empty((2, 2))
    sliding(tangents, bends, kind, gap, flat, stiff, bending)
    slid, turned = np.empty((2, UNKNOWNS)), np.empty((2, UNKNOWNS))
    by_nodes(share, tangents, changes, normal, slid, turned)
    for i in range(UNKNOWNS):
        for j in range(i, UNKNOWNS):
            value = 0.0
            for c in range(2 - kind):
                for d in range(2 - kind):
                    value -= slid[c, i] * bending[c, d] * slid[d, j]
                    value -= slid[c, i] * stiff[c, d] * turned[d, j]
                    value -= turned[c, i] * stiff[c, d] * (slid[d, j] + gap * turned[d, j])
            second[i, j] = value
    if kind != INTERIOR:
        add_unheld(share, normal, tangents[0], flat[0, 0], gap, second)


@compiled()
def gap_derivatives(
    shapes: Reals,
    x: Reals,
    r: float,
    s: float,
    kind: int,
    edge: int,
    gap: float,
    normal: Reals,
    first: Reals,
    second: Reals,
) -> None:
    """First (36,) and second (36, 36) derivatives of a gap by the nodes of both triangles."""
    share = np.empty(12)
    gap_gradient(shapes, r, s, normal, share, first)
    gap_curvature(share, x, r, s, kind, edge, gap, normal, second)
    mirror_upper(second)


@compiled()
def add_unheld(
    share: Reals, normal: Reals, tangent: Reals, flat: float, gap: float, second: Reals
) -> None:
    """Add what the way to an edge or corner turns across directions in which its foot slides.

    To both halves, of which the lower one is not in use.
    """
    for i in range(3):
        for j in range(3):
            rest = -normal[i] * normal[j] - flat * tangent[i] * tangent[j]
            if i == j:
                rest += 1.0
            for a in range(12):
                for b in range(12):
                    second[3 * a + i, 3 * b + j] += share[a] * share[b] * rest / gap


@compiled()
def assemble_surface_contact(
    face: Face,
    feet: Feet,
    nodes: Reals,
    triangles: Integers,
    points: Numbers,
    pairs: Numbers,
    dofs: Integers,
    entries: Integers,
    tangent: bool,
    residual: Reals,
    values: Reals,
) -> None:
    """Add forces to ``residual`` (N) and the tangent to the CSR ``values``.

    ``nodes`` (n, 3) deformed, ``triangles`` (k, 6) of the other surface; ``points`` (m,): numbers
    of the quadrature points in contact, ``pairs`` (m,): which of the pairs of triangles each
    belongs to, whose ``dofs`` (j, 36) have the places ``entries`` (j, 666).
    """
    first, second, share = np.empty(UNKNOWNS), np.empty((UNKNOWNS, UNKNOWNS)), np.empty(12)
    count = face.shapes.shape[0]
    for m in range(len(points)):
        p = points[m]
        gap, area = feet.gaps[p], face.areas[p // count, p % count]
        _, pressure, slope = contact_law(gap, face.stiffness, face.smoothing)
        if pressure == 0.0:
            continue
        r, s = feet.parameters[p]
        gap_gradient(face.shapes[p % count], r, s, feet.normals[p], share, first)
        if tangent:
            x = nodes[triangles[feet.triangles[p]]]
            kind, edge = feet.kinds[p], feet.edges[p]
            gap_curvature(share, x, r, s, kind, edge, gap, feet.normals[p], second)
            for i in range(UNKNOWNS):
                for j in range(i, UNKNOWNS):
                    bent = pressure * second[i, j]
                    second[i, j] = area * (slope * first[i] * first[j] - bent)
        first *= -area * pressure
        scatter(first, second, dofs[pairs[m]], entries[pairs[m]], 1.0, tangent, residual, values)


@compiled()
def bent_gaps(
    face: Face, feet: Feet, nodes: Reals, triangles: Integers, weights: Reals, along: Reals
) -> Reals:
    """Second derivatives of the gaps times ``weights`` (k, q) times a direction (n, 3): (n, 3)."""
    first, second = np.empty(UNKNOWNS), np.empty((UNKNOWNS, UNKNOWNS))
    result, count = np.zeros(nodes.shape), face.shapes.shape[0]
    both = np.empty(12, np.int64)
    for p in range(len(feet.gaps)):
        weight = weights[p // count, p % count]
        if feet.triangles[p] < 0 or weight == 0.0:
            continue
        other = triangles[feet.triangles[p]]
        gap_derivatives(
            face.shapes[p % count], nodes[other], feet.parameters[p, 0], feet.parameters[p, 1],
            feet.kinds[p], feet.edges[p], feet.gaps[p], feet.normals[p], first, second,
        )  # fmt: skip
        both[:6], both[6:] = face.triangles[p // count], other
        for a in range(12):
            for i in range(3):
                for b in range(12):
                    for j in range(3):
                        change = second[3 * a + i, 3 * b + j] * along[both[b], j]
                        result[both[a], i] += weight * change
    return result
