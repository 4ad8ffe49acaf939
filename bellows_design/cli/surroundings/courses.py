"""Courses that earlier runs took, kept for each command: they tell how long the next one takes.

A file of the user's cache holds the latest few of every command; without it, typical ones that
come with the package are used. Nothing depends on them but the time left that a terminal shows.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from typing import Any

from bellows_design.progress.course import Course, course_of, plain

FILE = "courses.json"

MOST_KEPT = 6
"""Of one command."""

LARGEST = 1_000_000
"""Bytes of the file; a larger one is none of ours."""


def courses_of(command: str) -> tuple[Course, ...]:
    """The latest first, then the typical ones that come with the package."""
    shipped = files("bellows_design.cli.surroundings") / FILE
    kept = [*_kept().get(command, []), *_parsed(shipped.read_text("utf-8")).get(command, [])]
    return tuple(course for course in map(course_of, kept) if course)


def learn(command: str, course: Course) -> None:
    """Keep the course that a run of the command took; where that is not possible, do not."""
    from bellows_design.files.atomic import replacing
    from bellows_design.store.place import NoPlace

    with suppress(OSError, NoPlace):
        kept, path = _kept(), _path()
        kept[command] = [plain(course), *kept.get(command, [])][:MOST_KEPT]
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as temporary:
            temporary.write_text(json.dumps(kept), "utf-8")


def _kept() -> dict[str, list[Any]]:
    """By command; nothing where the file is missing or damaged."""
    from bellows_design.store.place import NoPlace

    with suppress(OSError, NoPlace):
        path = _path()
        if path.is_file() and path.stat().st_size <= LARGEST:
            return _parsed(path.read_bytes())
    return {}


def _path() -> Path:
    from bellows_design.store.place import cache_folder

    return cache_folder() / FILE


def _parsed(text: str | bytes) -> dict[str, list[Any]]:
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    if not isinstance(content, Mapping):
        return {}
    return {str(key): list(each) for key, each in content.items() if isinstance(each, list)}
