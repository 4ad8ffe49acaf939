"""Messages between the program and its meshing process over a pipe: values and arrays by name.

A message is the length of its head in eight bytes, the head as JSON, and then the arrays' bytes as
they lie in memory: both ends run on one machine, so numbers arrive bit by bit as they were sent.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import RawIOBase
from typing import Any

import numpy as np
from numpy.typing import NDArray

LENGTH_BYTES = 8


@dataclass(frozen=True)
class Message:
    """Plain values (of JSON) and arrays, both by name."""

    values: Mapping[str, Any]
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)


def send(stream: RawIOBase, message: Message) -> None:
    """Write ``message`` to an unbuffered ``stream``. Raises ``OSError`` if the reader closed it."""
    arrays = {name: np.ascontiguousarray(array) for name, array in message.arrays.items()}
    forms = [[name, array.dtype.str, array.shape] for name, array in arrays.items()]
    head = json.dumps({"values": message.values, "arrays": forms}).encode()
    _write(stream, len(head).to_bytes(LENGTH_BYTES, "little") + head)
    for array in arrays.values():
        _write(stream, array.reshape(-1).view(np.uint8).data)


def receive(stream: RawIOBase) -> Message | None:
    """The next message from an unbuffered ``stream``; None at its end, also within a message."""
    try:
        head = json.loads(_read(stream, int.from_bytes(_read(stream, LENGTH_BYTES), "little")))
        arrays = {name: _array(stream, kind, shape) for name, kind, shape in head["arrays"]}
    except (EOFError, OSError):
        return None
    return Message(head["values"], arrays)


def _array(stream: RawIOBase, kind: str, shape: list[int]) -> NDArray[Any]:
    size = int(np.prod(shape)) * np.dtype(kind).itemsize
    return np.frombuffer(_read(stream, size), kind).reshape(shape)


def _write(stream: RawIOBase, content: bytes | memoryview) -> None:
    rest = memoryview(content)
    while len(rest):
        rest = rest[stream.write(rest) or 0 :]


def _read(stream: RawIOBase, size: int) -> bytearray:
    content = bytearray(size)
    rest = memoryview(content)
    while len(rest):
        count = stream.readinto(rest)
        if not count:
            raise EOFError
        rest = rest[count:]
    return content
