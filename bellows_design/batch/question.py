"""What is asked about one design of many."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from bellows_design.design.design import Design
from bellows_design.neighbours.carried import REACH

Start = Literal["nearest", "ordinary"]
"""From the nearest design solved so far, if there is one near, or each design by itself."""


@dataclass(frozen=True)
class Question:
    """One design to be evaluated, and what its evaluation starts from.

    Attributes:
        design: What is evaluated.
        start: ``nearest``, ``ordinary``, or a design: its ordinary evaluation is the neighbour that
            this one is reached from, and is computed first where it is not at hand.
        derivatives: Also those of angle, volume and highest stress.
        accuracy_percent: Of an ordinary evaluation, as for ``evaluate``.
        reach: Distance from ``start``, where that is a design, up to which it is a neighbour.
    """

    design: Design
    start: Start | Design = "nearest"
    derivatives: bool = False
    accuracy_percent: float | None = None
    reach: float = REACH

    @cached_property
    def key(self) -> str:
        """64 hexadecimal digits, the same for the same question."""
        start = self.start if isinstance(self.start, str) else self.start.digest
        asked = [self.design.digest, start, self.derivatives, self.accuracy_percent, self.reach]
        return hashlib.sha256(json.dumps(asked).encode()).hexdigest()
