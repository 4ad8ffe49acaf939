"""The three lanes of work that all pages share, and what new processes are told first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bellows_design.studio.workers.lane import Job, Lane

SERVER = 0
"""Owner of jobs that belong to no page."""

MOST_REMEMBERED = 4

TASKS = "bellows_design.studio.tasks"


@dataclass
class Lanes:
    """What must be there at once, previews, and what takes its time.

    ``store``: folder of kept evaluations; ``output``: folder of approved models. ``cells`` and
    ``anchors`` are the jobs that a new process of the first two lanes is given first.
    """

    store: Path
    output: Path
    quick: Lane = field(default_factory=lambda: Lane(f"{TASKS}.quick"))
    preview: Lane = field(default_factory=lambda: Lane(f"{TASKS}.preview"))
    background: Lane = field(default_factory=lambda: Lane(f"{TASKS}.background", spare=True))
    cells: list[Callable[[], Job]] = field(default_factory=list)
    anchors: list[Callable[[], Job]] = field(default_factory=list)
    warmed: bool = False

    def start(self) -> None:
        """Start a process for each lane in advance."""
        self.quick.on_start = lambda: [make() for make in self.cells]
        self.preview.on_start = lambda: [make() for make in self.anchors]
        for lane in self.all:
            lane.start()

    @property
    def all(self) -> tuple[Lane, ...]:
        """The lanes."""
        return self.quick, self.preview, self.background

    def forget(self, owner: int) -> None:
        """Drop and stop all that is done for a page."""
        for lane in self.all:
            lane.cancel(owner)

    def take_cell(self, content: Mapping[str, Any], arrays: Mapping[str, Any]) -> Job:
        """Give the mesh of a unit cell to the process that makes shapes."""
        make = _maker("cell", content, arrays)
        self.cells[:] = [*self.cells, make][-MOST_REMEMBERED:]
        return self.quick.submit(make())

    def take_anchor(
        self, content: Mapping[str, Any], arrays: Mapping[str, Any], listener: Any
    ) -> Job:
        """Let previews start from an evaluation."""
        make = _maker("anchor", content, arrays, listener)
        self.anchors[:] = [*self.anchors, make][-MOST_REMEMBERED:]
        return self.preview.submit(make())

    def warm(self) -> None:
        """Once the first preview is there, let its process load what others may need."""
        if not self.warmed:
            self.warmed = True
            self.preview.submit(Job(SERVER, "warm", "warm", {}))

    def close(self) -> None:
        """End all processes."""
        for lane in self.all:
            lane.close()


def _maker(
    task: str, content: Mapping[str, Any], arrays: Mapping[str, Any], listener: Any = None
) -> Callable[[], Job]:
    """What makes the same job again; each has a topic of its own, so that none is dropped."""

    def make() -> Job:
        job = Job(SERVER, "", task, content, arrays=arrays)
        job.topic = f"{task} {job.number}"
        if listener is not None:
            job.listener = listener
        return job

    return make
