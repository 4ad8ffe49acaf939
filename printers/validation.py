"""Records that are checked once, when they are made, and name what is wrong in one sentence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from printers.errors import PrintersError, near, quoted
from printers.toml_errors import value_hint


class Record(BaseModel):
    """Frozen, strict in its keys and types, refusing NaN: no text or true for a number.

    A field states its unit as `json_schema_extra={"unit": "mm"}`; it appears in the sentences.
    Raises PrintersError with one sentence, on the first problem.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    def __init__(self, /, **data: Any) -> None:  # "self" may be a key of the file
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise PrintersError(_sentence(error.errors()[0], type(self))) from None


def _sentence(problem: Mapping[str, Any], record: type[BaseModel]) -> str:
    key = ".".join(str(step) for step in problem["loc"])
    if problem["type"] == "extra_forbidden":
        home = _home(key, record)
        known = near(key, record.model_fields) or f"; known: {', '.join(record.model_fields)}"
        return f"unknown key {quoted(key)}{f'; it belongs into [{home}]' if home else known}"
    if problem["type"] == "missing":
        return f"key {key!r} is missing"
    text = str(problem["msg"]).removeprefix("Value error, ")
    if problem["type"] == "value_error":  # a sentence of our own, complete in itself
        return f"{key}: {text}" if key else text
    given = problem["input"]
    expected = _KINDS.get(problem["type"], f"{text[0].lower()}{text[1:]}")
    if problem["type"] == "literal_error":
        expected = f"it must be {problem['ctx']['expected']}"
    unit = _unit(problem, record)
    if isinstance(given, int | float) and not isinstance(given, bool):
        return f"{key} is {_shown(given)}{unit}; {expected}"
    within = f", in{unit}" if unit else ""
    return f"{key} is {_shown(given)}; {expected}{within}{_hint(given, problem, unit.strip())}"


def _home(key: str, record: type[BaseModel]) -> str:
    """Name of the table within the record that has such a key; empty if none has."""
    for name, field in record.model_fields.items():
        kind = field.annotation
        if isinstance(kind, type) and issubclass(kind, Record) and key in kind.model_fields:
            return name
    return ""


_KINDS = {
    "int_type": "it must be a whole number",
    "int_from_float": "it must be a whole number",
    "float_type": "it must be a number",
    "bool_type": "it must be true or false",
    "string_type": "it must be text",
    "tuple_type": "it must be a list",
    "dict_type": "it must be a table of keys and values",
    "model_type": "it must be a table of keys and values",
}


def _shown(given: Any) -> str:
    """A value as a file would have it."""
    if given is None or isinstance(given, bool):
        return str(given).lower()
    return f"{given:g}" if isinstance(given, float) else quoted(given)


def _hint(given: Any, problem: Mapping[str, Any], unit: str) -> str:
    """How a number that was given as text is written."""
    if not isinstance(given, str) or problem["type"] not in ("int_type", "float_type"):
        return ""
    hint = value_hint(given, unit) or f"write {given.strip()} without quotes"
    return f"; {hint}" if any(sign.isdigit() for sign in given) else ""


def _unit(problem: Mapping[str, Any], record: type[BaseModel]) -> str:
    """The unit of the field with the problem, after a space; empty without one."""
    extra = record.model_fields[problem["loc"][0]].json_schema_extra
    return f" {extra['unit']}" if isinstance(extra, dict) and "unit" in extra else ""
