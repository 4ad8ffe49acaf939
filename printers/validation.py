"""Records that are checked once, when they are made, and name what is wrong in one sentence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from printers.errors import PrintersError, quoted


class Record(BaseModel):
    """Frozen, strict in its keys, refusing NaN.

    A field states its unit as `json_schema_extra={"unit": "mm"}`; it appears in the sentences.
    Raises PrintersError with one sentence, on the first problem.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def __init__(self, /, **data: Any) -> None:  # "self" may be a key of the file
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise PrintersError(_sentence(error.errors()[0], type(self))) from None


def _sentence(problem: Mapping[str, Any], record: type[BaseModel]) -> str:
    key = ".".join(str(step) for step in problem["loc"])
    if problem["type"] == "extra_forbidden":
        return f"unknown key {quoted(key)}; known: {', '.join(record.model_fields)}"
    if problem["type"] == "missing":
        return f"key {key!r} is missing"
    text = str(problem["msg"]).removeprefix("Value error, ")
    if problem["type"] == "value_error":  # a sentence of our own, complete in itself
        return f"{key}: {text}" if key else text
    given = problem["input"]
    shown = f"{given:g}" if isinstance(given, float) else quoted(given)
    return f"{key} is {shown}{_unit(problem, record)}; {text[0].lower()}{text[1:]}"


def _unit(problem: Mapping[str, Any], record: type[BaseModel]) -> str:
    """The unit of the field with the problem, after a space; empty without one."""
    extra = record.model_fields[problem["loc"][0]].json_schema_extra
    return f" {extra['unit']}" if isinstance(extra, dict) and "unit" in extra else ""
