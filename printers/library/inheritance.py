"""Tables that extend others: `extends = "NAME"`, over several levels, never in a circle."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from printers.errors import PrintersError, quoted
from printers.library.library import Library, is_path
from printers.library.reading import read_table

EXTENDS = "extends"
MOST_LEVELS = 10
"""A longer chain was not written by hand."""


@dataclass(frozen=True)
class Origin:
    """The `folder` that paths in a table count from, and the `files` that led to it, heirs first.

    Without a folder paths count from the working folder.
    """

    folder: Path | None = None
    files: tuple[str, ...] = ()


NOWHERE = Origin()
"""Of a table that stands in no file."""


def own_table(library: Library, name_or_path: str | Path) -> tuple[dict[str, Any], Origin]:
    """What the file of that name or path says itself, and where it is.

    Raises PrintersError with one sentence on the file that is missing or broken.
    """
    source = library.find(name_or_path)
    return read_table(source, library.noun, str(name_or_path)), _origin(source)


def with_parents(library: Library, table: Mapping[str, Any], origin: Origin) -> dict[str, Any]:
    """The `table` with all keys it leaves to the one it extends; tables in it are joined likewise.

    The name is not inherited. Raises PrintersError with one sentence on a parent that is missing,
    broken, or extends one of its heirs.
    """
    own = _with_whole_paths(library, table, origin)
    if EXTENDS not in own:
        return own
    source = library.find(_named(own.pop(EXTENDS)), origin.folder)
    below = _origin(source, origin)
    parent = read_table(source, library.noun, str(source))
    inherited = with_parents(library, parent, below)
    inherited.pop("name", None)
    return _joined(inherited, own)


def _origin(source: Traversable, heir: Origin = NOWHERE) -> Origin:
    files = (*heir.files, os.path.realpath(str(source)))
    if files[-1] in heir.files:
        raise PrintersError(f"{EXTENDS} goes round in a circle: {_chain(files)}")
    if len(files) > MOST_LEVELS:
        raise PrintersError(
            f"{EXTENDS} goes through more than {MOST_LEVELS} files: {_chain(files)}"
        )
    return Origin(source.parent if isinstance(source, Path) else None, files)


def _chain(files: tuple[str, ...]) -> str:
    return quoted(" > ".join(Path(file).name for file in files))


def _with_whole_paths(library: Library, table: Mapping[str, Any], origin: Origin) -> dict[str, Any]:
    """The table; files in it are named so that heirs in other folders find them."""
    whole = dict(table)
    for key in library.links:
        value = whole.get(key)
        if isinstance(value, str) and is_path(value) and origin.folder is not None:
            whole[key] = str(origin.folder / value)
    return whole


def _named(value: Any) -> str:
    if not isinstance(value, str):
        raise PrintersError(f"{EXTENDS} is {quoted(value)}; it must be a name, or a .toml file")
    return value


def _joined(parent: Mapping[str, Any], own: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of both, the own ones first; tables that both have are joined key by key."""
    joined = dict(parent)
    for key, value in own.items():
        below = joined.get(key)
        if isinstance(value, Mapping) and isinstance(below, Mapping):
            joined[key] = _joined(below, value)
        else:
            joined[key] = value
    return joined
