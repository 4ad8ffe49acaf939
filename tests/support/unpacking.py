"""What `bellows_design.web` packs, unpacked as its description says, without its code."""

from __future__ import annotations

import json
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Unpacked:
    """Header and the bytes behind it."""

    header: dict[str, Any]
    arrays: bytes

    def numbers(self, place: dict[str, int], *shape: int) -> NDArray[Any]:
        """The array at a place, summed along its last axis but one."""
        size = place["bytes"]
        begin = place["offset"]
        planes = np.frombuffer(self.arrays[begin : begin + size * place["count"]], np.uint8)
        kind = {2: np.uint16, 4: np.uint32}[size]
        differences = sum(
            plane.astype(kind) << (8 * number)
            for number, plane in enumerate(planes.reshape(size, place["count"]))
        )
        return np.cumsum(np.reshape(differences, shape), axis=-2, dtype=kind)

    def positions(self, surface: int) -> NDArray[np.float64]:
        """(k, n, 3) mm."""
        one = self.header["surfaces"][surface]
        levels = self.numbers(one["positions"], one["frames"], one["points"], 3)
        levels = np.cumsum(levels, axis=0, dtype=np.uint16)
        low, high = np.array(one["low"]), np.array(one["high"])
        return low + levels / 65535 * (high - low)

    def cells(self, surface: int) -> NDArray[Any]:
        """(m, 3) triangles or (m, 2) segments."""
        one = self.header["surfaces"][surface]
        return self.numbers(one["cells"], one["cells"]["count"] // one["corners"], one["corners"])

    def values(self, surface: int, field: int) -> NDArray[np.float64]:
        """(k, n) or (1, n)."""
        one = self.header["surfaces"][surface]
        about = one["fields"][field]
        levels = self.numbers(about["values"], about["frames"], one["points"], 1)[..., 0]
        levels = np.cumsum(levels, axis=0, dtype=np.uint16)
        span = about["high"] - about["low"]
        return np.where(levels == 65535, np.nan, about["low"] + levels / 65534 * span)


def unpacked(packed: bytes) -> Unpacked:
    """Inflate and part a binary."""
    inflated = zlib.decompress(packed)
    length = int.from_bytes(inflated[:4], "little")
    return Unpacked(json.loads(inflated[4 : 4 + length]), inflated[4 + length :])
