"""What a kept result is found by: all that decides its numbers, to the last digit."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.store.surroundings import surroundings


@dataclass(frozen=True)
class Key:
    """What was asked, and the surroundings it is computed in.

    ``asked`` are plain values, ``text`` the digest of them, ``surroundings`` that of programs and
    machine; both are hexadecimal.
    """

    asked: dict[str, Any]
    surroundings: str

    @property
    def text(self) -> str:
        """SHA-256 of what was asked."""
        return digest(self.asked)


def key_of(
    design: Design,
    model: str,
    accuracy_percent: float | None,
    pressures: Sequence[float],
    budget: Budget,
    further_meshes: int = 0,
) -> Key:
    """The key of an ordinary evaluation, refined by so many meshes more than it takes by itself.

    What the meshes were refined for needs no place in it: it decides how many there are, and
    nothing else. The strains of the material's tests are no part of a design's digest, but warn.
    Nor are limits, printer, mount and scenes: no evaluation reads them.
    """
    asked = {
        "design": design.as_evaluated.digest,
        "valid_strain": design.material.valid_strain,
        "model": model,
        "accuracy_percent": None if accuracy_percent is None else float(accuracy_percent),
        "pressures_mpa": sorted(float(pressure) for pressure in pressures),
        "budget": {name: float(limit) for name, limit in asdict(budget).items()},
        "further_meshes": further_meshes,
    }
    return Key(plain(asked), present_surroundings())


@cache
def present_surroundings() -> str:
    """Digest of what decides a number besides the question: twenty hexadecimal digits."""
    return digest(surroundings())[:20]


def digest(content: dict[str, Any]) -> str:
    """SHA-256 of plain values, whatever the order of their keys."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def plain(content: dict[str, Any]) -> dict[str, Any]:
    """The content as JSON gives it back."""
    result: dict[str, Any] = json.loads(json.dumps(content))
    return result
