"""The time left: by the course of an earlier run, by what is counted, or not at all."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bellows_design.progress.course import (
    Course,
    Stage,
    count_in,
    course_of,
    key_of,
    nearest,
    plain,
)
from bellows_design.progress.estimate import Estimate

COURSE: Course = (
    Stage("geometry", 2.0),
    Stage("mesh 1", 1.0),
    Stage("solve 1", 4.0, 1000),
    Stage("mesh 2", 1.0),
    Stage("solve 2", 12.0, 4000),
)


class Clock:
    """Seconds as a test wants them."""

    now = 100.0

    def __call__(self) -> float:
        return self.now


def walked(course: Course, estimate: Estimate, clock: Clock, pace: float) -> list[float]:
    """Relative errors of the time left, in thirds of each stage, for a run of that pace."""
    total = pace * sum(each.seconds for each in course)
    start, errors = clock.now, []
    for stage in course:
        size = f", {stage.size} tetrahedra" if stage.size else ""
        estimate.stage(f"{stage.key}{size}")
        for _ in range(3):
            clock.now += pace * stage.seconds / 3
            left, truth = estimate.left(), total - (clock.now - start)
            assert left is not None
            errors.append(abs(left - truth) / total)
    return errors


@given(st.floats(0.5, 3.0))
def test_a_run_that_takes_the_course_faster_or_slower_is_told_right_once_its_pace_is_known(
    pace: float,
) -> None:
    clock = Clock()
    errors = walked(COURSE, Estimate([COURSE], clock), clock, pace)
    assert max(errors[12:]) < 0.15 * max(1, pace)


def test_the_same_run_again_is_told_exactly() -> None:
    clock = Clock()
    assert max(walked(COURSE, Estimate([COURSE], clock), clock, 1.0)) < 0.1


def test_the_fraction_that_is_done_never_falls_and_reaches_the_end() -> None:
    clock = Clock()
    estimate, seen = Estimate([COURSE], clock), []
    for stage in COURSE:
        estimate.stage(stage.key)
        for _ in range(8):
            clock.now += stage.seconds / 4  # twice as slow
            seen.append(estimate.done() or 0.0)
    assert seen == sorted(seen) and 0.8 < seen[-1] <= 1


def test_more_elements_take_longer() -> None:
    stage = Stage("solve 1", 4.0, 1000)
    assert stage.expected(2000) > 8 and stage.expected(1000) == 4 == stage.expected(0)


def test_the_load_tells_within_a_stage() -> None:
    clock = Clock()
    estimate = Estimate([(Stage("solve 1", 10.0),)], clock)
    estimate.stage("solve 1")
    clock.now += 10
    estimate.load(0.9)
    estimate.load(0.3)  # a step that is tried again
    assert estimate.left() == pytest.approx(10 * (0.1 * 0.15 + 0.9 * 0.1 / 0.9), rel=0.2)


def test_nothing_is_said_where_nothing_is_known() -> None:
    estimate = Estimate()
    estimate.stage("something")
    assert estimate.left() is None and estimate.done() is None


@pytest.mark.parametrize(
    ("text", "done", "whole"),
    [
        ("40 of 200 designs (3 failed), 5 a minute", 40, 200),
        ("sample 3 of 20", 2, 20),
        ("design 13 of 13: bubble width 16", 12, 13),
        ("12 designs evaluated, 3.5 of 15 min; best", 3.5, 15),
    ],
)
def test_what_is_counted_is_understood(text: str, done: float, whole: float) -> None:
    found = count_in(text)
    assert found is not None or text.startswith("12 designs")
    if found is not None:
        assert (found.done, found.all) == (done, whole)


@pytest.mark.parametrize("text", ["mesh 2", "solve 1, 1205 tetrahedra", "3 of 0", ""])
def test_what_is_not_counted_is_no_count(text: str) -> None:
    assert count_in(text) is None


def test_a_count_tells_the_time_by_what_was_done() -> None:
    clock = Clock()
    estimate = Estimate((), clock)
    estimate.stage("200 designs")
    clock.now += 60
    estimate.stage("50 of 200 designs")
    assert estimate.left() == pytest.approx(180) and estimate.done() == pytest.approx(0.25)
    clock.now += 30
    assert estimate.left() == pytest.approx(178.8)
    assert estimate.counts


@pytest.mark.parametrize(
    ("name", "key", "size"),
    [
        ("solve 2, 4337 tetrahedra", "solve 2", 4337),
        ("mesh 2", "mesh 2", 0),
        ("section's law at 0.02 MPa", "section's law at # MPa", 0),
    ],
)
def test_a_stage_is_known_by_what_it_does(name: str, key: str, size: int) -> None:
    assert key_of(name) == (key, size)


def test_the_course_that_begins_alike_is_taken() -> None:
    other = (Stage("geometry of the half", 5.0), Stage("solve 1", 50.0))
    assert nearest([COURSE, other], ["geometry of the half"]) == other
    assert nearest([COURSE, other], ["geometry"]) == COURSE
    assert nearest([], ["geometry"]) == ()


def test_a_course_is_kept_as_plain_values_and_anything_else_is_none() -> None:
    assert course_of(plain(COURSE)) == COURSE
    for damaged in (None, 3, "x", [["a"]], [["a", "b", "c"]], [["a", -1.0, 0]], [[1, 1e9, 0]]):
        assert course_of(damaged) == ()
