"""An evaluation from the store, or computed and kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation, LoadedState
    from bellows_design.store.key import Key
    from bellows_design.store.store import Store

Computed = TypeVar("Computed", bound="Evaluation | None")


def evaluated(
    design: Design,
    model: str = "auto",
    accuracy_percent: float | None = None,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    open_question: Callable[[LoadedState], str] = lambda _: "",
    store: Store | None = None,
    keep: bool = False,
) -> Evaluation:
    """What ``analysis.evaluate.evaluate`` returns for the same arguments, from ``store`` if there.

    What is computed is kept there, meshes for an open question each by itself: the next question
    goes on from them. A store that cannot be written to is noted on ``progress``. ``from_cache``
    of the result says when it was computed; None as the store computes and keeps nothing.

    Raises ``BellowsError`` and ``MeshingError`` like ``evaluate``.
    """
    from bellows_design.analysis import evaluate as analysis

    question = (design, model, accuracy_percent, pressures)
    if store is None:
        return analysis.evaluate(
            *question, progress, budget=budget, open_question=open_question, keep=keep
        )
    from bellows_design.store.key import key_of

    def kept(further: int, compute: Callable[[], Computed]) -> Evaluation | Computed:
        key = key_of(*question, budget, further)
        return store.find(key, design) or _kept(store, key, compute(), progress)

    first = kept(0, lambda: analysis.evaluate(*question, progress, budget=budget, keep=keep))
    meshes = len(first.meshes)

    def finer(found: Evaluation, why: str, progress: Progress) -> Evaluation | None:
        further = len(found.meshes) - meshes + 1
        return kept(further, lambda: analysis.finer(found, why, progress))

    result = analysis.answered(first, open_question, progress, finer)
    if result.from_cache:
        progress.note(f"computed on {result.from_cache} and kept; --no-cache computes it anew")
    return result


def _kept(store: Store, key: Key, evaluation: Computed, progress: Progress) -> Computed:
    """The evaluation, once it is kept, or could not be."""
    try:
        if evaluation is not None:
            store.keep(key, evaluation)
    except OSError as error:
        progress.note(f"the result is not kept: {error}")
    return evaluation
