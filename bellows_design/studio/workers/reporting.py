"""What a task is given to report what it finds and to notice that nobody needs it any more."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from threading import Event
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

Arrays = Mapping[str, "NDArray[Any]"]

Send = Callable[[dict[str, Any], Arrays], None]


class Cancelled(Exception):
    """The job is stale. No error of any package, so that no fallback is tried."""


@dataclass(frozen=True)
class Report:
    """Sends what a job finds, and is its progress: each call raises ``Cancelled`` when stale."""

    send: Send
    stale: Event

    def __call__(self, kind: str, arrays: Arrays = {}, **content: Any) -> None:  # noqa: B006
        """Send one event of that kind."""
        self.require_wanted()
        self.send({"kind": kind, **content}, arrays)

    def shown(self, kind: str, payload: bytes, **content: Any) -> None:
        """Send one event with bytes for the page's viewer."""
        import numpy as np

        self(kind, {"payload": np.frombuffer(payload, np.uint8)}, **content)

    def require_wanted(self) -> None:
        """Raise ``Cancelled`` if nobody needs the job any more."""
        if self.stale.is_set():
            raise Cancelled

    def stage(self, name: str) -> None:
        """Say which stage begins."""
        self("working", message=name, fraction=None)

    def load(self, fraction: float, angle: float, spent: float = 0.0) -> None:
        """Say how far the load has come."""
        self("working", message="", fraction=max(0.0, min(1.0, fraction)))

    def note(self, text: str) -> None:
        """Say something that is worth knowing."""
        self("working", message=text, fraction=None)
