"""The schemas as they are shipped: their names, each by itself, or with all that it refers to."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import did_you_mean, quoted

VERSION = 1
"""Of all schemas: a field that goes, or comes to mean something else, makes another one."""

SUFFIX = ".schema.json"

RECORDS = ("manifest.json", "run.json", "leak_test.json")
"""Files of an export, whose schemas are named after them."""


@cache
def schema_names() -> tuple[str, ...]:
    """Commands as they are typed, such as ``study sweep``, ``error``, and files of an export."""
    names = (file.name for file in _folder().iterdir() if file.name.endswith(SUFFIX))
    return tuple(sorted(_name(name.removesuffix(SUFFIX)) for name in names))


def label(name: str) -> str:
    """What an answer says in ``schema``: program, command and version."""
    return f"bellows {name} {VERSION}"


def schema(name: str) -> dict[str, Any]:
    """The schema of that name, which may refer to others. Raises ``DesignError``."""
    if name not in schema_names():
        raise DesignError(f"there is no schema of {quoted(name)}{_near(name)}")
    text = (_folder() / f"{_stem(name)}{SUFFIX}").read_text("utf-8")
    content: dict[str, Any] = json.loads(text)
    return content


def bundled(name: str) -> dict[str, Any]:
    """The schema of that name, and in ``$defs`` every other that it refers to.

    Raises ``DesignError``.
    """
    whole, waiting, known = schema(name), [schema(name)], {name}
    others: dict[str, Any] = {}
    while waiting:
        for other in sorted(_referred(waiting.pop()) - known):
            known.add(other)
            others[_stem(other)] = schema(other)
            waiting.append(others[_stem(other)])
    return whole | {"$defs": whole.get("$defs", {}) | others} if others else whole


def address(name: str) -> str:
    """The ``$id`` of a schema."""
    return f"urn:bellows-design:schema:{VERSION}:{_stem(name)}"


def _referred(content: Any) -> set[str]:
    """Names of other schemas in references."""
    prefix = address("")
    return {
        _name(reference.partition("#")[0].removeprefix(prefix))
        for reference in _references(content)
        if reference.startswith(prefix)
    }


def _references(content: Any) -> Iterator[str]:
    if isinstance(content, dict):
        if isinstance(content.get("$ref"), str):
            yield content["$ref"]
        content = list(content.values())
    if isinstance(content, list):
        for inner in content:
            yield from _references(inner)


def _near(name: str) -> str:
    return did_you_mean(name, [each for each in schema_names() if each != "error"])


def _folder() -> Any:
    return files("bellows_design.schemas") / str(VERSION)


def _stem(name: str) -> str:
    return name.replace(" ", "-")


def _name(stem: str) -> str:
    return stem.replace("-", " ")
