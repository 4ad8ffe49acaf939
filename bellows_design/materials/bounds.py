"""What no elastomer has, and from which error on a fit is none."""

from __future__ import annotations

SOFTEST, STIFFEST = 0.003, 300.0
"""MPa. Initial shear moduli from the softest silicones to the hardest TPU; more is a unit."""

POOR_FIT = 15.0
"""%. Root mean square of a fit's relative errors above which it is no material: of 480 fits to
made-up tests those below it have initial shear moduli within 20 % in nine cases of ten, as far as
printed filaments differ anyway; those above do not."""

POOR_MODULUS = 10.0
"""%. Difference of a fit's initial shear modulus from what the beginning of the tests says, above
which it is no material."""

POOR_R_SQUARED = 0.9
"""Coefficient of determination below which a material that states nothing else is a poor fit."""
