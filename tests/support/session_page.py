"""A page as a session of the studio sees it, on processes that compute nothing."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

from bellows_design.studio.protocol import request_of
from bellows_design.studio.sessions.lanes import Lanes
from bellows_design.studio.sessions.session import Session
from bellows_design.studio.workers.lane import Lane

STUB = "stub_tasks"


class Page:
    """What would be a browser."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.heard: list[dict[str, Any]] = []

    def tell(self, kind: str, revision: int, **content: Any) -> None:
        self.session.receive(
            request_of(json.dumps({"type": kind, "revision": revision, **content}))
        )

    async def until(self, kind: str, **content: Any) -> dict[str, Any]:
        """The next message of a kind with that content."""
        while True:
            message = await asyncio.wait_for(self.session.outbox.get(), 30)
            found = read(message)
            self.heard.append(found)
            if found["type"] == kind and content.items() <= found.items():
                return found

    async def quiet(self, seconds: float = 0.5) -> None:
        """Take what still comes."""
        while True:
            try:
                message = await asyncio.wait_for(self.session.outbox.get(), seconds)
            except TimeoutError:
                return
            self.heard.append(read(message))

    def of(self, kind: str, revision: int) -> list[dict[str, Any]]:
        return [each for each in self.heard if (each["type"], each["revision"]) == (kind, revision)]


def read(message: str | bytes) -> dict[str, Any]:
    if isinstance(message, str):
        return dict(json.loads(message))
    size = int.from_bytes(message[:4], "little")
    return {**json.loads(message[4 : 4 + size]), "payload": message[4 + size :]}


def in_loop(folder: Path, check: Callable[[Page], Awaitable[None]], seconds: float = 60.0) -> None:
    """Run a check of a page whose first design has been answered."""

    async def whole() -> None:
        lanes = Lanes(folder / "store", folder / "exports", Lane(STUB), Lane(STUB), Lane(STUB))
        lanes.start()
        page = Page(Session(lanes))
        page.session.open(None, "", 0)
        try:
            await page.until("sensitivities", revision=0)
            await asyncio.wait_for(check(page), seconds)
        finally:
            page.session.close()
            lanes.close()

    asyncio.run(whole())
