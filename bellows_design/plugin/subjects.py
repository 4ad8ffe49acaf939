"""Designs as people name them in a script: by name, as a dict, with single values changed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted

Subject: TypeAlias = Design | str | Path | Mapping[str, Any]
"""A design, its name or TOML file, or a dict as such a file has it."""


def design_of(subject: Subject, parameters: Mapping[str, Any] | None = None) -> Design:
    """The design that is meant, with ``parameters`` in the place of its own.

    Raises ``DesignError``.
    """
    design = _design(subject)
    if not parameters:
        return design
    return with_overrides(design, list(_assignments(parameters)))


def _design(subject: object) -> Design:
    if isinstance(subject, Design):
        return subject
    if isinstance(subject, str | Path):
        return load_design(subject)
    if isinstance(subject, Mapping):
        return Design.of(dict(subject))
    raise DesignError(
        "a design must be a Design, the name of one, a TOML file or a dict, got "
        f"{quoted(type(subject).__name__)}."
    )


def _assignments(parameters: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """``key=value`` as ``bellows --set`` takes it; tables become dotted keys."""
    for name, value in parameters.items():
        if isinstance(value, Mapping):
            yield from _assignments(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}={_text(value)}"


def _text(value: object) -> str:
    if value is None:
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list | tuple):
        return f"[{', '.join(_text(each) for each in value)}]"
    return str(value)
