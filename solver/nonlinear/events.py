"""Progress of a solve, for a listener."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from solver.nonlinear.checkpoint import Checkpoint

Kind: TypeAlias = Literal["iteration", "step", "refused"]


@dataclass(frozen=True)
class Event:
    """Progress of a solve, for a listener.

    ``kind``: ``iteration`` after each correction, ``step`` after each load step reached,
    ``refused`` after each load step given up. ``load`` is the fraction of the asked pressure
    being tried, ``rotation`` (degrees) that of the ``tip`` so far, ``correction`` (mm) the largest
    node's. A step reached on the way from zero carries a ``checkpoint`` to go on from.
    """

    kind: Kind
    load: float
    rotation: float
    iteration: int
    correction: float
    checkpoint: Checkpoint | None = None


Listener: TypeAlias = Callable[[Event], None]
