"""Plain values and arrays in one file: an ``.npz`` without pickle, the values in it as JSON."""

from __future__ import annotations

import errno
import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bellows_design.files.atomic import replacing
from bellows_design.files.guarded import read_file

VALUES = "values"
"""Name of the array that holds the JSON."""

LARGEST = 2**31
"""Bytes. No evaluation within any budget comes near."""

_VANISHED = errno.ENOENT, errno.EEXIST
"""Errors where the folder is gone; the second is of ``mkdir`` that found it a moment before."""

_ATTEMPTS = 100
"""Each fails only if others remove the folder just between its making and the first file in it."""


def content_of(values: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """The content of such a file."""
    text = np.frombuffer(json.dumps(values).encode(), np.uint8)
    file = io.BytesIO()
    np.savez(file, allow_pickle=False, **{VALUES: text}, **arrays)
    return file.getvalue()


def write(path: Path, content: bytes) -> None:
    """Write a file completely or not at all. Raises ``CannotWrite``, an ``OSError``.

    Others may remove the folder as long as it is empty: then it is made again.
    """
    for attempt in range(1, _ATTEMPTS + 1):
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with replacing(path) as temporary:
                temporary.write_bytes(content)
            return
        except OSError as error:
            if error.errno not in _VANISHED or attempt == _ATTEMPTS:
                raise


def read(path: Path) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Values and arrays of a file.

    Raises ``FileNotFoundError`` where there is none, and any exception for a damaged one.
    """
    if not path.exists():
        raise FileNotFoundError(path)
    with np.load(io.BytesIO(read_file(path, "result", LARGEST)), allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    return json.loads(arrays.pop(VALUES).tobytes()), arrays
