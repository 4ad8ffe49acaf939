"""What pydantic finds wrong with parameters, as sentences.

A sentence names the parameter, its value, the bound it breaks and the unit; where the value would
fit after a shift by a factor of 1000 it asks about the unit, and where a key is unknown it names
the keys that look alike.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import did_you_mean, near, quoted

_BOUNDS = {
    "greater_than": ("gt", "greater than"),
    "greater_than_equal": ("ge", "at least"),
    "less_than": ("lt", "less than"),
    "less_than_equal": ("le", "at most"),
}
_NOUNS = {
    "model_type": "a table of keys and values",
    "model_attributes_type": "a table of keys and values",
    "dict_type": "a table of keys and values",
    "string_type": "text",
    "tuple_type": "a list of numbers",
}
_OTHER_UNITS = {
    "mm": ((1e3, "m"), (1e-3, "µm"), (10.0, "cm"), (25.4, "in")),
    "MPa": ((0.1, "bar"), (0.00689476, "psi"), (1e-3, "kPa"), (1e-6, "Pa"), (1e3, "GPa")),
}
"""Unit -> the units a number out of bounds may have been meant in, and their factors."""

_MOST_PROBLEMS = 20
_MOST_HINTS = 2


def sentences(error: ValidationError, model: type[BaseModel]) -> tuple[str, ...]:
    """The problems pydantic found in ``model``'s input, each as one sentence."""
    details = error.errors(include_url=False)
    found = [text for detail in details[:_MOST_PROBLEMS] for text in _sentences_of(detail, model)]
    more = len(details) - _MOST_PROBLEMS
    return (*dict.fromkeys(found), *([f"and {more} more problems."] if more > 0 else []))


def nested_model(field: FieldInfo) -> type[BaseModel] | None:
    """The model a field holds, also where it is optional; else None."""
    for kind in (field.annotation, *get_args(field.annotation)):
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            return kind
    return None


def _sentences_of(detail: Mapping[str, Any], model: type[BaseModel]) -> tuple[str, ...]:
    """The sentences of one problem: several where a model inside raised them already."""
    inner = detail.get("ctx", {}).get("error")
    return inner.sentences if isinstance(inner, DesignError) else (_sentence(detail, model),)


def _sentence(detail: Mapping[str, Any], model: type[BaseModel]) -> str:
    name = ".".join(str(part) for part in detail["loc"])
    kind, value, context = detail["type"], detail["input"], detail.get("ctx", {})
    field = _field(model, detail["loc"])
    unit = _unit_of(field)
    if kind in ("value_error", "assertion_error"):
        return _ended(str(context.get("error", detail["msg"])))
    if kind == "extra_forbidden":
        return f"unknown key {quoted(name)}{did_you_mean(name, _keys_beside(model, detail['loc']))}"
    if kind == "missing":
        return f"{name} is missing{_meaning(field, unit)}."
    if value is None:
        return f"{name} cannot be none: it must be {_wanted(kind, context)}{_in(unit)}."
    if kind in _BOUNDS:
        key, words = _BOUNDS[kind]
        bound = context[key]
        hint = _unit_hint(value, field, unit)
        return f"{name} is {_number(value, unit)} but must be {words} {bound:g}{_unit(unit)}{hint}."
    if kind == "finite_number":
        return f"{name} is {value} but must be a finite number{_in(unit)}."
    if kind.startswith(("float", "int")):
        wanted = f"{_wanted(kind, context)}{_in(unit)}"
        return f"{name} is {quoted(value)} but must be {wanted}{written_right(value, unit)}."
    if kind in _NOUNS:
        return f"{name or 'a design'} is {quoted(value)} but must be {_NOUNS[kind]}."
    if kind == "literal_error":
        expected = str(context["expected"])
        hint = near(str(value), re.findall(r"'([^']*)'", expected))
        return f"{name} is {quoted(value)} but must be {expected}{hint or '.'}"
    return _ended(f"{name} is {quoted(value)}: {_lowered(str(detail['msg']))}")


def _wanted(kind: str, context: Mapping[str, Any]) -> str:
    """What a value must be instead, in words."""
    if kind == "literal_error":
        return str(context["expected"])
    if kind.startswith("int"):
        return "a whole number"
    return _NOUNS.get(kind, "a number" if kind.startswith("float") else "given")


def field_at(model: type[BaseModel], location: Sequence[str]) -> FieldInfo | None:
    """The field of ``model`` at ``location``; None where it is not known."""
    return _field(model, location)


def unit_at(model: type[BaseModel], location: Sequence[str]) -> str | None:
    """Unit of the field of ``model`` at ``location``; None without one."""
    return _unit_of(_field(model, location))


def written_right(value: object, unit: str | None) -> str:
    """``; write 1.2 ...`` for a number in ``unit`` that was given as text; else empty."""
    if not isinstance(value, str) or not any(sign.isdigit() for sign in value):
        return ""
    from printers.toml_errors import value_hint  # not at the start: it comes with NumPy

    hint = value_hint(value, unit or "")
    return f"; {hint}" if hint else f"; write {value.strip()} without quotes" * _is_number(value)


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _keys_beside(model: type[BaseModel], location: Sequence[int | str]) -> list[str]:
    """The known keys of the table that the last part of a location is in, dotted."""
    *parents, _ = (str(part) for part in location)
    return [".".join((*parents, key)) for key in _model(model, parents).model_fields]


def _field(model: type[BaseModel], location: Sequence[int | str]) -> FieldInfo | None:
    """Field at a location within nested models, as far as it is known."""
    names = [part for part in location if isinstance(part, str)]
    return _model(model, names[:-1]).model_fields.get(names[-1]) if names else None


def _unit_of(field: FieldInfo | None) -> str | None:
    extra = field.json_schema_extra if field is not None else None
    unit = extra.get("unit") if isinstance(extra, dict) else None
    return str(unit) if unit is not None else None


def _model(model: type[BaseModel], names: Sequence[str]) -> type[BaseModel]:
    """The model that ``names`` lead to from ``model``; the deepest one known.

    Numbers of a list's tables, and free names of tables, lead no further.
    """
    for name in names:
        field = model.model_fields.get(name)
        inner = set() if field is None else set(_models_in(field.annotation))
        if len(inner) == 1:
            model = inner.pop()
    return model


def _models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    """The models in a type: itself, of its items, of its alternatives."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models_in(part)


def _unit_hint(value: object, field: FieldInfo | None, unit: str | None) -> str:
    if field is None or unit not in _OTHER_UNITS or not isinstance(value, int | float):
        return ""
    meant = [
        f"{value:g} {other} would be {value * factor:.6g} {unit}"
        for factor, other in _OTHER_UNITS[unit]
        if _within(value * factor, field)
    ]
    return f"; {', '.join(meant[:_MOST_HINTS])}" if meant else ""


def _within(value: float, field: FieldInfo) -> bool:
    for rule in field.metadata:
        lowest = getattr(rule, "ge", None)
        highest = getattr(rule, "le", None)
        if (lowest is not None and value < lowest) or (highest is not None and value > highest):
            return False
    extra = field.json_schema_extra
    least = extra.get("least") if isinstance(extra, dict) else None
    return value >= least if isinstance(least, float) else value > 0


def _meaning(field: FieldInfo | None, unit: str | None) -> str:
    if field is None or not field.description:
        return ""
    return f": {field.description}{_in(unit)}"


def _number(value: object, unit: str | None) -> str:
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return (
        f"{value:g}{_unit(unit)}" if isinstance(value, float) else f"{quoted(value)}{_unit(unit)}"
    )


def _unit(unit: str | None) -> str:
    return f" {unit}" if unit else ""


def _in(unit: str | None) -> str:
    return f", in {unit}" if unit else ""


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]


def _ended(text: str) -> str:
    return text if text.endswith((".", "?", "!")) else text + "."
