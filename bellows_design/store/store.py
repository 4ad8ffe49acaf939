"""Evaluations and laws kept in files, for all processes of a user, within a bound.

A folder for each kind of result, in it one for each of the surroundings results were computed in,
in it a file for each result: ``evaluations/<surroundings>/<key>.npz``. Kinds do not mix: what is
reached from a neighbouring design, say, never stands where ordinary evaluations are looked for.

Files are written under a temporary name and renamed. One that cannot be read, whatever the reason,
is no result and goes. A file's time is that of its last use; the least recently used goes first.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from stat import S_ISREG
from typing import TYPE_CHECKING, Any, TypeVar

from bellows_design.files.atomic import remove_leftovers
from bellows_design.store.key import Key, present_surroundings
from bellows_design.store.place import cache_folder

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.design.design import Design

    Values = dict[str, Any]
    Arrays = dict[str, NDArray[Any]]

LIMIT = 2**30
"""Bytes. An evaluation of the default accuracy takes about 2 MB."""

ORDINARY = "evaluations"
"""The kind that verdicts rest on: meshes of the design's own solid, loaded from zero."""

LAWS = "laws"
"""Of half bubbles, in tables."""

KINDS = (ORDINARY, LAWS)

Record = TypeVar("Record")

_SURROUNDINGS, _KEY = re.compile("[0-9a-f]{20}"), re.compile(r"[0-9a-f]{64}\.npz")


@dataclass(frozen=True)
class Holdings:
    """What a store holds: results of all surroundings, and of those the ones that may be found.

    Sizes in bytes; ``oldest`` and ``newest`` are times of last use (UTC), None without any result.
    """

    folder: Path
    limit: int
    results: int
    usable: int
    size: int
    oldest: datetime | None
    newest: datetime | None

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "folder": str(self.folder),
            "results": self.results,
            "usable": self.usable,
            "size_mib": self.size / 2**20,
            "limit_mib": self.limit / 2**20,
            "oldest": None if self.oldest is None else written(self.oldest),
            "newest": None if self.newest is None else written(self.newest),
        }


@dataclass(frozen=True)
class _File:
    """One result's file: its size in bytes and the time of its last use, s since 1970."""

    path: Path
    size: int
    used: float


@dataclass(frozen=True)
class Store:
    """Results below ``folder``, of at most ``limit`` bytes together."""

    folder: Path
    limit: int = LIMIT
    kind: str = ORDINARY

    def of_kind(self, kind: str) -> Store:
        """The same place for another kind of results, one of ``KINDS``."""
        return replace(self, kind=kind)

    @staticmethod
    def usual() -> Store:
        """The one of this user."""
        return Store(cache_folder())

    def find(self, key: Key, design: Design) -> Evaluation | None:
        """The evaluation of ``design`` that is kept under ``key``; None if there is none."""
        from bellows_design.store.records import evaluation_from

        return self.find_record(key, lambda values, arrays: evaluation_from(values, arrays, design))

    def find_record(self, key: Key, made: Callable[[Values, Arrays], Record]) -> Record | None:
        """What ``made`` makes of what is kept under ``key``; None if there is nothing."""
        path = self._path(key)
        try:
            record = made(*_read(path, key))
            with suppress(OSError):  # a folder that may only be read
                os.utime(path)
            return record
        except FileNotFoundError:
            return None
        except Exception:  # damage shows in any of NumPy's, zip's, JSON's or our own ways
            with suppress(OSError):
                path.unlink()
            return None

    def keep(self, key: Key, evaluation: Evaluation) -> bool:
        """Keep ``evaluation`` under ``key``; whether that was done.

        Not kept is what a limit of time had a part in, which is another one on another day, and
        what is larger than the whole store. Raises ``OSError`` if the file cannot be written.
        """
        from bellows_design.store.records import record_of

        if not evaluation.computation.in_time:
            return False
        dated = replace(evaluation, from_cache=written(datetime.now(UTC)))
        return self.keep_record(key, *record_of(dated))

    def keep_record(self, key: Key, values: Values, arrays: Arrays) -> bool:
        """Keep values and arrays under ``key``, unless they are larger than the whole store.

        Raises ``OSError`` if the file cannot be written.
        """
        from bellows_design.store.files import content_of, write

        content = content_of({"asked": key.asked, **values}, arrays)
        if len(content) > self.limit:
            return False
        write(self._path(key), content)
        self._trim()
        return True

    def holdings(self) -> Holdings:
        """What is there."""
        files = self._files()
        usable = [file for file in files if file.path.parent.name == present_surroundings()]
        times = [datetime.fromtimestamp(file.used, UTC) for file in files]
        return Holdings(
            self.folder,
            self.limit,
            len(files),
            len(usable),
            sum(file.size for file in files),
            min(times, default=None),
            max(times, default=None),
        )

    def clear(self) -> int:
        """Remove all results, and nothing else; how many could not be removed."""
        left = sum(not self._remove(file) for file in self._files())
        for folder in self._folders():
            remove_leftovers(folder)
            with suppress(OSError):  # another process is at work in it
                folder.rmdir()
        for kind in KINDS:
            with suppress(OSError):
                (self.folder / kind).rmdir()
        return left

    def _path(self, key: Key) -> Path:
        return self.folder / self.kind / key.surroundings / f"{key.text}.npz"

    def _trim(self) -> None:
        """Remove the least recently used until the rest keeps the limit."""
        files = sorted(self._files(), key=lambda file: file.used)
        excess = sum(file.size for file in files) - self.limit
        for file in files:
            if excess <= 0:
                break
            excess -= file.size if self._remove(file) else 0

    def _remove(self, file: _File) -> bool:
        """Remove a result, and the last one's folder; whether it is gone."""
        try:
            file.path.unlink(missing_ok=True)  # another process may be faster
        except OSError:  # it may be reading it on Windows
            return False
        with suppress(OSError):  # others of its surroundings
            file.path.parent.rmdir()
        return True

    def _files(self) -> list[_File]:
        return [file for folder in self._folders() for file in _files_in(folder)]

    def _folders(self) -> list[Path]:
        """Of all kinds, which share the limit."""
        found = (path for kind in KINDS for path in _entries(self.folder / kind))
        return [path for path in found if _is(path, _SURROUNDINGS)]


def written(time: datetime) -> str:
    """A time (UTC) as ISO 8601 has it, to the second."""
    return time.strftime("%Y-%m-%dT%H:%M:%SZ")


def _read(path: Path, key: Key) -> tuple[Values, Arrays]:
    from bellows_design.store.files import read

    values, arrays = read(path)
    if values["asked"] != key.asked:
        raise ValueError("another question's answer")
    return values, arrays


def _files_in(folder: Path) -> Iterator[_File]:
    for path in _entries(folder):
        if _is(path, _KEY):
            with suppress(OSError):  # another process removed it
                status = path.stat()
                if S_ISREG(status.st_mode):
                    yield _File(path, status.st_size, status.st_mtime)


def _entries(folder: Path) -> list[Path]:
    try:
        return sorted(folder.iterdir())
    except OSError:
        return []


def _is(path: Path, name: re.Pattern[str]) -> bool:
    return name.fullmatch(path.name) is not None and not path.is_symlink()
