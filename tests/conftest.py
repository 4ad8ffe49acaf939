"""What holds for all tests."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest


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
