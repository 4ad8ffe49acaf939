"""A Chromium of this machine that opens pages, and what went wrong on them.

`browser` is a fixture of tests/conftest.py; tests that take it are marked `browser` and are skipped
where there is no Chromium. `BELLOWS_CHROMIUM` names one that is not on the path.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page, Request

VARIABLE = "BELLOWS_CHROMIUM"
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
ARGUMENTS = [
    "--no-sandbox",  # in containers there is none
    "--use-angle=swiftshader",  # WebGL on the processor, alike on all machines
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]
NARROW, WIDE = 400, 1280
"""Widths that pages are read at, pixels."""

OWN = re.compile(r"^(file|data|blob|about):|^(http|ws)://(127\.0\.0\.1|localhost|\[::1\])[:/]")
"""Addresses that lead to this machine only."""

ShownTheme = Literal["light", "dark"]


def chromium() -> Path | None:
    """The program; None where there is none."""
    named = os.environ.get(VARIABLE)
    found = named if named else next(filter(None, map(shutil.which, NAMES)), None)
    return None if found is None else Path(found)


@cache
def no_browser() -> str:
    """Why no page can be opened here; empty if one can."""
    if find_spec("playwright") is None:
        return "there is no Playwright here: pip install -e '.[test]'"
    path = chromium()
    if path is None:
        return f"there is no Chromium here (see {VARIABLE})"
    return "" if path.exists() else f"{VARIABLE} names {path}, which is not there"


@contextmanager
def running_browser() -> Iterator[Browser]:
    """A Chromium without windows, until the block ends."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=str(chromium()), args=ARGUMENTS, timeout=120_000
        )
        try:
            yield browser
        finally:
            browser.close()


@dataclass
class Seen:
    """What went wrong on a page: it is empty on a good one.

    Attributes:
        errors: Of its console, and exceptions that nobody caught.
        failed: Requests without an answer, or with an error's.
        foreign: Requests that leave this machine.
    """

    errors: list[str] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)

    @property
    def all(self) -> list[str]:
        """All of it."""
        return [*self.errors, *self.failed, *self.foreign]

    def listen(self, page: Page) -> None:
        """Collect what goes wrong on `page` from now on."""
        page.on("console", lambda said: self._console(said.type, said.text))
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("requestfailed", lambda request: self.failed.append(request.url))
        page.on("response", lambda got: got.status < 400 or self.failed.append(got.url))
        page.on("request", self._request)

    def _console(self, kind: str, text: str) -> None:
        # "GPU stall due to ReadPixels" is what the software renderer says of itself.
        if kind in ("error", "warning") and "GPU stall" not in text:
            self.errors.append(f"{kind}: {text}")

    def _request(self, request: Request) -> None:
        if not OWN.match(request.url):
            self.foreign.append(request.url)


@contextmanager
def opened(
    browser: Browser,
    address: str | Path,
    *,
    width: int = WIDE,
    height: int = 900,
    theme: ShownTheme = "light",
    calm: bool = False,
    **context: Any,
) -> Iterator[tuple[Page, Seen]]:
    """A page of its own context, and what goes wrong on it.

    Args:
        browser: That opens it.
        address: A file or a URL.
        width, height: Of the window, pixels.
        theme: What the reader's system prefers.
        calm: Whether the reader wants less motion.
        context: Further options of Playwright's `new_context`.
    """
    made = browser.new_context(
        viewport={"width": width, "height": height},
        color_scheme=theme,
        reduced_motion="reduce" if calm else "no-preference",
        **context,
    )
    page = made.new_page()
    seen = Seen()
    seen.listen(page)
    try:
        page.goto(address.absolute().as_uri() if isinstance(address, Path) else address)
        yield page, seen
    finally:
        made.close()


def wider_than_the_window(page: Page) -> int:
    """Pixels by which the page must be scrolled sideways; 0 where all of it fits."""
    return int(
        page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    )


LOW_CONTRAST = Path(__file__).with_name("low_contrast.js")


def hard_to_read(page: Page, least: float = 4.5) -> list[str]:
    """Visible texts whose contrast with what is behind them is less (WCAG 2 asks 4.5)."""
    found: list[str] = page.evaluate(LOW_CONTRAST.read_text("utf-8"), least)
    return found
