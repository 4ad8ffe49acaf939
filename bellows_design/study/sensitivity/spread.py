"""How results are spread over a box around a design, and which parameters that is due to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.neighbours.sensitivities import RESPONSES
from bellows_design.progress import SILENCE, Progress
from bellows_design.study.sensitivity.answers import Answers
from bellows_design.study.sensitivity.box import Box, Sample, sampled
from bellows_design.study.sensitivity.indices import Index, sobol_indices
from bellows_design.study.sensitivity.local import slopes, slopes_of, strongest, values
from bellows_design.study.sensitivity.surrogate import Data, Surrogate, fitted

if TYPE_CHECKING:
    from bellows_design.neighbours.sensitivities import Sensitivities


@dataclass(frozen=True)
class Spread:
    """One response over the box, by its surrogate.

    Attributes:
        surrogate: The polynomial, and its error at samples held out.
        indices: Of the parameters, the largest total first.
    """

    surrogate: Surrogate
    indices: tuple[Index, ...]


@dataclass(frozen=True)
class Global:
    """All responses over a box.

    Attributes:
        sample: The designs evaluated.
        answers: Theirs, in the same order.
        asked_percent: Of the box asked for; the sample's box may be narrower.
        spreads: By response.
    """

    sample: Sample
    answers: tuple[Answer, ...]
    asked_percent: float
    spreads: Mapping[str, Spread]

    @property
    def failed(self) -> int:
        """Samples without a result, which are left out."""
        return sum(not answer.done for answer in self.answers)

    @property
    def ordinary(self) -> int:
        """Samples that no neighbour led to, each on a mesh of its own."""
        return sum(answer.origin == "ordinary" for answer in self.answers)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        sample = self.sample
        return {
            "asked_percent": self.asked_percent,
            "percent": sample.box.percent,
            "parameters": list(sample.box.names),
            "samples": len(self.answers),
            "failed": self.failed,
            "ordinary": self.ordinary,
            "drawn_in": sample.drawn_in,
            "redrawn": sample.redrawn,
            "responses": {name: _spread_dict(each) for name, each in self.spreads.items()},
        }


def spread_over(
    box: Box,
    found: Sensitivities,
    count: int,
    seed: int,
    answers: Answers,
    progress: Progress = SILENCE,
) -> Global:
    """Evaluate ``count`` designs of a box with derivatives, and analyse their surrogates.

    Raises ``DesignError`` if there are too few designs in the box, or too few that have a result.
    """
    sample = sampled(box, count, seed)
    gathered = tuple(_gathered(sample, answers, progress))
    progress.stage("Sobol indices")
    spreads = {}
    for response in RESPONSES:
        surrogate = fitted(data(response, sample, gathered, found))
        indices = sobol_indices(surrogate, sample.box.names, seed)
        spreads[response] = Spread(surrogate, indices)
    return Global(sample, gathered, box.percent, spreads)


def box_around(found: Sensitivities, percent: float, model: str) -> Box:
    """The box of the parameters that have a part in a global study."""
    return Box(found.design, strongest(found), percent, model)


def data(response: str, sample: Sample, answers: tuple[Answer, ...], found: Sensitivities) -> Data:
    """What is known of a response: in the middle of the box, and by the answers to a sample."""
    done = [i for i, answer in enumerate(answers) if answer.done]
    rows = [slopes(found)[response], *(slopes_of(answers[i], found)[response] for i in done)]
    by_name = np.array([[row[name] for name in sample.box.names] for row in rows])
    others = [getattr(answers[i], response) for i in done]
    return Data(
        points=np.concatenate([np.zeros((1, len(sample.box.names))), sample.points[done]]),
        values=np.array([values(found)[response], *others]),
        slopes=by_name * sample.box.half_sides,
    )


def _gathered(sample: Sample, answers: Answers, progress: Progress) -> Iterator[Answer]:
    """The answers, each told about as it comes."""
    start, count = sample.box.design, len(sample.designs)
    questions = (Question(design, start, derivatives=True) for design in sample.designs)
    progress.stage(f"sample 1 of {count}")
    for number, answer in enumerate(answers(questions), 1):
        if number < count:
            progress.stage(f"sample {number + 1} of {count}")
        yield answer


def _spread_dict(spread: Spread) -> dict[str, Any]:
    return {
        "terms": len(spread.surrogate.coefficients),
        "held_out": asdict(spread.surrogate.error),
        "indices": [asdict(index) for index in spread.indices],
    }
