"""Who evaluates the designs of a study: from the options of a command to an executor."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from bellows_design.errors import DesignError

if TYPE_CHECKING:
    from bellows_design.batch.executor import Executor
    from bellows_design.batch.places import Place
    from bellows_design.batch.workers import Answerer


def who_works(workers: int | None, scheduler: str | None) -> Callable[[], Executor]:
    """Makes who evaluates: this process (0), others of this machine, or those of a scheduler.

    Raises ``DesignError`` for options that name nobody, and for want of dask.distributed;
    ``ClusterError`` where no scheduler listens.
    """
    from bellows_design.batch.executor import Here
    from bellows_design.batch.places import Elsewhere, ThisMachine, require_dask
    from bellows_design.batch.session import Session

    if scheduler is not None:
        if workers is not None:
            raise DesignError("--workers are those of this machine; a --scheduler has its own.")
        require_dask()
        elsewhere = Elsewhere(scheduler)
        elsewhere.require_listening()
        return partial(_cluster, Session, elsewhere)
    if workers == 0:
        return lambda: Here(Session())
    require_dask()
    machine = ThisMachine.of(workers)
    return partial(_cluster, partial(Session, budget=machine.budget), machine)


def _cluster(make: Callable[[], Answerer], place: Place) -> Executor:
    from bellows_design.batch.cluster import Cluster

    return Cluster(make, place)
