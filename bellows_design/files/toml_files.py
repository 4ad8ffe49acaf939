"""Named TOML files: those of a package, those that other packages add, and any by its path.

All are read with the same guards: regular files only, of limited size, in UTF-8 with or without a
byte order mark, and TOML that neither takes long to parse nor is nested too deeply.
"""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.files.guarded import decoded, read_file
from bellows_design.validation.quoting import (
    did_you_mean,
    quoted,
    quoted_path,
    quoted_reason,
    shown,
)

Table = dict[str, Any]

LARGEST_FILE = 1_000_000
"""Bytes. Nothing meant to be read here is longer; a larger file was named by mistake."""

MOST_DOTS = 100
"""In a line, outside of quoted text: reading a key takes time as the square of its parts."""

LONGEST_REASON = 250
"""Characters of what the parser says, its place in the file included."""

_QUOTED_TEXT = re.compile(r"""\"(?:[^"\\]|\\.?)*+\"?|'[^']*+'?""")


@dataclass(frozen=True)
class TomlLibrary:
    """TOML files that are known by their names without suffix.

    Attributes:
        noun: What messages call one of them, such as ``design``.
        package: Importable package that holds the shipped ones.
        folder: Their folder within that package.
        group: Entry-point group through which other packages add theirs: each entry names an
            importable package that holds ``NAME.toml`` files. Shipped ones win.
    """

    noun: str
    package: str
    folder: str = ""
    group: str | None = None

    def names(self) -> tuple[str, ...]:
        """Names of all files, sorted."""
        return tuple(sorted(self._by_name()))

    def named(self, name: str) -> Table:
        """The file of that name. Raises ``DesignError``."""
        found = self._by_name()
        if name not in found:
            hint = did_you_mean(name, sorted(found))
            raise DesignError(f"unknown {self.noun} {quoted(name)}{hint}")
        return read_toml(found[name], name, self.noun)

    def named_or_at(self, name_or_path: str | Path) -> Table:
        """The file of that name, else the file at that path. Raises ``DesignError``."""
        path = self.path_of(name_or_path)
        if path is None:
            return self.named(str(name_or_path))
        return read_toml(path, str(path), self.noun)

    def path_of(self, name_or_path: str | Path) -> Path | None:
        """The path that is meant; None where it is the name of one of these files."""
        path = Path(name_or_path)
        if isinstance(name_or_path, str):
            is_path = path.suffix == ".toml" or len(path.parts) > 1 or os.path.exists(path)
            if name_or_path in self._by_name() or not is_path:
                return None
        return path

    def _by_name(self) -> dict[str, Traversable]:
        return dict(reversed(list(self._found())))

    def _found(self) -> Iterator[tuple[str, Traversable]]:
        """(name, file), the shipped ones first; a package that is gone has none."""
        yield from _toml_files(files(self.package) / self.folder)
        for entry in entry_points(group=self.group) if self.group else ():
            with suppress(ImportError):
                yield from _toml_files(files(entry.module))


def read_toml(source: Path | Traversable, shown: str, noun: str) -> Table:
    """The file ``source``, which messages call the ``noun`` ``shown``. Raises ``DesignError``."""
    return toml_table(_text(source, shown, noun), f"{noun} {quoted_path(shown)}")


def toml_table(text: str, subject: str) -> Table:
    """``text`` as a table; raises ``DesignError`` with a sentence on ``subject``."""
    try:
        return parse_toml(text)
    except tomllib.TOMLDecodeError as error:
        from printers.toml_errors import toml_error  # not at the start: it comes with NumPy

        reason = shown(toml_error(error, text), LONGEST_REASON)
        raise DesignError(f"{subject} is not valid TOML: {reason}.") from None
    except ValueError as error:
        raise DesignError(f"{subject} is not valid TOML: {quoted_reason(error)}.") from None


def parse_toml(text: str) -> Table:
    """``text`` as a table, in reasonable time. Raises ``ValueError``."""
    one_line_each = '"""' not in text and "'''" not in text
    for line in text.split("\n"):
        if line.count(".") > MOST_DOTS:
            bare = _QUOTED_TEXT.sub("", line) if one_line_each else line
            if bare.count(".") > MOST_DOTS:
                raise ValueError(f"a line has more than {MOST_DOTS} dots")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None


def _toml_files(folder: Traversable) -> Iterator[tuple[str, Traversable]]:
    for file in folder.iterdir():
        if file.name.endswith(".toml"):
            yield file.name.removesuffix(".toml"), file


def _text(source: Path | Traversable, shown: str, noun: str) -> str:
    if isinstance(source, Path):
        content = read_file(source, noun, LARGEST_FILE, shown)
    else:  # a package in an archive
        content = source.read_bytes()
    return decoded(content, f"{noun} {quoted_path(shown)}")
