"""The base of all checked parameters."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Parameters(BaseModel):
    """Frozen model that refuses unknown keys, numbers written as text, NaN and infinity.

    A field states its unit as ``json_schema_extra={"unit": "mm"}``, for messages.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


def require(condition: bool, sentence: str) -> None:
    """Raise ``ValueError``, which pydantic collects, unless the condition holds."""
    if not condition:
        raise ValueError(sentence)
