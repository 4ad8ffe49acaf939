"""A page on a server that pretends; no error may come on it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from pretended_studio import PretendedStudio


@pytest.fixture
def studio() -> Iterator[PretendedStudio]:
    with PretendedStudio() as running:
        yield running


@pytest.fixture
def page(browser: Any, studio: PretendedStudio) -> Iterator[Any]:
    """The studio's page with its first refined answer."""
    from browser import opened

    with opened(browser, studio.url, height=860, calm=True) as (found, seen):
        found.locator("#figures[data-state=refined]").wait_for()
        yield found
        assert [fault for fault in seen.all if not _of_a_lost_connection(fault)] == []


def _of_a_lost_connection(fault: str) -> bool:
    return "ERR_CONNECTION_REFUSED" in fault or "WebSocket connection" in fault
