"""A scene as few bytes that a browser unpacks quickly.

The bytes are deflated (zlib). Inflated, they are

- 4 bytes: length of the header, little-endian;
- the header, JSON, with the place of every array behind it;
- the arrays.

Coordinates are 16 bit within the box of all frames of their surface, values 16 bit between the
least and the greatest of their field, 65535 for NaN; cells are 16 bit where points are few enough.
A coordinate is off by no more than the box's side over 65535 · 2, a value by its range over
65534 · 2.

Every array is stored as differences, which deflate far better: frames to the frame before, then
points to the point before, modulo 2¹⁶; first the low bytes of all numbers, then the high bytes.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bellows_design.web.scene import (
    Field,
    Lines,
    Reals,
    Shown,
    Surface,
    cells_of,
    frames_of,
    require_scene,
)

FORMAT = "bellows-scene"
VERSION = 1
LARGEST = 65535
"""Of 16 bit."""
LEVEL = 6
"""Of zlib: 9 takes five times as long for a hundredth of the size."""


class Arrays:
    """Arrays behind each other, and where each begins."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._length = 0

    def add(self, numbers: NDArray[Any]) -> dict[str, int]:
        """Append the differences of `numbers` (16 or 32 bit) along their last axis but one.

        Returns its place, its number of numbers and the bytes of each.
        """
        differences = np.diff(numbers, axis=-2, prepend=numbers[..., :1, :] * 0)
        as_bytes = np.ascontiguousarray(differences).view(np.uint8)
        planes = as_bytes.reshape(-1, numbers.itemsize).T.tobytes()
        place = {"offset": self._length, "count": numbers.size, "bytes": numbers.itemsize}
        self._parts.append(planes)
        self._length += len(planes)
        return place

    def joined(self) -> bytes:
        """All of them."""
        return b"".join(self._parts)


def deflated(header: dict[str, Any], arrays: Arrays) -> bytes:
    """Header and arrays as one binary."""
    text = json.dumps(header, allow_nan=False, separators=(",", ":")).encode()
    return zlib.compress(struct.pack("<I", len(text)) + text + arrays.joined(), LEVEL)


def packed(surfaces: Sequence[Shown]) -> bytes:
    """The scene as the viewer's `Bellows.unpack` takes it.

    Raises:
        SceneError: Shapes do not fit each other, a cell names no point, a number is not finite.
    """
    require_scene(surfaces)
    arrays = Arrays()
    described = [_described(shown, arrays) for shown in surfaces]
    return deflated({"format": FORMAT, "version": VERSION, "surfaces": described}, arrays)


def _described(shown: Shown, arrays: Arrays) -> dict[str, Any]:
    positions, cells = frames_of(shown), cells_of(shown)
    low, high = positions.min(axis=(0, 1)), positions.max(axis=(0, 1))
    small = positions.shape[1] <= LARGEST + 1
    return {
        "name": shown.name,
        "colour": shown.colour,
        "visible": shown.visible,
        "frames": positions.shape[0],
        "points": positions.shape[1],
        "low": low.tolist(),
        "high": high.tolist(),
        "cells": arrays.add(cells.astype("<u2" if small else "<u4")),
        "positions": arrays.add(_in_time(quantised(positions, low, high, LARGEST))),
    } | (_lines() if isinstance(shown, Lines) else _surface(shown, arrays))


def _lines() -> dict[str, Any]:
    return {"corners": 2, "opacity": 1.0, "frame_labels": [], "fields": []}


def _surface(surface: Surface, arrays: Arrays) -> dict[str, Any]:
    return {
        "corners": 3,
        "opacity": surface.opacity,
        "frame_labels": list(surface.frame_labels),
        "fields": [_field(field, arrays) for field in surface.fields],
    }


def _field(field: Field, arrays: Arrays) -> dict[str, Any]:
    values = np.atleast_2d(np.asarray(field.values, dtype=np.float64))
    missing = np.isnan(values)
    known = values[~missing]
    low, high = (known.min(), known.max()) if known.size else (0.0, 0.0)
    levels = quantised(np.where(missing, low, values), low, high, LARGEST - 1)
    levels[missing] = LARGEST
    return {
        "name": field.name,
        "unit": field.unit,
        "frames": len(values),
        "low": float(low),
        "high": float(high),
        "scale": [field.low, field.high],
        "limit": field.limit,
        "reverse": field.reverse,
        "missing": bool(missing.any()),
        "values": arrays.add(_in_time(levels[..., None])),
    }


def quantised(
    values: Reals, low: Reals | float, high: Reals | float, steps: int
) -> NDArray[np.uint16]:
    """The nearest of `steps` equal steps from `low` to `high`."""
    span = np.maximum(np.subtract(high, low), np.finfo(np.float64).tiny)
    levels = np.rint((np.asarray(values, np.float64) - low) / span * steps)
    return np.clip(levels, 0, steps).astype("<u2")


def _in_time(levels: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """Frames as differences to the frame before, modulo 2¹⁶."""
    return np.diff(levels, axis=0, prepend=levels[:1] * 0)
