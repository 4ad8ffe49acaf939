"""Plain values and arrays in one file: an ``.npz`` without pickle, the values in it as JSON."""

from __future__ import annotations

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


def content_of(values: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """The content of such a file."""
    text = np.frombuffer(json.dumps(values).encode(), np.uint8)
    file = io.BytesIO()
    np.savez(file, allow_pickle=False, **{VALUES: text}, **arrays)
    return file.getvalue()


def write(path: Path, content: bytes) -> None:
    """Write a file completely or not at all. Raises ``CannotWrite``, an ``OSError``."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        temporary.write_bytes(content)


def read(path: Path) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Values and arrays of a file.

    Raises ``FileNotFoundError`` where there is none, and any exception for a damaged one.
    """
    if not path.exists():
        raise FileNotFoundError(path)
    with np.load(io.BytesIO(read_file(path, "result", LARGEST)), allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    return json.loads(arrays.pop(VALUES).tobytes()), arrays
