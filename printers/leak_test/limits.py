"""What the printed depth is held against.

The profile says how many lines side by side and how many layers seal. A wall that misses a whole
line of them fails, one that misses half a line warns. A floor fails where it misses more than a
layer. Measured depths scatter by 0.15 lines about the wall's thickness, so the bounds lie off whole
numbers by that: a wall of two lines is not let pass for one of three.
"""

from __future__ import annotations

from printers.profile import PrinterProfile

LINES_MISSING = 0.75
LAYERS_MISSING = 1.75
LINES_LACKING = 0.5
"""From here on a wall warns."""

LEAST_BESIDE_VOIDS = 0.25
"""Lines. Parts whose voids join up have none; sound ones have half a line and more."""

LEAST_SEAM_LOSS = 0.25
"""Lines."""

MATERIAL_BAND = 0.05
"""Share by which the plastic may differ from what the solid asks for."""


def least_lines(profile: PrinterProfile) -> float:
    """Depth in lines below which a part fails; half of the profile's lines at least."""
    return max(profile.minimum_lines - LINES_MISSING, profile.minimum_lines / 2)


def ample_lines(profile: PrinterProfile) -> float:
    """Depth in lines below which a part warns."""
    return max(profile.minimum_lines - LINES_LACKING, least_lines(profile))


def stretch_of_heights(profile: PrinterProfile) -> float:
    """How many times heights count, so that floors and walls fail at the same depth."""
    layers = profile.minimum_solid_layers
    least_floor = max(layers - LAYERS_MISSING, layers / 2) * profile.layer_height
    return least_lines(profile) * profile.line_width / least_floor
