"""Which designs a sweep asks for, and what it knows without asking."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.study.sweep.plan import Questions, Space, planned
from bellows_design.study.sweep.sampling import Sampling, points
from bellows_design.study.sweep.space import axes

FINGER = load_design("finger")


def space(*vary: str, **options) -> Space:
    return Space(FINGER, axes(vary, FINGER), **options)


def test_a_grid_has_all_values_of_one_with_all_of_the_other():
    found = points(
        axes(["bubble_width=16:20:3", "tendon_width=5:6:2"], FINGER), Sampling.GRID, None, 0
    )
    assert {tuple(point) for point in found} == {(w, t) for w in (16, 18, 20) for t in (5, 6)}


def test_a_latin_hypercube_has_one_point_in_each_part_of_each_axis():
    ranges = axes(["bubble_width=16:20", "tendon_width=5:6"], FINGER)
    found = points(ranges, Sampling.LATIN_HYPERCUBE, 40, 7)
    for values, axis in zip(found.T, ranges, strict=True):
        parts = (40 * (values - axis.low) / (axis.high - axis.low)).astype(int)
        assert sorted(parts) == list(range(40))


@pytest.mark.parametrize("sampling", [Sampling.LATIN_HYPERCUBE, Sampling.RANDOM])
def test_a_sample_follows_from_its_seed(sampling):
    ranges = axes(["bubble_width=16:20"], FINGER)
    first, again, other = (points(ranges, sampling, 20, seed) for seed in (1, 1, 2))
    assert np.array_equal(first, again) and not np.array_equal(first, other)
    assert first.min() >= 16 and first.max() <= 20


@pytest.mark.parametrize(
    ("vary", "sampling", "number", "sentence"),
    [
        (["bubble_width=16:20"], Sampling.GRID, None, "no number of values"),
        (["bubble_width=16:20:3"], Sampling.GRID, 5, "--number belongs to"),
        (["bubble_width=16:20"], Sampling.RANDOM, None, "needs the --number"),
        (["bubble_width=16:20"], Sampling.RANDOM, 0, "has 0 designs"),
        (["bubble_width=16:20"], Sampling.LATIN_HYPERCUBE, -1, "has -1 designs"),
        (["bubble_width=16:20"], Sampling.RANDOM, 10**7, "1 to 1000000"),
        (["bubble_width=16:20:9999", "tendon_width=5:6:9999"], Sampling.GRID, None, "1 to 1000000"),
        (["bubble_width=16:20:5"], Sampling.RANDOM, 5, "belongs to --sample grid"),
    ],
)
def test_numbers_that_make_no_sample_are_refused_in_a_sentence(vary, sampling, number, sentence):
    with pytest.raises(DesignError, match=sentence):
        points(axes(vary, FINGER), sampling, number, 0)


def test_what_can_be_no_design_is_known_without_asking():
    plan = planned(space("tendon_width=4:60:15"))
    assert plan.order.size + len(plan.impossible) == 15
    assert 0 < plan.order.size < 15
    assert all("tendon_width" in why for why in plan.impossible.values())
    rows = plan.impossible_rows()
    assert len({row.answer.key for row in rows}) == len(rows)
    assert {row.answer.status for row in rows} == {"failed"}


def test_points_that_are_the_same_design_are_asked_about_once(monkeypatch):
    twice = np.array([[19.0], [19.5], [19.0]])
    monkeypatch.setattr("bellows_design.study.sweep.plan.points", lambda *_: twice)
    assert len(planned(space("bubble_width=19:20:3")).keys) == 2


def test_the_keys_are_those_of_the_questions_in_their_order():
    plan = planned(space("bubble_width=19:20:4", "tendon_width=5:6:3", start="ordinary"))
    questions = Questions(plan, range(len(plan.keys)))
    assert tuple(question.key for question in questions) == plan.keys
    assert {question.start for question in questions} == {"ordinary"}
    assert [q.key for q in questions[2:4]] == list(plan.keys[2:4])


def test_designs_of_one_topology_follow_each_other():
    plan = planned(space("chamber_length=1.6:3:8", "bubble_width=19:20:3"))
    counts = [q.design.bellows.bubble_count for q in Questions(plan, range(len(plan.keys)))]
    assert len(set(counts)) > 1
    changes = np.count_nonzero(np.diff(counts))
    assert changes == len(set(counts)) - 1


@pytest.mark.parametrize(
    "other",
    [
        space("bubble_width=19:20", sampling=Sampling.RANDOM, number=5, seed=2),
        space("bubble_width=19:20", sampling=Sampling.RANDOM, number=6, seed=1),
        space("bubble_width=19:19.5", sampling=Sampling.RANDOM, number=5, seed=1),
        space("bubble_width=19:20", sampling=Sampling.LATIN_HYPERCUBE, number=5, seed=1),
        space("bubble_width=19:20", sampling=Sampling.RANDOM, number=5, seed=1, start="ordinary"),
    ],
)
def test_a_sweep_is_told_from_others_by_its_options(other):
    this = space("bubble_width=19:20", sampling=Sampling.RANDOM, number=5, seed=1)
    assert planned(this).study.options == planned(this).study.options
    assert planned(other).study.options != planned(this).study.options
