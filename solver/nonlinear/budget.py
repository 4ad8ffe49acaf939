"""The steps and seconds that a solve may take."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from solver.nonlinear.checkpoint import Effort
from solver.nonlinear.options import SolverOptions


@dataclass
class Budget:
    """What of the bounds in ``options`` is spent since the solve ``began`` (s, monotonic)."""

    options: SolverOptions
    began: float = field(default_factory=time.monotonic)
    limited: bool = True

    @contextmanager
    def lifted(self) -> Iterator[None]:
        """Within the block it does not count: what was reached is brought to an end."""
        self.limited = False
        try:
            yield
        finally:
            self.limited = True

    def spent(self, effort: Effort) -> float:
        """Fraction of the steps or of the seconds that is spent, the larger one."""
        steps = effort.steps / self.options.maximum_steps
        seconds = self.options.seconds
        return max(steps, (time.monotonic() - self.began) / seconds if seconds else 0.0)

    def exhausted(self, effort: Effort) -> str:
        """Which part is spent, as text; empty while something is left."""
        if not self.limited or self.spent(effort) < 1:
            return ""
        if effort.steps >= self.options.maximum_steps:
            return f"the budget of {self.options.maximum_steps} steps is spent"
        return f"the budget of {self.options.seconds:.3g} s is spent"
