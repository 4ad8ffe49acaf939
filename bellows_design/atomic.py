"""Files that are either complete or not there."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Path of a temporary file beside ``target`` that takes its place when the block succeeds.

    The temporary name keeps the suffix (writers choose the format by it) and begins with a dot.
    When the block fails, or is interrupted, the temporary file goes and ``target`` stays as it
    was. Raises ``OSError`` if the folder is missing or cannot be written to.
    """
    handle, name = tempfile.mkstemp(
        prefix=f".{target.stem}-", suffix=target.suffix, dir=target.parent
    )
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        _settle(temporary)
        os.replace(temporary, target)
    finally:
        with suppress(FileNotFoundError):
            temporary.unlink()


def open_to_readers(path: Path) -> None:
    """Give a private temporary file or folder the mode that new ones have here."""
    mask = os.umask(0)
    os.umask(mask)
    path.chmod((0o777 if path.is_dir() else 0o666) & ~mask)


def _settle(path: Path) -> None:
    """Readable, and on the disk, before it is renamed."""
    open_to_readers(path)
    with path.open("rb") as file:
        os.fsync(file.fileno())
