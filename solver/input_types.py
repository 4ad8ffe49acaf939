"""Kinds of values that users give: one sentence on what belongs there, never a Python error."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from numbers import Integral, Real
from pathlib import Path
from typing import TypeVar

from solver.errors import SolverError

Key = TypeVar("Key")
Value = TypeVar("Value")


def names(what: str, given: object) -> tuple[str, ...]:
    """Names of surfaces as a tuple; ``SolverError`` for a bare text or anything else."""
    if isinstance(given, str):
        raise SolverError(
            f"{what} must be a tuple of names of surfaces, got the text {given!r}; a single one is "
            f"({given!r},)."
        )
    if isinstance(given, Mapping) or not isinstance(given, Iterable):
        raise SolverError(f"{what} must be a tuple of names of surfaces, got {shown(given)}.")
    members = tuple(given)
    for name in members:
        if not isinstance(name, str):
            raise SolverError(f"{what} must be names of surfaces, got {shown(name)} among them.")
    return members


def members_of(what: str, given: object, kinds: tuple[type, ...]) -> tuple[object, ...]:
    """Objects of some ``kinds`` as a tuple; ``SolverError`` for a bare one or another kind."""
    wanted = _alternatives(kinds)
    if isinstance(given, kinds):
        raise SolverError(
            f"{what} must be a tuple of {wanted}, got a single {type(given).__name__}; a comma and "
            "brackets around it make one."
        )
    if isinstance(given, str | Mapping) or not isinstance(given, Iterable):
        raise SolverError(f"{what} must be a tuple of {wanted}, got {shown(given)}.")
    members = tuple(given)
    for member in members:
        if not isinstance(member, kinds):
            raise SolverError(f"{what} must be {wanted}, got {shown(member)} among them.")
    return members


def check_instance(what: str, given: object, kind: type, optional: bool = False) -> None:
    """Raise ``SolverError`` unless ``given`` is of a ``kind``, or None if ``optional``."""
    if not isinstance(given, kind) and not (optional and given is None):
        raise SolverError(f"{what} must be {_alternatives((kind,))}, got {shown(given)}.")


def check_function(what: str, given: object, of: str) -> None:
    """Raise ``SolverError`` unless ``given`` can be called or is None; ``of``: its argument."""
    if given is not None and not callable(given):
        raise SolverError(f"{what} must be a function of {of}, got {shown(given)}.")


def file_path(what: str, given: object) -> Path:
    """A path, or text, as a path; ``SolverError`` for anything else."""
    if not isinstance(given, str | Path):
        raise SolverError(f"{what} must be the path of a file, got {shown(given)}.")
    return Path(given)


def check_number(what: str, given: object) -> None:
    """Raise ``SolverError`` unless ``given`` is a real number, NaN and infinity included."""
    if not isinstance(given, Real) or isinstance(given, bool):
        raise SolverError(f"{what} must be a number, got {shown(given)}.")


def numbers(what: str, given: object) -> tuple[float, ...]:
    """Real numbers as a tuple of floats; ``SolverError`` for a single one or anything else."""
    if isinstance(given, str | Mapping) or not isinstance(given, Iterable):
        raise SolverError(f"{what} must be a tuple of numbers, got {shown(given)}.")
    members = tuple(given)
    for member in members:
        check_number(f"{what}: each", member)
    return tuple(float(member) for member in members)


def is_axis(given: object) -> bool:
    """Whether it is 0, 1 or 2, for x, y or z; no truth value, which would select by itself."""
    return isinstance(given, Integral) and not isinstance(given, bool) and given in (0, 1, 2)


def mapping(what: str, given: Mapping[Key, Value], contents: str) -> dict[Key, Value]:
    """A mapping as a dict; ``SolverError`` that it must be one of ``contents`` otherwise."""
    if not isinstance(given, Mapping):
        raise SolverError(f"{what} must be a dict of {contents}, got {shown(given)}.")
    return dict(given)


def shown(given: object) -> str:
    """A value with its type, on one short line."""
    text = " ".join(repr(given).split())
    return f"{text if len(text) <= 60 else text[:57] + '...'} ({type(given).__name__})"


def _alternatives(kinds: tuple[type, ...]) -> str:
    texts = [f"a {kind.__name__}" for kind in kinds]
    return texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} or {texts[-1]}"
