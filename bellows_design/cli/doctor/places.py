"""Folders that are written to, text that can be shown, and variables of the environment."""

from __future__ import annotations

import locale
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from bellows_design.cli.doctor.finding import Finding
from bellows_design.validation.quoting import near, quoted, shown

GROUP = "places"
GIB = 2**30
LEAST_FREE_GIB = 0.5
"""GiB on a disk, below which exports and caches may fill it."""

PREFIX = "BELLOWS_"
VARIABLES = ("BELLOWS_CACHE", "BELLOWS_SLICER", "BELLOWS_TRACEBACK")
"""That this program reads."""

LONGEST_VALUE = 100


def cache() -> Finding:
    """Where results are kept, and how many there are."""
    from bellows_design.store.place import NoPlace
    from bellows_design.store.store import Store

    mend = "set BELLOWS_CACHE to a folder that can be written"
    try:
        store = Store.usual()
    except NoPlace as error:
        return Finding(GROUP, "cache", "warn", str(error), mend)
    if why := _unwritable(store.folder):
        return Finding(GROUP, "cache", "warn", f"{store.folder}: {why}", mend)
    held = store.holdings()
    return Finding(
        GROUP, "cache", "ok", f"{store.folder}, {held.results} results, {held.size / 2**20:.0f} MiB"
    )


def exports() -> Finding:
    """Whether ``exports`` can be written below the working folder."""
    folder = Path("exports").absolute()
    if why := _unwritable(folder):
        mend = "change to another folder, or name one with --output"
        return Finding(GROUP, "exports", "warn", f"{folder}: {why}", mend)
    return Finding(GROUP, "exports", "ok", str(folder))


def temporary() -> Finding:
    """Where Gmsh and the slicer work."""
    try:
        with tempfile.TemporaryDirectory(prefix="bellows-doctor-") as folder:
            return Finding(GROUP, "temporary files", "ok", str(Path(folder).parent))
    except OSError as error:
        said = error.strerror or str(error)
        return Finding(GROUP, "temporary files", "fail", said, "set TMPDIR to a writable folder")


def disks() -> Iterator[Finding]:
    """Room on the disks of the working folder and of temporary files."""
    for name, folder in (("working folder", os.curdir), ("temporary", tempfile.gettempdir())):
        free = shutil.disk_usage(folder).free / GIB
        said = f"{free:.1f} GiB free for {name}"
        if free < LEAST_FREE_GIB:
            yield Finding(GROUP, f"disk, {name}", "warn", said, "make room on it")
        else:
            yield Finding(GROUP, f"disk, {name}", "ok", said)


def encoding() -> Finding:
    """Whether ° and µ can be shown."""
    stream = getattr(sys.stdout, "encoding", None) or "unknown"
    language = ".".join(part for part in locale.getlocale() if part) or "C"
    said = f"{language}; terminal {stream}, file names {sys.getfilesystemencoding()}"
    try:
        "°µ²Ć│━".encode(stream)
    except (UnicodeEncodeError, LookupError):
        mend = "export LC_ALL=C.UTF-8, or PYTHONIOENCODING=utf-8: signs like ° become ?"
        return Finding(GROUP, "locale", "warn", said, mend)
    return Finding(GROUP, "locale", "ok", said)


def variables() -> Iterator[Finding]:
    """Variables of this program that are set; those that it does not know."""
    for name in sorted(each for each in os.environ if each.startswith(PREFIX)):
        value = quoted(shown(os.environ[name], LONGEST_VALUE))
        if name in VARIABLES:
            yield Finding("environment", name, "ok", value)
        else:
            said = f"{value}, which this program does not read"
            yield Finding("environment", name, "warn", said, _variable_near(name))


def _variable_near(name: str) -> str:
    """The variable that may be meant, by what follows the beginning that all have."""
    known = {each.removeprefix(PREFIX): each for each in VARIABLES}
    hint = near(name.removeprefix(PREFIX), known).removeprefix("; did you mean ").rstrip("?")
    return f"did you mean {known[hint]}?" if hint else f"it reads {', '.join(VARIABLES)}"


def _unwritable(folder: Path) -> str:
    """Why nothing can be written there, or made where it is not there yet; empty if it can."""
    there = folder
    while not there.exists() and there != there.parent:
        there = there.parent
    if not there.is_dir():
        return f"{there} is no folder"
    try:
        with tempfile.TemporaryFile(dir=there):
            return ""
    except OSError as error:
        return error.strerror or str(error)
