"""One clear sentence per problem, instead of a validation report.

A sentence names the parameter, its value, the bound it breaks and the unit; where the value would
fit after a shift by a factor of 1000 it asks about the unit, and where a key is unknown it names
the keys that look alike.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

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
_LOOKALIKES = {
    "mm": ((1e3, "m"), (1e-3, "µm")),
    "MPa": ((0.1, "bar"), (1e-3, "kPa"), (1e-6, "Pa"), (1e3, "GPa")),
}
"""Unit -> the units a number out of bounds may have been meant in, and their factors."""

_LONGEST_QUOTE = 60
_MOST_NAMED = 13
_MOST_PROBLEMS = 20
_LONGEST_COMPARED = 200


class BellowsError(ValueError):
    """Base of the errors of this package whose sentences are meant for users."""


class DesignError(BellowsError):
    """Input that describes no design: one sentence per problem, one problem per line."""

    def __init__(self, *sentences: str) -> None:
        super().__init__("\n".join(sentences))
        self.sentences = sentences


def sentences(error: ValidationError, model: type[BaseModel]) -> tuple[str, ...]:
    """The problems pydantic found in ``model``'s input, each as one sentence."""
    details = error.errors(include_url=False)
    found = [text for detail in details[:_MOST_PROBLEMS] for text in _told_by(detail, model)]
    more = len(details) - _MOST_PROBLEMS
    return (*dict.fromkeys(found), *([f"and {more} more problems."] if more > 0 else []))


def quoted(value: object) -> str:
    """``value`` as it may stand in a message: printable, on one line, not longer than 60 signs."""
    text = value if isinstance(value, str) else _represented(value)
    text = text[: _LONGEST_QUOTE + 1]
    text = "".join(sign if sign.isprintable() else "?" for sign in text)
    text = text if len(text) <= _LONGEST_QUOTE else text[: _LONGEST_QUOTE - 1] + "…"
    return f"“{text}”" if isinstance(value, str) else text


def did_you_mean(unknown: str, known: Iterable[str]) -> str:
    """``; did you mean a or b?`` for the known words closest to ``unknown``, else the known ones.

    A dotted word is also compared by its last part: ``pressure`` finds ``load.pressure``.
    """
    words = list(known)
    unknown = unknown[:_LONGEST_COMPARED]
    last = unknown.rsplit(".", 1)[-1]
    by_part = {word.rsplit(".", 1)[-1]: word for word in reversed(words)}
    close = difflib.get_close_matches(unknown, words, n=3, cutoff=0.6)
    close += [by_part[part] for part in difflib.get_close_matches(last, by_part, n=3, cutoff=0.7)]
    if close:
        return f"; did you mean {' or '.join(dict.fromkeys(close))}?"
    more = f" and {len(words) - _MOST_NAMED} more" if len(words) > _MOST_NAMED else ""
    return f"; known are {', '.join(words[:_MOST_NAMED])}{more}."


def _represented(value: object) -> str:
    try:
        return repr(value)
    except (ValueError, RecursionError):  # 4300 digits, 1000 levels
        return "a huge number" if isinstance(value, int) else "too much to show"


def _told_by(detail: Mapping[str, Any], model: type[BaseModel]) -> tuple[str, ...]:
    """The sentences of one problem: several where a model inside raised them already."""
    inner = detail.get("ctx", {}).get("error")
    return inner.sentences if isinstance(inner, DesignError) else (_sentence(detail, model),)


def _sentence(detail: Mapping[str, Any], model: type[BaseModel]) -> str:
    name = ".".join(str(part) for part in detail["loc"])
    kind, value, context = detail["type"], detail["input"], detail.get("ctx", {})
    field, unit = _field(model, detail["loc"])
    if kind in ("value_error", "assertion_error"):
        return _ended(str(context.get("error", detail["msg"])))
    if kind == "extra_forbidden":
        parent = _model(model, detail["loc"][:-1])
        prefix = name.rpartition(".")[0]
        known = [f"{prefix}.{key}" if prefix else key for key in parent.model_fields]
        return f"unknown key {quoted(name)}{did_you_mean(name, known)}"
    if kind == "missing":
        return f"{name} is missing{_told(field, unit)}."
    if kind in _BOUNDS:
        key, words = _BOUNDS[kind]
        bound = context[key]
        hint = _unit_hint(value, field, unit)
        return f"{name} is {_number(value, unit)} but must be {words} {bound:g}{_unit(unit)}{hint}."
    if kind == "finite_number":
        return f"{name} is {value} but must be a finite number{_in(unit)}."
    if kind.startswith(("float", "int")):
        whole = "whole number" if kind.startswith("int") else "number"
        return f"{name} is {quoted(value)} but must be a {whole}{_in(unit)}."
    if kind in _NOUNS:
        return f"{name or 'a design'} is {quoted(value)} but must be {_NOUNS[kind]}."
    if kind == "literal_error":
        return f"{name} is {quoted(value)} but must be {context['expected']}."
    return _ended(f"{name} is {quoted(value)}: {_lowered(str(detail['msg']))}")


def _field(
    model: type[BaseModel], location: Sequence[int | str]
) -> tuple[FieldInfo | None, str | None]:
    """Field at a location within nested models and its unit, as far as they are known."""
    names = [part for part in location if isinstance(part, str)]
    if not names:
        return None, None
    parent = _model(model, names[:-1])
    field = parent.model_fields.get(names[-1])
    if field is None:
        return None, None
    extra = field.json_schema_extra
    unit = extra.get("unit") if isinstance(extra, dict) else None
    if unit is None and field.annotation is float and len(names) > 1:
        unit = "mm" if names[-2] in ("bellows", "indent", "port") else None
    return field, str(unit) if unit is not None else None


def _model(model: type[BaseModel], names: Sequence[int | str]) -> type[BaseModel]:
    """The model that ``names`` lead to from ``model``; the deepest one known."""
    for name in names:
        field = model.model_fields.get(str(name))
        inner = nested_model(field) if field is not None else None
        if inner is None:
            break
        model = inner
    return model


def nested_model(field: FieldInfo) -> type[BaseModel] | None:
    """The model a field holds, also where it is optional; else None."""
    for kind in (field.annotation, *get_args(field.annotation)):
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            return kind
    return None


def _unit_hint(value: object, field: FieldInfo | None, unit: str | None) -> str:
    if field is None or unit not in _LOOKALIKES or not isinstance(value, int | float):
        return ""
    for factor, other in _LOOKALIKES[unit]:
        if _within(value * factor, field):
            return f"; {value:g} {other} would be {value * factor:g} {unit}"
    return ""


def _within(value: float, field: FieldInfo) -> bool:
    for rule in field.metadata:
        lowest = getattr(rule, "ge", None)
        highest = getattr(rule, "le", None)
        if (lowest is not None and value < lowest) or (highest is not None and value > highest):
            return False
    extra = field.json_schema_extra
    least = extra.get("least") if isinstance(extra, dict) else None
    return value >= least if isinstance(least, float) else value > 0


def _told(field: FieldInfo | None, unit: str | None) -> str:
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
