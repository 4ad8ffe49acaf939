"""What waits to be sent to a page: of some kinds only the latest is of any use."""

from __future__ import annotations

import asyncio
from collections import deque

LATEST_ONLY = ("shape", "working", "deformed")


class Outbox:
    """Messages in their order; an older one that is overtaken is dropped before it is sent."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[str, str | bytes]] = deque()
        self._more = asyncio.Event()

    def put(self, kind: str, message: str | bytes) -> None:
        """Add a message."""
        if kind in LATEST_ONLY:
            self._waiting = deque(each for each in self._waiting if each[0] != kind)
        self._waiting.append((kind, message))
        self._more.set()

    async def get(self) -> str | bytes:
        """The next message, once there is one."""
        while not self._waiting:
            self._more.clear()
            await self._more.wait()
        return self._waiting.popleft()[1]
