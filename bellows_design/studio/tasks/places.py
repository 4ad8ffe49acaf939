"""Where the studio's processes keep evaluations, and look for them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.budget import DEFAULT
from bellows_design.design.design import Design

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.store import Store
    from bellows_design.studio.workers.reporting import Report


@contextmanager
def solving(report: Report) -> Iterator[None]:
    """Within the block the page is told if the solver is compiled, which takes a while."""
    from solver.numerics.first_run import told_of_compilation

    def tell(kept: bool) -> None:
        report.note(f"compiling the solver, which may take half a minute{', this once' * kept}")

    with told_of_compilation(tell):
        yield


def store_at(values: dict[str, Any]) -> Store:
    """The store that the server named with a job."""
    from bellows_design.store import Store

    return Store(Path(values["store"]))


def kept_evaluation(store: Store, design: Design) -> Evaluation | None:
    """The ordinary evaluation of a design, if it is kept: the same that ``evaluate`` gives."""
    from bellows_design.store.key import key_of

    return store.find(key_of(design, "auto", None, (), DEFAULT, 0), design)
