"""What holds for all tests."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import pytest
from browser import no_browser, running_browser

from printers import PrintersError
from printers.slicing.finding import VARIABLE, find_slicer

if TYPE_CHECKING:
    from playwright.sync_api import Browser


@pytest.fixture(scope="session")
def _caches() -> Iterator[Path]:
    with TemporaryDirectory(prefix="bellows-caches-") as folder:
        yield Path(folder)


@pytest.fixture(autouse=True)
def own_cache(
    _caches: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> Path:
    """A store of results for each test: none finds another's, and none the user's."""
    folder = _caches / str(abs(hash(request.node.nodeid)))
    monkeypatch.setenv("BELLOWS_CACHE", str(folder))
    return folder


@pytest.fixture(autouse=True)
def _no_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Output is as wide and as colourful as where a pipe reads it, wherever the tests run.

    The worker processes of pytest-xdist inherit COLUMNS and LINES, which the readline library sets.
    """
    for name in ("COLUMNS", "LINES", "NO_COLOR", "FORCE_COLOR", "CLICOLOR", "CLICOLOR_FORCE"):
        monkeypatch.delenv(name, raising=False)


@cache
def _no_slicer() -> str:
    """Why no slicer can be run here; empty if one can."""
    try:
        return "" if find_slicer() else "there is no slicer here: install PrusaSlicer"
    except PrintersError as error:  # too old, or no PrusaSlicer
        return str(error)


@pytest.fixture(autouse=True)
def no_slicer(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """No test runs a slicer but those marked so, which are skipped where there is none."""
    if request.node.get_closest_marker("slicer") is None:
        monkeypatch.setenv(VARIABLE, "")
    elif why := _no_slicer():
        pytest.skip(why)


@pytest.fixture(autouse=True)
def _skipped_without_browser(request: pytest.FixtureRequest) -> None:
    """Tests that open pages are skipped where nothing can."""
    if request.node.get_closest_marker("browser") is not None and (why := no_browser()):
        pytest.skip(why)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A Chromium for tests that are marked `browser`; see tests/support/browser.py.

    Playwright's event loop runs as long as it is there, so that no other can be started: it ends
    with the module.
    """
    if why := no_browser():
        pytest.skip(why)
    with running_browser() as found:
        yield found
