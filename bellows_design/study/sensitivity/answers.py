"""Who answers the questions of a study: by default one session of this process."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.batch.session import Session

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation

Answers = Callable[[Iterable[Question]], Iterator[Answer]]
"""The answers to questions, in their order."""


def in_this_process(found: Evaluation) -> Answers:
    """Those of a session that begins with an ordinary evaluation which is at hand."""
    session = Session(found.model.name)
    session.begin(found)
    return lambda questions: map(session.answer, questions)
