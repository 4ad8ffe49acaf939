"""What every command that solves begins with: progress on stderr, and the store of results."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bellows_design.progress import Progress
    from bellows_design.store import Store


@contextmanager
def solving() -> Iterator[Progress]:
    """Progress on stderr that also tells why the first run takes longer."""
    from bellows_design.progress import on_stderr
    from solver.numerics.first_run import told_of_compilation

    def tell(kept: bool) -> None:
        how_often = (
            "this once" if kept else "each time, as they cannot be kept: see NUMBA_CACHE_DIR"
        )
        progress.note(f"compiling the solver, which may take half a minute, {how_often}")

    with on_stderr() as progress, told_of_compilation(tell):
        yield progress


def usual_store(progress: Progress) -> Store | None:
    """Where this user's results are kept; None, and a note, if there is no place for them."""
    from bellows_design.store import NoPlace, Store

    try:
        return Store.usual()
    except NoPlace as error:
        progress.note(f"the result is not kept: {error}")
        return None
