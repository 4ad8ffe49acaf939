"""Derivatives at nodes that nobody knows, from what is known there."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals


def curvatures(nodes: Reals, values: Reals, slopes: Reals) -> Reals:
    """Second derivatives (n,) from values and slopes (n,): of the cubics between nodes.

    Of the two that meet at a node the less curved one counts, and none where they disagree about
    the sign: at a kink nearby the other one is wrong.
    """
    if len(nodes) < 2:
        return np.zeros_like(values)
    h = np.diff(nodes)
    secants = np.diff(values) / h
    at_start = (6 * secants - 4 * slopes[:-1] - 2 * slopes[1:]) / h
    at_end = (4 * slopes[1:] + 2 * slopes[:-1] - 6 * secants) / h
    return np.concatenate([at_start[:1], smaller(at_end[:-1], at_start[1:]), at_end[-1:]])


def smaller(a: Reals, b: Reals) -> Reals:
    """The smaller one in size of each two numbers, zero where their signs differ."""
    return np.where(a * b > 0, np.where(np.abs(a) < np.abs(b), a, b), 0.0)


def slopes(nodes: Reals, values: Reals) -> Reals:
    """First derivatives (n,) from values (n,): of the parabola through a node and its neighbours.

    At the ends, and with two nodes, the secant's.
    """
    if len(nodes) < 2:
        return np.zeros_like(values)
    h = np.diff(nodes)
    secants = np.diff(values) / h
    middle = (h[1:] * secants[:-1] + h[:-1] * secants[1:]) / (h[1:] + h[:-1])
    return np.concatenate([secants[:1], middle, secants[-1:]])


def monotone_slopes(nodes: Reals, values: Reals) -> Reals:
    """First derivatives (n,) from values (n,) with which cubics do not overshoot."""
    from scipy.interpolate import PchipInterpolator

    if len(nodes) < 2:
        return np.zeros_like(values)
    found: Reals = PchipInterpolator(nodes, values).derivative()(nodes)
    return found
