"""What no elastomer has, and from which error on a fit is none."""

from __future__ import annotations

SOFTEST, STIFFEST = 0.003, 300.0
"""MPa. Initial shear moduli from the softest silicones to the hardest TPU; more is a unit."""

POOR_FIT = 15.0
"""%. Root mean square of a fit's relative errors from which on it is no material."""

POOR_R_SQUARED = 0.9
"""Coefficient of determination below which a fit is no material."""
