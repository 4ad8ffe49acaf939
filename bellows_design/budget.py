"""What an evaluation may take of the machine."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from bellows_design.errors import DesignError
from bellows_design.machine import memory_gib

SHARE, MOST, FALLBACK = 0.75, 4.0, 4.0
"""By default an evaluation may take that share of the machine's memory, at most so many GiB (for
110 000 tetrahedra, minutes for each mesh), and so many where the memory is unknown."""

LEAST_MEMORY = 0.8
"""GiB. The libraries alone take nearly as much."""

MESH_SECONDS, LONGEST = 120.0, 86_400.0
"""s. Default and bound of the time limit of one mesh; the largest meshes took half of that."""

SECONDS = 240.0
"""s. Default time limit of an evaluation."""


def default_memory() -> float:
    """Memory that an evaluation may take unless a limit is given, GiB."""
    available = memory_gib()
    return FALLBACK if available is None else max(LEAST_MEMORY, min(MOST, SHARE * available))


@dataclass(frozen=True)
class Budget:
    """Limits of an evaluation.

    ``memory`` in GiB; ``mesh_seconds`` for each of its meshes, and ``seconds`` for all of it: then
    it stops with the last good state, and begins no mesh that would take longer.

    Raises ``DesignError`` if one is out of bounds.
    """

    memory: float = field(default_factory=default_memory)
    mesh_seconds: float = MESH_SECONDS
    seconds: float = SECONDS

    def __post_init__(self) -> None:
        if not (math.isfinite(self.memory) and self.memory >= LEAST_MEMORY):
            raise DesignError(
                f"memory is {self.memory:g} GiB but must be finite and at least {LEAST_MEMORY:g} "
                "GiB."
            )
        for name in ("mesh_seconds", "seconds"):
            if not 0 < getattr(self, name) <= LONGEST:
                raise DesignError(
                    f"{name} is {getattr(self, name):g} s but must lie above 0 and not above "
                    f"{LONGEST:g} s."
                )


DEFAULT = Budget()
