"""A browser, a page on a server that pretends, and what goes wrong on it."""

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
    """The studio's page with its first refined answer; no error may come meanwhile."""
    context = browser.new_context(
        viewport={"width": 1280, "height": 860}, reduced_motion="reduce", accept_downloads=True
    )
    found = context.new_page()
    faults: list[str] = []
    found.on("pageerror", lambda error: faults.append(str(error)))
    found.on("console", lambda said: faults.append(said.text) if said.type == "error" else None)
    found.goto(studio.url)
    found.locator("#figures[data-state=refined]").wait_for()
    yield found
    context.close()
    expected = ("ERR_CONNECTION_REFUSED", "WebSocket connection")
    assert [fault for fault in faults if not any(each in fault for each in expected)] == []


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(
            executable_path="/usr/bin/chromium",
            args=["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                  "--ignore-gpu-blocklist"],
        )  # fmt: skip
        yield launched
        launched.close()
