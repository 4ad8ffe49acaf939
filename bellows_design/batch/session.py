"""One process that answers questions, each from what it has solved before."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, TypeVar

from bellows_design.batch.answer import Answer, answer_of, failed
from bellows_design.batch.question import Question
from bellows_design.budget import DEFAULT, Budget
from bellows_design.errors import BellowsError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.design.design import Design
    from bellows_design.neighbours.neighbourhood import Neighbourhood
    from bellows_design.neighbours.pool import Pool
    from bellows_design.neighbours.record import NeighbourEvaluation
    from bellows_design.neighbours.sensitivities import Sensitivities

MOST_NEIGHBOURHOODS = 3
"""Kept in a process, about a quarter of a gigabyte each."""

Anchor = tuple[str, float | None]
"""Digest of a design, and the accuracy (percent) that its evaluation was asked for."""

Kept = TypeVar("Kept")


class Session:
    """Evaluates one design after another; a session that grows while it is used."""

    def __init__(self, model: str = "auto", budget: Budget = DEFAULT) -> None:
        """``model`` as for ``evaluate``; ``budget`` of each ordinary evaluation."""
        from bellows_design.neighbours.pool import Pool

        self._model = model
        self._budget = budget
        self._pool = Pool(model, most=MOST_NEIGHBOURHOODS)
        self._fresh: dict[Anchor, Evaluation] = {}  # that nothing was started from yet
        self._around: dict[Anchor, Neighbourhood] = {}
        self._no_starts: set[Anchor] = set()  # that no neighbour can start from

    def begin(self, found: Evaluation) -> None:
        """Take an ordinary evaluation that is at hand, for a start of others."""
        _keep(self._fresh, (found.design.digest, None), found)

    def answer(self, question: Question) -> Answer:
        """The answer to a question; a design that cannot be evaluated is an answer too."""
        from solver.errors import MeshingError, SolverError

        began = time.perf_counter()
        try:
            found = self._found(question)
            derivatives = _derivatives(found) if question.derivatives else None
        except (BellowsError, SolverError, MeshingError) as error:
            return failed(question, str(error), time.perf_counter() - began)
        except Exception as error:  # a fault of ours with one design does not end a study of many
            reason = f"internal error, {type(error).__name__}: {error}"
            return failed(question, reason, time.perf_counter() - began)
        return answer_of(question, found, derivatives, time.perf_counter() - began)

    def _found(self, question: Question) -> Evaluation | NeighbourEvaluation:
        if question.start == "ordinary":
            return self._ordinary(question.design, question)
        if question.start == "nearest":
            return self._neighbours().evaluate(question.design, budget=self._budget)
        around = self._neighbourhood(question.start, question)
        if around is None:  # no neighbour can start there
            return self._ordinary(question.design, question)
        found = around.evaluate(question.design, budget=self._budget, reach=question.reach)
        if found.fallback:  # an evaluation by itself, of the usual accuracy
            _keep(self._fresh, (question.design.digest, None), found.anchor)
        return found

    def _ordinary(self, design: Design, question: Question) -> Evaluation:
        from bellows_design.evaluation import evaluate

        asked = design.digest, question.accuracy_percent
        found = self._fresh.get(asked) or evaluate(
            design,
            self._model,
            question.accuracy_percent,
            budget=self._budget,
            keep=question.derivatives,
        )
        _keep(self._fresh, asked, found)
        return found

    def _neighbourhood(self, design: Design, question: Question) -> Neighbourhood | None:
        """That of a design's own evaluation, to the question's accuracy; None if it is no start."""
        from bellows_design.neighbours.equilibrium import unusable
        from bellows_design.neighbours.neighbourhood import Neighbourhood

        start = design.digest, question.accuracy_percent
        if start in self._no_starts:
            return None
        around = self._around.get(start)
        if around is None:
            anchor = self._fresh.get(start) or self._ordinary(design, question)
            if unusable(anchor):
                self._no_starts.add(start)
                return None
            del self._fresh[start]
            around = Neighbourhood(anchor)
        _keep(self._around, start, around)
        return around

    def _neighbours(self) -> Pool:
        """The pool with what was evaluated by itself since; it prepares each, which takes time."""
        for evaluation in self._fresh.values():
            self._pool.add(evaluation)
        self._fresh.clear()
        return self._pool


def _keep(kept: dict[Anchor, Kept], anchor: Anchor, value: Kept) -> None:
    """Put a value last, and forget the first ones beyond what is kept."""
    kept.pop(anchor, None)
    kept[anchor] = value
    while len(kept) > MOST_NEIGHBOURHOODS:
        del kept[next(iter(kept))]


def _derivatives(found: Evaluation | NeighbourEvaluation) -> Sensitivities | None:
    """Those of a result that holds."""
    from bellows_design.neighbours.equilibrium import unusable
    from bellows_design.neighbours.sensitivities import sensitivities

    return None if unusable(found) else sensitivities(found)
