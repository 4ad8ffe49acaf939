"""What a long run tells while it works: the stage, the load reached, the angle so far."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


class Progress(Protocol):
    """Receives what a run is doing."""

    def stage(self, name: str) -> None:
        """A stage begins: geometry, check, mesh, solve, export.

        Where a name counts, ``40 of 200 designs`` are done, or ``sample 3 of 20`` begins, a
        listener may tell how long the rest takes.
        """

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """The solver is at ``fraction`` of the load, with the tip turned by ``angle`` (degrees).

        ``spent``: fraction of the solve's budget of steps and seconds.
        """

    def note(self, text: str) -> None:
        """Something that is worth knowing afterwards, too."""


@dataclass(frozen=True)
class Silence:
    """Progress that is not reported."""

    def stage(self, name: str) -> None:
        """Ignored."""

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """Ignored."""

    def note(self, text: str) -> None:
        """Ignored."""


SILENCE: Progress = Silence()
"""The default where a run takes a ``Progress``."""
