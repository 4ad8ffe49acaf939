"""Types of fields that several records have: bounded numbers with their units, and texts."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, Field

from printers.errors import quoted

LONGEST_TEXT = 2000
"""Characters."""


def _printable(text: str) -> str:
    """``text``, which goes to terminals and into manifests: no control characters, one line."""
    if not text.isprintable():
        raise ValueError(f"{quoted(text)} must be printable text on one line")
    return text


def quantity(unit: str, text: str | None = None, **bounds: Any) -> Any:
    """A field in the unit, described by the text, within the bounds (ge, gt, le)."""
    return Field(**bounds, description=text, json_schema_extra={"unit": unit})


Text = Annotated[str, Field(max_length=LONGEST_TEXT), AfterValidator(_printable)]
Percent = Annotated[float, quantity("percent", ge=0, le=100)]
Flow = Annotated[float, quantity("percent", ge=50, le=200)]
Celsius = Annotated[float, quantity("°C", ge=0, le=500)]
Side = Annotated[float, Field(ge=20, le=2000)]
