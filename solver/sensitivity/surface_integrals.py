"""Derivatives of integrals over surfaces by the positions of their nodes.

With x(r, s) a six-node triangle, n da = x_r cross x_s dr ds. The flux of a field f through it, the
integral of f . (x_r cross x_s), has at fixed f the derivative

    integral of (x_s cross f) N_b,r + (f cross x_r) N_b,s

by the node b. The integral of a density over the area is the flux of the density times n.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh.elements import triangle_rule


def at_points(nodal: Reals, triangles: Integers) -> Reals:
    """Nodal vectors (n, 3) at the quadrature points of triangles (k, 6): (k, q, 3)."""
    values: Reals = triangle_rule().quadratic @ nodal[triangles]
    return values


def tangents(x: Reals, triangles: Integers) -> tuple[Reals, Reals]:
    """x_r and x_s (k, q, 3) at the quadrature points, of positions x (n, 3)."""
    gradients = triangle_rule().gradients
    corners = x[triangles]
    return gradients[..., 0] @ corners, gradients[..., 1] @ corners


def flux_derivative(x: Reals, triangles: Integers, field: Reals) -> Reals:
    """Derivative (n, 3) of the flux of a ``field`` (k, q, 3) by positions x (n, 3)."""
    rule = triangle_rule()
    along_r, along_s = tangents(x, triangles)
    by_r, by_s = np.cross(along_s, field), np.cross(field, along_r)
    to_nodes = rule.weights[:, None, None] * rule.gradients
    parts = to_nodes[..., 0].T @ by_r + to_nodes[..., 1].T @ by_s
    return summed(len(x), triangles, parts)


def area_derivative(x: Reals, triangles: Integers, density: Reals) -> Reals:
    """Derivative (n, 3) of the integral of a fixed ``density`` (k, q) over the area."""
    normal = np.cross(*tangents(x, triangles))
    unit = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return flux_derivative(x, triangles, density[..., None] * unit)


def areas(x: Reals, triangles: Integers) -> Reals:
    """Areas (k, q) that the quadrature points stand for, mm^2."""
    normal = np.cross(*tangents(x, triangles))
    sizes: Reals = triangle_rule().weights * np.linalg.norm(normal, axis=-1)
    return sizes


def spread(size: int, triangles: Integers, vectors: Reals) -> Reals:
    """Sums (n, 3) of N_a times vectors (k, q, 3) at the quadrature points."""
    return summed(size, triangles, triangle_rule().quadratic.T @ vectors)


def volume_derivative(x: Reals, triangles: Integers) -> Reals:
    """Derivative (n, 3) of the enclosed volume, minus the integral of y n_y, by positions, mm^2."""
    height = np.zeros((*triangles.shape[:1], len(triangle_rule().weights), 3))
    height[..., 1] = -at_points(x, triangles)[..., 1]
    derivative = flux_derivative(x, triangles, height)
    normal = np.cross(*tangents(x, triangles)) * triangle_rule().weights[:, None]
    derivative[:, 1] -= spread(len(x), triangles, normal)[:, 1]
    return derivative


def volume_curvature(x: Reals, triangles: Integers, direction: Reals) -> Reals:
    """Second derivative of the enclosed volume times a ``direction`` (n, 3): (n, 3).

    The first one is quadratic in the positions, so that a central difference of any step is exact;
    the step makes both parts alike in size.
    """
    largest = np.abs(direction).max(initial=0.0)
    if largest == 0.0:
        return np.zeros_like(x)
    step = np.ptp(x, axis=0).max() / largest
    ahead = volume_derivative(x + step * direction, triangles)
    return (ahead - volume_derivative(x - step * direction, triangles)) / (2 * step)


def summed(size: int, cells: Integers, parts: Reals) -> Reals:
    """Sum of the cells' parts (k, m, 3) at the nodes (n, 3), always in the same order."""
    nodes = cells.ravel()
    columns = [np.bincount(nodes, parts[..., i].ravel(), size) for i in range(3)]
    return np.stack(columns, axis=1)
