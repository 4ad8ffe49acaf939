"""Printer profiles as TOML files: those shipped, those of other packages, and a user's own.

Profiles ship in `profiles/`; other packages add theirs as data files through the entry-point group
`bellows_design.printers`, whose values name packages that hold `*.toml` files.
"""

from __future__ import annotations

import os
import tomllib
from importlib.metadata import EntryPoint, entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from printers.errors import PrintersError, quoted, shortened
from printers.profile import PrinterProfile
from printers.toml_errors import toml_error

ENTRY_POINT_GROUP = "bellows_design.printers"

LARGEST_FILE = 1_000_000
"""Bytes. No profile is longer; a larger file was named by mistake."""

MOST_DOTS = 100
"""In a line. The time that TOML takes to read grows with the square of a dotted key's parts."""


def available_profiles() -> tuple[str, ...]:
    """Names of the shipped profiles and of those that other installed packages bring, sorted.

    Returns:
        Names that `load_profile` knows.

    Raises:
        PrintersError: An installed package announces profiles but cannot be imported.
    """
    return tuple(sorted({*_shipped(), *_third_party()}))


def load_profile(name_or_path: str | Path) -> PrinterProfile:
    """Load a profile by its name, or from a path that ends in `.toml`.

    Shipped profiles cannot be replaced by another package's of the same name.

    Args:
        name_or_path: A name, as `available_profiles` lists them, or a file.

    Returns:
        The checked profile.

    Raises:
        PrintersError: One sentence on an unknown name, a missing or unreadable file, an unknown
            key, NaN or a value out of bounds.
    """
    if isinstance(name_or_path, Path) or name_or_path.endswith(".toml"):
        return _read(Path(name_or_path), str(name_or_path))
    return _read(_named(name_or_path), name_or_path)


def _named(name: str) -> Traversable:
    shipped = _shipped()
    if name in shipped:
        return shipped[name]
    known = {**_third_party(), **shipped}
    if name not in known:
        raise PrintersError(
            f"there is no printer profile {quoted(name)}; known: {', '.join(sorted(known))}"
        )
    return known[name]


def _shipped() -> dict[str, Traversable]:
    return _toml_files(files("printers") / "profiles")


def _third_party() -> dict[str, Traversable]:
    found: dict[str, Traversable] = {}
    for entry_point in entry_points(group=ENTRY_POINT_GROUP):
        found.update(_toml_files(_folder_of(entry_point)))
    return found


def _folder_of(entry_point: EntryPoint) -> Traversable:
    try:
        return files(entry_point.value)
    except Exception as error:  # importing another's package may raise anything
        raise PrintersError(
            f"entry point {entry_point.name!r} of {ENTRY_POINT_GROUP} names "
            f"{entry_point.value!r}, which is no importable package: {quoted(str(error))}"
        ) from None


def _toml_files(folder: Traversable) -> dict[str, Traversable]:
    return {
        entry.name.removesuffix(".toml"): entry
        for entry in folder.iterdir()
        if entry.name.endswith(".toml")
    }


def _read(source: Traversable, shown: str) -> PrinterProfile:
    name = quoted(shown)
    try:
        table = _parsed(_text(source))
    except FileNotFoundError:
        raise PrintersError(f"there is no printer profile file {name}") from None
    except (OSError, ValueError, RecursionError) as error:
        reason = getattr(error, "strerror", None) or shortened(str(error)).rstrip(".")
        raise PrintersError(f"printer profile {name} cannot be read: {reason}") from None
    try:
        return PrinterProfile(**table)
    except PrintersError as error:
        raise PrintersError(f"printer profile {name}: {error}") from None


def _text(source: Traversable) -> str:
    """The file's text, a mark at its beginning left out; ValueError if it is none or too long."""
    if isinstance(source, Path) and source.exists() and not (source.is_file() or source.is_dir()):
        raise ValueError("it is no file")  # reading from a pipe would wait for a writer
    content = _content(source) if isinstance(source, Path) else source.read_bytes()
    if len(content) > LARGEST_FILE:
        raise ValueError("it is larger than 1 MB")
    return content.decode("utf-8-sig")


def _content(path: Path) -> bytes:
    """So much of the file that it is seen whether it is too long."""
    content = b""
    with open(path, "rb", buffering=0, opener=_without_waiting) as file:
        while len(content) <= LARGEST_FILE:
            piece = file.read(LARGEST_FILE)
            if piece is None:  # a file of the kernel's, such as /proc/kmsg
                raise ValueError("it has no end")
            if not piece:
                break
            content += piece
    return content


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _parsed(text: str) -> dict[str, Any]:
    if any(line.count(".") > MOST_DOTS for line in text.split("\n")):
        raise ValueError(f"it has a line with more than {MOST_DOTS} dots")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(toml_error(error, text)) from None
