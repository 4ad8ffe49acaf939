"""Solves that share the machine find the same bits."""

from __future__ import annotations

import threading

import numpy as np
import pytest
from meshes import sphere_mesh

from solver import Ogden, Problem, Solution, Supports, solve
from solver.linear.threads import may_run_side_by_side, numba, one_thread

PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})


def inflated() -> Solution:
    """An octant of a thick sphere under pressure."""
    problem = Problem(
        sphere_mesh(10.0, 12.0, 2, 6), Ogden(mu=(0.4,), alpha=(2.0,)), PLANES, ("inside",)
    )
    return solve(problem, 0.02)


def test_one_thread_and_all_of_them_give_the_same_bits() -> None:
    usual = inflated()
    with one_thread():
        assert numba.get_num_threads() == 1
        alone = inflated()
    assert numba.get_num_threads() >= 1
    assert (usual.displacement == alone.displacement).all()


def test_solves_in_two_threads_do_not_disturb_each_other() -> None:
    if not may_run_side_by_side():
        pytest.skip("one processor, or numba's threads cannot be shared")
    expected, found = inflated(), []

    def work() -> None:
        with one_thread():
            found.extend(inflated() for _ in range(3))

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 6
    assert all(np.array_equal(each.displacement, expected.displacement) for each in found)
