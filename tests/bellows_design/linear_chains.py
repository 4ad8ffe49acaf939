"""Chains with closed forms."""

from __future__ import annotations

import numpy as np

from bellows_design.force.chain.finger.chain import Chain, Piece
from bellows_design.force.section_law import LinearLaw

LENGTH, BENDING = 50.0, 800.0
"""mm and N mm²: a finger's, roughly."""


def law_of(length: float, curvature_by_pressure: float = 0.0, stretch: float = 0.0) -> LinearLaw:
    """A beam of bending stiffness ``BENDING`` that curls with pressure; stiff in shear.

    Its volume grows enough for the stored energy to be positive.
    """
    return LinearLaw(
        length,
        np.diag([length / BENDING, stretch * length, 0.0]),
        np.array([curvature_by_pressure * length, 0.0, 0.0]),
        volume_at_rest=20.0 * length,
        volume_by_pressure=(30.0 + BENDING * curvature_by_pressure**2) * length,
    )


def beam(count: int, curvature_by_pressure: float = 0.0, stretch: float = 0.0) -> Chain:
    """A finger of ``count`` pieces, backward and forward in turn, as half bubbles are."""
    law = law_of(LENGTH / count, curvature_by_pressure, stretch)
    return Chain(tuple(Piece(law, number % 2 == 0) for number in range(count)))


def hinged_rod(moment_by_pressure: float, compliance: float) -> Chain:
    """A rigid rod of ``LENGTH`` on an elastic hinge."""
    hinge = LinearLaw(
        0.0,
        np.diag([compliance, 0.0, 0.0]),
        np.array([moment_by_pressure * compliance, 0.0, 0.0]),
    )
    rigid = LinearLaw(LENGTH, np.zeros((3, 3)), np.zeros(3))
    return Chain((Piece(hinge), Piece(rigid)))
