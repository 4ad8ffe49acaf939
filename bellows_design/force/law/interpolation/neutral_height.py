"""Sections seen from the neutral height, at which an axial force leaves the gap as it is.

Only the moment about it decides whether neighbouring bubbles touch. What is interpolated by that
moment has its kink where they begin to touch whatever the axial force is, and the response to an
axial force there has none. About z = 0 it has one: times the axial force, the second derivative of
the extension would make the interpolated compliance negative beside the kink.

With the height H the moment about it is M - H N, and the extension there e + H theta.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bellows_design.force.law.interpolation.points import SectionPoint
from bellows_design.force.law.interpolation.rows import Row
from bellows_design.force.section_law import SectionResponse
from solver.arrays import Reals


def neutral_height(rows: Sequence[Row]) -> float:
    """Height (mm) at which axial forces leave the gap alone; 0 if no row has points that touch.

    Contact takes away compliance in proportion to the products of how moment and axial force change
    the gap: the ratio of what is lost is the height. Rows count by their losses.
    """
    lost = [
        below.derivatives[0, :2] - above.derivatives[0, :2]
        for row in rows
        for below, above in zip(row.points, row.points[1:], strict=False)
        if below.touches and not above.touches
    ]
    bending, coupling = np.array(lost).reshape(-1, 2).T
    total = float(bending @ bending)
    return -float(coupling @ bending) / total if total else 0.0


def row_about(row: Row, height: float) -> Row:
    """The row with extensions at a height, mm, and derivatives by axial forces there."""
    return replace(row, points=tuple(_point_about(point, height) for point in row.points))


def moments_about(loads: Reals, height: float) -> Reals:
    """Moments (k,) about a height (mm) of section loads (k, 3) at z = 0, N mm."""
    moments: Reals = loads[:, 0] - height * loads[:, 1]
    return moments


def loads_about(loads: Reals, height: float) -> Reals:
    """Section loads (k, 3) about a height (mm) from those at z = 0."""
    return np.column_stack([moments_about(loads, height), loads[:, 1:]])


def response_at_origin(found: SectionResponse, height: float) -> SectionResponse:
    """The response to section loads at z = 0 from that to those about a height, mm."""
    by_origin = np.eye(3)
    by_origin[0, 1] = -height
    return replace(
        found,
        motion=found.motion @ by_origin,
        compliance=by_origin.T @ found.compliance @ by_origin,
        motion_by_pressure=found.motion_by_pressure @ by_origin,
    )


def _point_about(point: SectionPoint, height: float) -> SectionPoint:
    by_height = np.eye(3)
    by_height[0, 1] = height
    return replace(
        point,
        extension=point.extension + height * point.rotation,
        derivatives=by_height.T @ point.derivatives @ by_height,
    )
