"""Courses of earlier runs: kept for each command, and of no harm where they are damaged."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from fakes import FakeEvaluation

from bellows_design.cli.surroundings.courses import FILE, MOST_KEPT, courses_of, learn
from bellows_design.progress.course import Stage

Bellows = Callable[..., tuple[int, str, str]]
COURSE = (Stage("mesh 1", 1.5), Stage("solve 1", 4.0, 1000))


def test_typical_courses_of_an_evaluation_come_with_the_package() -> None:
    assert all(sum(each.seconds for each in course) > 5 for course in courses_of("evaluate"))
    assert courses_of("evaluate") and courses_of("no command") == ()


def test_the_latest_courses_are_kept_first(own_cache: Path) -> None:
    for seconds in range(MOST_KEPT + 2):
        learn("force", (Stage("chain", float(seconds)),))
    learn("run", COURSE)
    kept = courses_of("force")
    assert [course[0].seconds for course in kept][:2] == [MOST_KEPT + 1.0, float(MOST_KEPT)]
    assert len(kept) == MOST_KEPT and courses_of("run")[0] == COURSE


@pytest.mark.parametrize("content", [b"", b"\xff", b"[]", b'{"force": 3}', b'{"force": [[1]]}'])
def test_a_damaged_file_is_none(own_cache: Path, content: bytes) -> None:
    own_cache.mkdir(parents=True, exist_ok=True)
    (own_cache / FILE).write_bytes(content)
    assert courses_of("force") == ()
    learn("force", COURSE)
    assert courses_of("force") == (COURSE,)


def test_where_nothing_can_be_kept_nothing_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BELLOWS_CACHE", "/proc/nowhere")
    learn("force", COURSE)
    assert courses_of("force") == ()


@pytest.mark.parametrize("option", ["--quiet", "-q"])
def test_a_quiet_command_says_nothing_on_the_way(
    option: str, bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation())
    status, out, err = bellows("run", "prototype_1", "--output", str(tmp_path), option)
    assert status == 0 and "APPROVED" in out and err == ""
    _, _, err = bellows("run", "prototype_1", "--output", str(tmp_path))
    assert "geometry" in err
