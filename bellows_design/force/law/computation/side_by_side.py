"""Independent computations by two threads."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bellows_design.beside import beside
from bellows_design.progress import SILENCE, Progress


def side_by_side(tasks: Sequence[Callable[[], None]]) -> None:
    """Call all tasks, two at a time where the machine has the processors.

    No task may change what another one uses. Where one raises an exception that is raised, and
    tasks that were not begun are left.
    """
    from solver.linear.threads import may_run_side_by_side, one_thread

    if len(tasks) < 2 or not may_run_side_by_side():
        for task in tasks:
            task()
        return
    waiting = iter(tasks)  # a list's iterator gives each task to one thread only

    def work(progress: Progress) -> None:
        with one_thread():
            for task in waiting:
                progress.stage("")  # ends a thread that is not needed any more
                task()

    with beside(work, at_once=True) as other:
        work(SILENCE)
        other.result(SILENCE)
