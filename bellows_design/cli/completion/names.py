"""Names that a shell completes, each from the files that define it.

A completion waits for the key that was pressed: nothing is imported here that takes long, and
nothing that goes wrong is said; there are no completions then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import wraps
from pathlib import Path
from typing import Any

Completion = list[tuple[str, str]]
"""Completed words, and what they are."""

MOST_FILES = 200
"""That are offered."""

BUILT_IN_SCENES = ("blocked", "free")


def silent(complete: Callable[..., Iterable[tuple[str, str]]]) -> Callable[..., Completion]:
    """``complete`` as a list; an empty one where it fails: a prompt is no place for errors."""

    @wraps(complete)
    def tried(*given: Any, **named: Any) -> Completion:
        with suppress(Exception):
            return list(complete(*given, **named))
        return []

    return tried


@silent
def designs(incomplete: str) -> Iterator[tuple[str, str]]:
    """Shipped designs, and TOML files."""
    yield from beginning(incomplete, _shipped("bellows_design.design", "designs"), "a design")
    yield from files_ending(incomplete, (".toml",))


@silent
def designs_and_parts(incomplete: str) -> Iterator[tuple[str, str]]:
    """What ``bellows check`` takes: designs, and parts of other programs."""
    yield from designs(incomplete)
    yield from files_ending(incomplete, (".stl", ".3mf", ".step", ".stp", ".gcode"))


@silent
def printers(incomplete: str) -> Iterator[tuple[str, str]]:
    """Printer profiles, and TOML files."""
    names = _installed("printers", "profiles", "bellows_design.printers")
    yield from beginning(incomplete, names, "a printer profile")
    yield from files_ending(incomplete, (".toml",))


@silent
def filaments(incomplete: str) -> Iterator[tuple[str, str]]:
    """Filaments, and TOML files."""
    names = _installed("printers", "filaments", "bellows_design.filaments")
    yield from beginning(incomplete, names, "a filament")
    yield from files_ending(incomplete, (".toml",))


def materials() -> list[str]:
    """Names of the library's materials."""
    return _installed("bellows_design.materials", "", "bellows_design.materials")


@silent
def scenes(design: str, incomplete: str) -> Iterator[tuple[str, str]]:
    """Scenes that are built in, those of the ``design``, and TOML files."""
    own = design_table(design).get("scenes", {})
    yield from beginning(incomplete, BUILT_IN_SCENES, "built in")
    yield from beginning(incomplete, own, f"a scene of {design}")
    yield from files_ending(incomplete, (".toml",))


@silent
def exports(incomplete: str) -> Iterator[tuple[str, str]]:
    """Folders of exports below the working folder."""
    for manifest in sorted(Path().glob("*/*/manifest.json"))[:MOST_FILES]:
        folder = str(manifest.parent)
        if folder.startswith(incomplete):
            yield folder, "an export"


def beginning(incomplete: str, names: Iterable[str], about: str = "") -> Iterator[tuple[str, str]]:
    """Those of the names that begin so."""
    return ((name, about) for name in sorted(names) if name.startswith(incomplete))


def files_ending(incomplete: str, suffixes: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Files with such a suffix where the word points, and in folders there."""
    folder, _, _ = incomplete.rpartition("/")
    base = Path(folder or ("/" if incomplete.startswith("/") else "."))
    found = (
        path
        for pattern in ("*", "*/*")
        for path in sorted(base.glob(pattern))
        if path.suffix.lower() in suffixes and not path.name.startswith(".")
    )
    for _, path in zip(range(MOST_FILES), found, strict=False):
        shown = f"./{path}" if incomplete.startswith("./") else str(path)
        if shown.startswith(incomplete):
            yield shown, "a file"


def design_table(name: str) -> dict[str, Any]:
    """The TOML of a design, shipped or in a file; empty where there is none."""
    import tomllib
    from importlib.resources import files

    with suppress(OSError, ValueError, RecursionError):
        shipped = files("bellows_design.design") / "designs" / f"{name}.toml"
        source = Path(name) if name.endswith(".toml") else shipped
        return tomllib.loads(source.read_text("utf-8"))
    return {}


def _installed(package: str, folder: str, group: str) -> list[str]:
    """Names of shipped TOML files, and of those that other packages add."""
    from importlib.metadata import entry_points

    found = _shipped(package, folder)
    for entry in entry_points(group=group):
        with suppress(Exception):
            found += _shipped(entry.value, "")
    return found


def _shipped(package: str, folder: str) -> list[str]:
    from importlib.resources import files

    entries = (files(package) / folder if folder else files(package)).iterdir()
    return [each.name[:-5] for each in entries if each.name.endswith(".toml")]
