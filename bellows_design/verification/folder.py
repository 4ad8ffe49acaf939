"""The files of an export beside what its manifest lists.

The folder may come from anyone: nothing outside of it is opened, no link followed, and no file read
that is larger than the manifest says.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.export.manifest import (
    FIRST_FORMAT,
    LARGEST,
    MANIFEST,
    RUN,
    NoObject,
    fingerprint,
    is_plain,
    parsed,
    parsed_manifest,
)
from bellows_design.export.seal import seal_holds
from bellows_design.files.guarded import read_file
from bellows_design.validation.quoting import near_file, quoted, quoted_path
from bellows_design.verification.record import FileCheck, State

LARGEST_FILE = 512 * 2**20
"""Bytes, as for parts of other programs."""

KEYS = {"format", "digest", "verdict", "design", "files", "sha256"}
"""Of a manifest of ours."""

PIECE = 2**20
"""Bytes that are read at once."""

MOST_NAMED = 100
"""Files that are not listed; of a folder with more of them no more are named."""


def sealed_manifest(folder: Path) -> tuple[dict[str, Any], bytes] | FileCheck:
    """The manifest in ``folder`` and its bytes, or why it cannot be relied on.

    Raises ``DesignError`` if ``folder`` is no export: no folder, or one without a manifest.
    """
    path = folder / MANIFEST
    if folder.is_file():
        raise DesignError(f"{quoted_path(folder)} is a file; an export is a folder.")
    if not folder.is_dir():
        raise DesignError(f"there is no folder {quoted_path(folder)}{near_file(folder) or '.'}")
    if path.is_symlink() or not path.is_file():
        raise DesignError(f"{quoted_path(folder)} is no export: it holds no {MANIFEST}.")
    content = read_file(path, "manifest", LARGEST)
    if _is_foreign(content, path):
        raise DesignError(f"{quoted_path(path)} is no manifest of bellows-design.")
    if not seal_holds(content):
        return FileCheck(MANIFEST, "changed", _unsealed(content, path))
    return parsed_manifest(content, path), content


def _is_foreign(content: bytes, path: Path) -> bool:
    """Whether this is JSON of another program, not a manifest of ours that was changed.

    Whoever changes ours leaves most of its keys.
    """
    try:
        return len(KEYS & parsed(content, path).keys()) < 2
    except NoObject:
        return True
    except DesignError:
        return False


def _unsealed(content: bytes, path: Path) -> str:
    """Why a manifest without a seal that holds is none to rely on."""
    try:
        if parsed_manifest(content, path)["format"] == FIRST_FORMAT:
            return "it was written by an earlier version, without a seal; export the design again"
    except DesignError:
        pass
    return "its seal is broken; nothing else can be told from it"


def checked_files(
    folder: Path, manifest: Mapping[str, Any], content: bytes
) -> tuple[FileCheck, ...]:
    """Every file that the sealed ``manifest``, of these bytes, lists or that is in ``folder``."""
    listed: Mapping[str, Any] = manifest["files"]
    run, report = _run_file(folder, content)
    checks = [FileCheck(MANIFEST, "as written"), run]
    both = sorted({**report, **listed}.items())
    checks += [_listed(folder, name, print_) for name, print_ in both]
    known = {MANIFEST, RUN, *report, *listed}
    with os.scandir(folder) as entries:
        others = (each.name for each in entries if each.name not in known)
        found = sorted(islice(others, MOST_NAMED))
    return (*checks, *(FileCheck(_shown(name), "not listed") for name in found))


def _run_file(folder: Path, manifest: bytes) -> tuple[FileCheck, Mapping[str, Any]]:
    """The file of times and machine: sealed by itself, and of this manifest.

    And the report that it lists, its name -> fingerprint; none if the file is not to be relied on.
    """
    problem = _irregular(folder / RUN)
    if problem is not None:
        return FileCheck(RUN, *problem), {}
    try:
        content = read_file(folder / RUN, "run", LARGEST)
        stated = parsed(content, folder / RUN) if seal_holds(content) else {}
    except DesignError as error:
        return FileCheck(RUN, "changed", str(error)), {}
    if not stated:
        return FileCheck(RUN, "changed", "its seal is broken"), {}
    if stated.get("manifest") != fingerprint(manifest)["sha256"]:
        return FileCheck(RUN, "changed", "it belongs to another manifest"), {}
    report = stated.get("report")
    return FileCheck(RUN, "as written"), report if isinstance(report, dict) else {}


def _listed(folder: Path, name: str, print_: object) -> FileCheck:
    """A file that the manifest lists; its name is shown in printable characters alone."""
    state, why = _state(folder, name, print_) or ("as written", "")
    return FileCheck(_shown(name), state, why)


def _state(folder: Path, name: str, print_: object) -> tuple[State, str] | None:
    """What is wrong with a listed file; None if nothing is."""
    if not is_plain(name):
        return "no file", "the name leads out of the folder"
    problem = _irregular(folder / name)
    if problem is not None:
        return problem
    if not isinstance(print_, dict) or set(print_) != {"sha256", "bytes"}:
        return "changed", "the manifest states no hash of it"
    found, wanted = (folder / name).lstat().st_size, print_["bytes"]
    if found != wanted or found > LARGEST_FILE:
        return "changed", f"it has {found} bytes instead of {_shown(wanted)}"
    same = _hash(folder / name, found) == print_["sha256"]
    return None if same else ("changed", "its hash is another than the manifest's")


def _irregular(path: Path) -> tuple[Any, str] | None:
    """Why there is no file to look at; None if there is."""
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return "missing", ""
    except (OSError, ValueError) as error:
        return "no file", str(getattr(error, "strerror", None) or error)
    if stat.S_ISLNK(mode):
        return "no file", "it is a link"
    return None if stat.S_ISREG(mode) else ("no file", "it is a folder, a pipe or a device")


def _hash(path: Path, length: int) -> str:
    """SHA-256 of the first ``length`` bytes; a link that came there meanwhile is not followed."""
    digest = hashlib.sha256()
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        with open(os.open(path, flags | getattr(os, "O_BINARY", 0)), "rb") as file:
            for piece in _pieces(file, length + 1):
                digest.update(piece)
    except OSError as error:
        return error.strerror or str(error)
    return digest.hexdigest()


def _pieces(file: Any, length: int) -> Iterator[bytes]:
    while length > 0 and (piece := file.read(min(PIECE, length))):
        length -= len(piece)
        yield piece


def _shown(value: object) -> str:
    """A name or value of the manifest as text for terminals, not too long."""
    return quoted(value) if not isinstance(value, str) or not value.isprintable() else value[:200]
