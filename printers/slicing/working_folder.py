"""The temporary folder a slicer works in; it goes when the work is over, or its program killed."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from printers.errors import PrintersError
from printers.slicing import guardian


@contextmanager
def working_folder(kept: Path | None = None) -> Iterator[Path]:
    """A temporary folder, whose name is always as long; its files are copied to where they stay.

    Raises:
        PrintersError: Files could not be written, in it or where they stay: a full disk.
    """
    try:
        with tempfile.TemporaryDirectory(prefix="bellows-slicing-") as name, _guarded(name):
            try:
                yield Path(name)
            finally:
                if kept is not None:
                    _copy(Path(name), kept)
    except OSError as error:
        reason = error.strerror or str(error)
        raise PrintersError(f"the files for the slicer cannot be written: {reason}") from None


def _copy(folder: Path, kept: Path) -> None:
    kept.mkdir(parents=True, exist_ok=True)
    for file in filter(Path.is_file, folder.iterdir()):
        shutil.copy(file, kept)


@contextmanager
def _guarded(folder: str) -> Iterator[None]:
    """Meanwhile a guardian waits for this program to be killed; see `guardian`."""
    command = [sys.executable, "-I", "-S", str(Path(guardian.__file__)), folder]
    watching = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield
    finally:
        watching.communicate()  # its pipe ends, and it removes the folder
