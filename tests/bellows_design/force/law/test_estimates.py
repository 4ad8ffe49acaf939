"""What is stated of a table's error where nothing was computed to see it; tasks side by side."""

from __future__ import annotations

import threading
from functools import partial
from typing import cast

import numpy as np
import pytest
from made_up_law import MadeUp

from bellows_design.force.law.computation.building import Builder, aim_of, error_at
from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.computation.side_by_side import side_by_side
from bellows_design.force.law.computation.unchecked import between_rows, within_rows
from bellows_design.force.law.computation.walking import SolvedRow
from bellows_design.force.law.interpolation.table import Table
from solver import Solution

LAW = MadeUp(stiffer=0.7)


def worst_midway(table: Table) -> float:
    """Largest error between the first two rows, rad."""
    low, high = table.pressures[:2]
    middle = float(low + high) / 2
    return max(error_at(table, LAW.point(middle, moment)) for moment in range(-40, 20, 3))


@pytest.mark.parametrize("rows", [2, 3, 5])
def test_the_estimate_between_rows_exceeds_the_error_there(rows: int) -> None:
    table = LAW.table(rows, 33)
    assert between_rows(table, *table.pressures[:2]) > worst_midway(table)


def test_the_estimate_between_rows_vanishes_for_a_rotation_quadratic_in_the_pressure() -> None:
    table = MadeUp().table(2, 33)
    rotations = [point.rotation for row in table.rows for point in row.points]
    assert between_rows(table, 0.0, 0.1) < 1e-6 * (max(rotations) - min(rotations))


@pytest.mark.parametrize("moments", [9, 17, 33])
def test_the_estimate_within_rows_is_four_fifths_of_the_error_at_least(
    moments: int,
) -> None:
    row = LAW.row(0.05, np.linspace(-60, 20, moments))
    table = Table((row, LAW.row(0.1, np.linspace(-60, 20, moments))))
    points = [LAW.point(0.05, moment) for moment in range(-59, 20, 3)]
    assert within_rows([row]) > 0.8 * max(error_at(table, point) for point in points)


def test_a_table_that_nobody_had_time_to_check_states_its_estimated_error() -> None:
    table = LAW.table(3, 17)
    cell = cast("Continuation", None)  # never asked
    builder = Builder(cell, aim_of(0.3, 0.01), deadline=0.0)
    for row in table.rows:
        solved = (Solved(point, cast("Solution", None)) for point in row.points)
        builder.rows[row.pressure] = SolvedRow(tuple(solved))
    done: list[str] = []
    builder.refine(beside=[lambda: done.append("beside")])
    assert not builder.complete
    assert done == ["beside"]
    assert builder.worst > worst_midway(table)


@pytest.fixture
def two_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("solver.linear.threads.may_run_side_by_side", lambda: True)


@pytest.mark.usefixtures("two_processors")
def test_two_tasks_run_at_the_same_time_and_each_task_once() -> None:
    both, called = threading.Barrier(2, timeout=60), list[int]()

    def task(number: int) -> None:
        if number < 2:
            both.wait()  # passes only once the other one is there
        called.append(number)

    side_by_side([partial(task, number) for number in range(7)])
    assert sorted(called) == list(range(7))


@pytest.mark.usefixtures("two_processors")
def test_an_exception_of_a_task_is_raised() -> None:
    def fails() -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        side_by_side([lambda: None, fails, lambda: None])
