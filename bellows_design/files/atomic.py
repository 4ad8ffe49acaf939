"""Files and folders that are either complete or not there.

What is not complete yet stands beside its target under a name that begins with a dot and tells
which process on which machine is at work on it, and is locked as long as that process lives.
Whatever a killed process left is removed by the next one that writes anything to the same folder.
"""

from __future__ import annotations

import errno
import os
import platform
import re
import secrets
import shutil
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from bellows_design.files.errors import CannotWrite
from bellows_design.files.locks import is_locked, locked

MARK = "bellows-tmp"
"""Part of the name of everything temporary."""

_LONGEST_NAME = 40
"""Characters of the target's name in a temporary one: a file's name has 255 bytes at most."""


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Path of a temporary file beside ``target`` that takes its place when the block succeeds.

    The temporary name keeps the suffix: writers choose the format by it. When the block fails, or
    is interrupted, the temporary file goes and ``target`` stays as it was. Raises ``CannotWrite``,
    an ``OSError``, if the folder is missing or full, or the file cannot be written to it.
    """
    try:
        with _file_at_work(target) as temporary:
            yield temporary
            _settle(temporary)
            os.replace(temporary, target)
    except OSError as error:
        raise CannotWrite(target, error) from error


def require_writable(target: Path) -> None:
    """Raise ``CannotWrite`` if no file can be written at ``target``, by trying it beside it."""
    try:
        with _file_at_work(target) as temporary:
            temporary.write_bytes(b"?")
        with suppress(FileNotFoundError):  # too long a name, another's file in a shared folder
            _require_replaceable(target.parent.stat(), target.lstat())
    except OSError as error:
        raise CannotWrite(target, _lost_folder(target) or error) from error


@contextmanager
def at_work(target: Path) -> Iterator[Path]:
    """A path beside ``target`` for what is not complete yet; what stands there goes with the block.

    It goes too if the process is ended by ``remove_unfinished`` within the block.
    """
    temporary = temporary_beside(target)
    unfinished = _unfinished(os.getpid())
    unfinished.add(temporary)
    try:
        yield temporary
    finally:
        with suppress(OSError):
            remove(temporary)
        unfinished.discard(temporary)


def remove_unfinished() -> None:
    """Remove what this process is at work on: it ends at once."""
    for path in tuple(_unfinished(os.getpid())):
        with suppress(OSError):
            remove(path)


@contextmanager
def _file_at_work(target: Path) -> Iterator[Path]:
    """An empty private file beside ``target``, locked, and gone after the block."""
    remove_leftovers(target.parent)
    with at_work(target) as temporary:
        temporary.touch(mode=0o600, exist_ok=False)
        with locked(temporary):
            yield temporary


def temporary_beside(target: Path) -> Path:
    """A path in ``target``'s folder that nothing has and that is known to be this process's."""
    own = f"{_machine()}-{os.getpid()}-{_session(os.getpid())}-{secrets.token_hex(4)}"
    return target.with_name(f"{_beginning(target)}{own}{target.suffix[:_LONGEST_NAME]}")


def remove_leftovers(folder: Path) -> None:
    """Remove what processes of this machine that are no more left in ``folder``."""
    try:
        present = tuple(folder.iterdir())
    except (FileNotFoundError, NotADirectoryError):
        return
    for path in present:
        if MARK in path.name and _is_left_over(path.name) and not is_locked(path):
            with suppress(OSError):
                remove(path)


def remove(path: Path) -> None:
    """Remove a file, a link, or a folder with all it holds, if it is there."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def open_to_readers(path: Path) -> None:
    """Give a private temporary file or folder the mode that new ones have here."""
    mask = os.umask(0)
    os.umask(mask)
    path.chmod((0o777 if path.is_dir() else 0o666) & ~mask)


def _require_replaceable(folder: os.stat_result, file: os.stat_result) -> None:
    """Refuse what a shared folder such as ``/tmp`` protects: the files of other users."""
    if not hasattr(os, "geteuid"):
        return
    mine = os.geteuid() in (0, file.st_uid, folder.st_uid)
    if folder.st_mode & stat.S_ISVTX and not mine:
        raise PermissionError(errno.EPERM, "another user's file stands there")


def _lost_folder(target: Path) -> str | None:
    """A reason if ``target`` is relative to a working folder that is no more."""
    try:
        target.absolute()
    except FileNotFoundError:
        return "the working folder was deleted"
    return None


def _settle(path: Path) -> None:
    """Readable, and on the disk, before it is renamed."""
    open_to_readers(path)
    with path.open("rb") as file:
        os.fsync(file.fileno())


def _beginning(target: Path) -> str:
    return f".{target.name[:_LONGEST_NAME]}.{MARK}-"


def _is_left_over(name: str) -> bool:
    found = re.search(rf"\.{MARK}-([A-Za-z0-9_]*)-(\d+)-([0-9a-f]+)-[0-9a-f]+", name)
    if found is None or found.group(1) != _machine():
        return False
    process, session = int(found.group(2)), found.group(3)
    if process == os.getpid():  # an earlier one may have had the same number
        return session != _session(process)
    return not _is_running(process)


@cache
def _unfinished(process: int) -> set[Path]:
    """What the process is at work on; a forked copy of it begins with nothing."""
    return set()


@cache
def _machine() -> str:
    return re.sub(r"[^A-Za-z0-9]+", "_", platform.node())[:20]


@cache
def _session(process: int) -> str:
    """What tells this process from others that had or will have its number."""
    return secrets.token_hex(4)


def _is_running(process: int) -> bool:
    """True if there is such a process on this machine; true also where nobody can tell."""
    if sys.platform == "win32":  # there os.kill would end it
        import ctypes

        query = 0x1000  # PROCESS_QUERY_LIMITED_INFORMATION
        handle = ctypes.windll.kernel32.OpenProcess(query, False, process)
        ctypes.windll.kernel32.CloseHandle(handle)
        return bool(handle)
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:  # someone else's
        return True
    return True
