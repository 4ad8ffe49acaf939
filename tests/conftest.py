"""What holds for all tests."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from printers import PrintersError
from printers.slicing.finding import VARIABLE, find_slicer


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
