"""Interrupted and resumed: the same bits."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from solver import Checkpoint, Event, Mesh, Ogden, Problem, Solution, SolverOptions, Supports, solve

Meshes = Callable[..., Mesh]
PRESSURE = 0.02
STOPS = (0.003, 0.011)


class Interruption(Exception):
    """Stands for a power cut."""


@pytest.fixture(scope="module")
def problem(bellows: Meshes, ninjaflex: Ogden) -> Problem:
    supports = Supports(clamped=("root",), symmetry={"symmetry": 1})
    return Problem(bellows(2), ninjaflex, supports, ("cavity",))


@pytest.fixture(scope="module")
def uninterrupted(problem: Problem) -> Solution:
    return solve(problem, PRESSURE, stops=STOPS)


def interrupted(problem: Problem, steps: int, options: SolverOptions | None = None) -> Checkpoint:
    """The last checkpoint of a run that breaks off after so many load steps."""
    seen: list[Checkpoint] = []

    def listener(event: Event) -> None:
        if event.checkpoint is not None:
            seen.append(event.checkpoint)
            if len(seen) == steps:
                raise Interruption

    with pytest.raises(Interruption):
        solve(problem, PRESSURE, options, listener, stops=STOPS)
    return seen[-1]


def assert_same_bits(one: Solution, other: Solution) -> None:
    assert np.array_equal(one.displacement, other.displacement)
    assert np.array_equal(one.hydrostatic_pressure, other.hydrostatic_pressure)
    assert one.path == other.path
    assert one.load_steps == other.load_steps
    assert one.newton_iterations == other.newton_iterations


def test_a_checkpoint_goes_to_a_path_or_to_its_name(problem: Problem, tmp_path: Path) -> None:
    checkpoint, name = interrupted(problem, 1), str(tmp_path / "walk.npz")
    checkpoint.save(name)
    assert Checkpoint.load_from(name).points == checkpoint.points


@pytest.mark.parametrize("steps", [1, 2, 3])
def test_a_resumed_run_ends_in_the_same_bits(
    problem: Problem, uninterrupted: Solution, steps: int, tmp_path: Path
) -> None:
    interrupted(problem, steps).save(tmp_path / "walk.npz")
    resumed = Checkpoint.load_from(tmp_path / "walk.npz")
    assert 0 < resumed.load < 1
    assert_same_bits(solve(problem, PRESSURE, stops=STOPS, resume=resumed), uninterrupted)


def test_two_runs_end_in_the_same_bits(problem: Problem, uninterrupted: Solution) -> None:
    assert_same_bits(solve(problem, PRESSURE, stops=STOPS), uninterrupted)


def test_a_run_that_was_refused_steps_is_resumed_to_the_same_bits(problem: Problem) -> None:
    options = SolverOptions(first_step=1.0, cut=0.02, smallest_step=1e-6, maximum_iterations=2)
    whole = solve(problem, PRESSURE, options, stops=STOPS)
    assert whole.refused_steps > 0 and whole.load_steps > 3
    checkpoint = interrupted(problem, 3, options)
    assert_same_bits(solve(problem, PRESSURE, options, stops=STOPS, resume=checkpoint), whole)


def test_a_checkpoint_of_another_mesh_is_refused(
    problem: Problem, bellows: Meshes, ninjaflex: Ogden
) -> None:
    other = Problem(bellows(1), ninjaflex, problem.supports, ("cavity",))
    with pytest.raises(ValueError, match="must have the shape"):
        solve(other, PRESSURE, resume=interrupted(problem, 1))


@pytest.mark.parametrize("content", [b"", b"not a checkpoint", b"PK\x03\x04broken"])
def test_what_is_no_checkpoint_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "walk.npz").write_bytes(content)
    with pytest.raises(ValueError, match=r"walk\.npz does not hold one"):
        Checkpoint.load_from(tmp_path / "walk.npz")


def test_a_checkpoint_is_written_completely_or_not_at_all(
    problem: Problem, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checkpoint = interrupted(problem, 1)
    checkpoint.save(tmp_path / "walk.npz")
    before = (tmp_path / "walk.npz").read_bytes()

    def breaks(file: object, **arrays: object) -> None:
        raise OSError("no space left")

    monkeypatch.setattr(np, "savez", breaks)
    with pytest.raises(OSError, match="no space"):
        checkpoint.save(tmp_path / "walk.npz")
    assert (tmp_path / "walk.npz").read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["walk.npz"]
