"""Changing single values of a design: ``bubble_thickness=1.2``, ``indent.depth=0.4``.

A key is a path of field names; a plain field of the bellows needs no prefix. A value is written
as in TOML (text also without its quotes), or ``none`` where a field may be absent.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from pydantic import BaseModel

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.files.toml_files import parse_toml
from bellows_design.materials.material import Material
from bellows_design.validation.quoting import did_you_mean, quoted, quoted_reason
from bellows_design.validation.sentences import nested_model, unit_at
from printers import PrinterProfile

_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*")
_TOML_WORDS = ("true", "false", "inf", "nan")


def with_overrides(design: Design, assignments: Iterable[str]) -> Design:
    """``design`` with every ``key=value`` applied in turn.

    Args:
        design: The design to start from; it stays as it is.
        assignments: Such as ``bubble_thickness=1.2`` (mm), ``indent.depth=0.4`` (mm),
            ``load.pressure=0.05`` (MPa), ``indent=none``.

    Raises:
        DesignError: An unknown key, an unreadable value, or a result that is no design.

    Examples:
        >>> from bellows_design import load_design, with_overrides
        >>> changes = ["bubble_thickness=1.6", "material=chinchilla"]  # mm
        >>> design = with_overrides(load_design("finger"), changes)
        >>> print(design.bellows.bubble_thickness, design.material.name)
        1.6 chinchilla
    """
    table = design.model_dump()
    for assignment in assignments:
        path, value = _read(assignment)
        _put(table, path, value)
    return Design.of(table)


def renamed_if_changed(design: Design, original: Design) -> Design:
    """``design``, named after its digest as well if it differs from ``original`` but in no name.

    So the files of a changed design never stand in the place of the original's.
    """
    if design.digest == original.digest or design.name != original.name:
        return design
    table = design.model_dump() | {"name": f"{design.name[:55]}-{design.digest[:8]}"}
    return Design.of(table)


def known_keys() -> tuple[str, ...]:
    """Every key that may be set: those of the bellows plain, those of other tables dotted."""
    return (*BellowsParameters.model_fields, *_dotted(Design))


def _dotted(model: type[BaseModel], prefix: str = "") -> Iterator[str]:
    for name, field in model.model_fields.items():
        inner = nested_model(field)
        if inner is not BellowsParameters:
            yield prefix + name
        if inner not in (None, BellowsParameters, PrinterProfile):
            yield from _dotted(inner, f"{prefix}{name}.")


def _read(assignment: str) -> tuple[list[str], Any]:
    key, equals, text = assignment.partition("=")
    key = key.strip()
    if not equals:
        raise DesignError(f"{quoted(assignment)} must have the form key=value.")
    plain = key.removeprefix("bellows.")
    if plain in BellowsParameters.model_fields:
        path = ["bellows", plain]
        return path, _value(key, text.strip(), unit_at(Design, path))
    if key not in known_keys():
        raise DesignError(f"unknown key {quoted(key)}{did_you_mean(key, known_keys())}")
    if _holds_text(key) and not text.strip().startswith(('"', "'", "{")):
        return key.split("."), text.strip()
    path = key.split(".")
    return path, _value(key, text.strip(), unit_at(Design, path))


def _holds_text(key: str) -> bool:
    model: type[BaseModel] = Design
    *parents, last = key.split(".")
    for name in parents:
        model = nested_model(model.model_fields[name]) or model
    field = model.model_fields[last]
    # Materials and printers are known by their names or files.
    return field.annotation is str or nested_model(field) in (Material, PrinterProfile)


def _value(key: str, text: str, unit: str | None) -> Any:
    if text.lower() == "none":
        return None
    if _WORD.fullmatch(text) and text not in _TOML_WORDS:
        return text
    try:
        table = parse_toml(f"value = {text}")
    except ValueError as error:
        from printers.toml_errors import value_hint  # not at the start: it comes with NumPy

        reason = value_hint(text, unit or "") or quoted_reason(error)
        raise DesignError(f"{key} cannot be set to {quoted(text)}: {reason}.") from None
    if list(table) != ["value"]:  # a line break would bring in more keys
        raise DesignError(f"{key} cannot be set to {quoted(text)}: it is not one value.")
    return table["value"]


def _put(table: dict[str, Any], path: list[str], value: Any) -> None:
    """Set ``table[path]`` to ``value``, opening tables that are absent so far."""
    *parents, last = path
    for name in parents:
        if not isinstance(table.get(name), dict):
            table[name] = {}
        table = table[name]
    table[last] = value
