"""Frozen records as plain values and arrays, and back: no pickle, nothing that runs.

The fields' types say what a record is made of again, so that neither classes nor code stand in a
file. Known are dataclasses, tuples, mappings from text, arrays, optional values and plain ones.
"""

from __future__ import annotations

import types
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

Arrays = dict[str, NDArray[Any]]
Special = Mapping[type, Callable[[Any], Any]]
"""Class -> what to do with it instead of the usual."""


def plain(value: Any, arrays: Arrays, special: Special) -> Any:
    """``value`` as JSON has it; its arrays go to ``arrays``, and their names stand for them."""
    if type(value) in special:
        return plain(special[type(value)](value), arrays, special)
    if isinstance(value, np.ndarray):
        return _name_among(arrays, value)
    if is_dataclass(value):
        content = {field.name: getattr(value, field.name) for field in fields(value)}
        return plain(content, arrays, special)
    if isinstance(value, Mapping):
        return {str(key): plain(inner, arrays, special) for key, inner in value.items()}
    if isinstance(value, tuple | list):
        return [plain(inner, arrays, special) for inner in value]
    if isinstance(value, np.generic):
        return value.item()
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"{type(value).__name__} is no plain value, and no record of them")


def _name_among(arrays: Arrays, array: NDArray[Any]) -> str:
    """The name of ``array``, which is added unless it is there."""
    known = (name for name, each in arrays.items() if each is array)
    name = next(known, f"array_{len(arrays)}")
    arrays[name] = array
    return name


def restored(kind: Any, value: Any, arrays: Mapping[str, NDArray[Any]], special: Special) -> Any:
    """What ``plain`` made of a value of that kind, as it was.

    Raises ``ValueError``, ``KeyError`` or ``TypeError`` for what it cannot have made.
    """

    def inner(kind: Any, value: Any) -> Any:
        return restored(kind, value, arrays, special)

    kind = _without_parameters(kind)
    origin, parts = get_origin(kind), get_args(kind)
    if kind in special:
        return special[kind](value)
    if origin is np.ndarray:
        return arrays[value]
    if isinstance(kind, type) and is_dataclass(kind):
        hints = hints_of(kind)
        return kind(**{name: inner(hints[name], content) for name, content in value.items()})
    if origin in (Union, types.UnionType):
        (known,) = (part for part in parts if part is not type(None))
        return None if value is None else inner(known, value)
    if origin is Mapping:
        return {name: inner(parts[1], content) for name, content in value.items()}
    if origin is tuple:
        return _tuple(parts, value, inner)
    return _plain_value(kind, value)


def _without_parameters(kind: Any) -> Any:
    """The default of a type variable, and a generic record without its variables."""
    if isinstance(kind, TypeVar):
        return kind.__default__  # type: ignore[attr-defined]
    origin = get_origin(kind)
    return origin if is_dataclass(origin) else kind


def _tuple(parts: tuple[Any, ...], value: Any, inner: Callable[[Any, Any], Any]) -> tuple[Any, ...]:
    if not isinstance(value, list):
        raise ValueError("not a tuple")
    if parts[-1] is Ellipsis:
        return tuple(inner(parts[0], each) for each in value)
    return tuple(inner(part, each) for part, each in zip(parts, value, strict=True))


def _plain_value(kind: Any, value: Any) -> Any:
    if get_origin(kind) is Literal:
        allowed = value in get_args(kind)
    elif kind is float:
        allowed = type(value) in (float, int)
    else:
        allowed = kind in (bool, int, str) and type(value) is kind
    if not allowed:
        raise ValueError(f"{value!r} is no {kind}")
    return value


@cache
def hints_of(kind: type) -> dict[str, Any]:
    """Field -> type of a dataclass, also where only type checkers import a name."""
    from bellows_design.analysis.computation import Computation, Seconds
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.analysis.models import AnalysisModel
    from bellows_design.analysis.wall_contact import WallContact
    from bellows_design.design.design import Design
    from solver import Peak, Solution
    from solver.nonlinear.newton import Newton

    known = (
        AnalysisModel, Computation, Design, Newton, Peak, ReachedStrain, Seconds, Solution,
        WallContact,
    )  # fmt: skip
    return get_type_hints(kind, localns={each.__name__: each for each in known})
