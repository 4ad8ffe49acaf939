"""Tolerances that several rules share."""

from __future__ import annotations

ROUNDING = 1e-3
"""mm. Two coordinates this close are the same place."""

FACET_TOLERANCE = 0.02
"""mm. The chord error allowed to the facets of an STL."""

SMALLEST_AREA = 1.0
"""mm². What was measured on less than this is no wall, no gap and no overhang."""
