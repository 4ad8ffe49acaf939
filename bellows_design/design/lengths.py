"""Lengths as fields of a design: their unit, their bounds, and how small a feature may be."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

SMALLEST_FEATURE = 0.4
"""mm. No wall, channel or gap may be thinner: one line of a common nozzle."""

FULL_ROUND_SNAP = 0.05
"""mm. A fillet this close to half of what it rounds is taken as a full round.

The flat strip left between two fillets would be narrower than 0.1 mm: below what a printer
resolves, yet enough to fill a mesh with slivers.
"""

Millimetres = Annotated[float, Field(allow_inf_nan=False)]


def length_field(lowest: float, highest: float, text: str, default: Any = ...) -> float:
    """Field of a length within [lowest, highest] mm; the bounds catch mistaken units."""
    field: float = Field(
        default, ge=lowest, le=highest, description=text, json_schema_extra={"unit": "mm"}
    )
    return field


def snapped_radius(radius: float, half: float) -> float:
    """Radius, or ``half`` (mm) when the two differ by less than ``FULL_ROUND_SNAP``."""
    return half if abs(half - radius) < FULL_ROUND_SNAP else radius
