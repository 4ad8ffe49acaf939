"""``numba.njit`` with a cache on disk that depends on all files a function is compiled from.

numba's own cache depends on the file of a function alone. Functions of other files are compiled
into it, and changes of those would be missed. So compiled functions that call each other across
files are cached in a folder whose name is a hash of all these
files. A function that calls compiled functions of its own file only may use
``solver.compilation.njit`` itself.
"""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeVar

from numba import config

from solver.compilation import njit

settings: Any = config

# Threads of numba and of MKL, which have an OpenMP library each, shall sleep while they wait: busy
# ones take the processor from each other, and from Gmsh.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

Function = TypeVar("Function", bound=Callable[..., Any])

PACKAGE = Path(__file__).parents[1]
SOURCES = ("numerics", "material", "kernels")
"""Folders of the package whose compiled functions call each other."""

KEPT_SECONDS = 7 * 24 * 3600.0
"""Caches of other versions are removed when none of their functions was imported for a week."""


def compiled(**options: Any) -> Callable[[Function], Function]:
    """Decorator: compile with numba's ``options``, and cache by the content of ``SOURCES``.

    Other threads of the program run meanwhile: compiled functions touch arrays and numbers only.
    """

    def decorate(function: Function) -> Function:
        usual = settings.CACHE_DIR
        settings.CACHE_DIR = cache_folder(usual)
        try:
            decorated: Function = njit(cache=True, error_model="numpy", nogil=True, **options)(
                function
            )
        finally:
            settings.CACHE_DIR = usual
        return decorated

    return decorate


@cache
def cache_folder(asked_for: str) -> str:
    """Where compiled functions go: below NUMBA_CACHE_DIR, or ``asked_for``, else beside the code.

    Empty, numba's own choice, where the package cannot be written to: such a copy was installed,
    and the times of its files change together.
    """
    base = Path(asked_for) if asked_for else PACKAGE / "numerics" / "__pycache__"
    folder = base / f"solver-{source_hash()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
    except OSError:
        return asked_for
    _remove_unused(base)
    return str(folder)


def source_hash() -> str:
    """Sixteen hexadecimal digits of all files with compiled functions."""
    digest = sha256()
    for name in SOURCES:
        for path in sorted((PACKAGE / name).glob("*.py")):
            digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def _remove_unused(base: Path) -> None:
    for folder in base.glob("solver-*"):
        try:
            if time.time() - folder.stat().st_mtime > KEPT_SECONDS:
                shutil.rmtree(folder, ignore_errors=True)
        except OSError:  # another process removed it
            continue
