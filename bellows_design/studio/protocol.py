"""What page and server say to each other: messages of the page checked, those of the server packed.

See docs/studio-protocol.md. Nothing here knows designs: values are plain.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import did_you_mean, quoted

LARGEST_MESSAGE = 2**20
"""Bytes of a message of the page: a design's TOML, which may be 1 MB, is the longest."""

MOST_VALUES, LARGEST_VALUE, DEEPEST = 200, 50_000, 20
"""Of a change: keys, characters of one value, tables inside of each other."""

HIGHEST_REVISION = 2**53

Kind = Literal["change", "rest", "open", "open_toml", "scene", "run", "toml", "quit"]

TEXTS: Mapping[str, tuple[str, ...]] = {
    "open": ("design",),
    "open_toml": ("text",),
    "scene": ("scene",),
}
"""Keys that must be there, as text."""

COUNTED = ("change", "rest", "open", "open_toml", "scene", "run", "toml")
"""Kinds that belong to a revision."""


@dataclass(frozen=True)
class Request:
    """A message of the page: its kind, its revision, and the rest of its keys."""

    kind: Kind
    revision: int = 0
    content: Mapping[str, Any] = field(default_factory=dict)


def request_of(text: str) -> Request:
    """The message that ``text`` holds. Raises ``DesignError`` with a sentence for the page."""
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        raise DesignError("a message of the page is not JSON.") from None
    if not isinstance(message, dict):
        raise DesignError("a message of the page is no table.")
    kind = message.pop("type", None)
    if kind not in get_args(Kind):
        raise DesignError(f"unknown type of message {quoted(kind)}")
    for key in TEXTS.get(kind, ()):
        if not isinstance(message.get(key), str):
            raise DesignError(f"{kind}: {key} must be text.")
    revision = message.pop("revision", 0)
    if kind in COUNTED:
        _check_revision(revision)
    if kind == "change":
        _check_values(message.get("values"))
    return Request(kind, revision if kind in COUNTED else 0, message)


def text_of(kind: str, **content: Any) -> str:
    """A message of the server as text; what is no finite number is null."""
    return json.dumps({"type": kind, **finite(content)}, ensure_ascii=False, allow_nan=False)


def binary_of(kind: str, payload: bytes | memoryview, **content: Any) -> bytes:
    """A message with a payload: the length of the head (4 bytes), the head as JSON, the payload."""
    head = text_of(kind, **content).encode()
    return len(head).to_bytes(4, "little") + head + bytes(payload)


def finite(content: Any) -> Any:
    """Plain values with None for every number that JSON does not know."""
    if isinstance(content, float):
        return content if math.isfinite(content) else None
    if isinstance(content, Mapping):
        return {str(key): finite(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [finite(value) for value in content]
    return content


def _check_revision(revision: Any) -> None:
    whole = isinstance(revision, int) and not isinstance(revision, bool)
    if not whole or not 0 <= revision <= HIGHEST_REVISION:
        raise DesignError(f"revision is {quoted(revision)} but must be a whole number from 0 on.")


def _check_values(values: Any) -> None:
    if not isinstance(values, dict):
        raise DesignError("change: values must be a table.")
    if len(values) > MOST_VALUES:
        raise DesignError(f"change: {len(values)} values are more than {MOST_VALUES}.")
    for key, value in values.items():
        if _depth(value) > DEEPEST or len(repr(value)) > LARGEST_VALUE:
            raise DesignError(f"change: the value of {quoted(key)} is too long.")


def _depth(value: Any, level: int = 0) -> int:
    if level > DEEPEST or not isinstance(value, dict | list):
        return level
    inner = value.values() if isinstance(value, dict) else value
    return max((_depth(each, level + 1) for each in inner), default=level + 1)


def known_or_hint(name: str, known: tuple[str, ...], noun: str) -> None:
    """Raise ``DesignError`` unless ``name`` is one of the ``known``."""
    if name not in known:
        raise DesignError(f"unknown {noun} {quoted(name)}{did_you_mean(name, known)}")
