"""All that ``bellows study sensitivity`` finds about one design."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field, replace
from typing import TYPE_CHECKING, Any

from bellows_design.errors import DesignError
from bellows_design.neighbours.jumps import count_changes
from bellows_design.neighbours.sensitivities import RESPONSES, Sensitivities, sensitivities
from bellows_design.progress import SILENCE, Progress
from bellows_design.study.sensitivity.answers import Answers, in_this_process
from bellows_design.study.sensitivity.box import NARROWEST
from bellows_design.study.sensitivity.causes import Tolerances
from bellows_design.study.sensitivity.indices import require_salib
from bellows_design.study.sensitivity.spread import Global, box_around, spread_over
from bellows_design.study.sensitivity.tolerance import Tolerated, tolerated

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.design.design import Design

SAMPLES = 20
"""By default: see docs/studies.md for the error that leaves."""

FEWEST_SAMPLES, MOST_SAMPLES = 10, 10_000
WIDEST = 20.0
"""%. Farther away a neighbour's ends and errors do not hold."""


@dataclass(frozen=True)
class Plan:
    """What is studied: see docs/commands.md.

    Attributes:
        percent: Half width of the box of a global study.
        samples: Designs of it that are evaluated.
        seed: The same seed gives the same samples.
        tolerances: What may come out otherwise.
        sobol: Whether there is a global study.

    Raises ``DesignError`` if a number is out of bounds.
    """

    percent: float = 10.0
    samples: int = SAMPLES
    seed: int = 0
    tolerances: Tolerances = field(default_factory=Tolerances)
    sobol: bool = True

    def __post_init__(self) -> None:
        if not NARROWEST <= self.percent <= WIDEST:
            raise DesignError(
                f"range is {self.percent:g} % but must lie from {NARROWEST:g} to {WIDEST:g} %."
            )
        if not FEWEST_SAMPLES <= self.samples <= MOST_SAMPLES:
            raise DesignError(
                f"samples is {self.samples} but must lie from {FEWEST_SAMPLES} to {MOST_SAMPLES}."
            )
        if self.seed < 0:
            raise DesignError(f"seed is {self.seed} but must be at least 0.")


@dataclass(frozen=True)
class Study:
    """Local, global and within tolerances.

    Attributes:
        evaluation: Of the design with its number of bubbles given.
        sensitivities: At the design.
        spread: Over a box around it; None if not asked for.
        tolerated: Its results with their margins.
        seconds: Time spent, s, without the evaluation.
    """

    evaluation: Evaluation
    sensitivities: Sensitivities
    spread: Global | None
    tolerated: Tolerated
    seconds: float

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        found = self.evaluation
        return {
            "design": found.design.name,
            "digest": found.design.digest,
            "bubbles": found.design.bellows.bubble_count,
            "pressure_mpa": found.pressure_mpa,
            **{name: getattr(found, name) for name in RESPONSES},
            "error_estimate": asdict(found.error_estimate),
            "sensitivities": self.sensitivities.to_dict(),
            "global": None if self.spread is None else self.spread.to_dict(),
            "tolerance": self.tolerated.to_dict(),
            "seconds": found.seconds.total + self.seconds,
        }


def studied(
    original: Design,
    evaluation: Evaluation,
    plan: Plan,
    progress: Progress = SILENCE,
    answering: Callable[[Evaluation], Answers] = in_this_process,
) -> Study:
    """Study a design.

    Args:
        original: The design, whose number of bubbles may change with its lengths.
        evaluation: Its evaluation, with that number given (``variation.counted``).
        plan: What is studied.
        progress: Listens to stages.
        answering: Who answers questions about designs around it.

    Raises:
        BellowsError: There are no sensitivities at the state, too few designs around it or no
            printer of that name; without SALib if a global study is asked for.
        SolverError: The state is at a limit point.
    """
    began = time.perf_counter()
    if plan.sobol:
        require_salib()
    progress.stage("sensitivities")
    found = sensitivities(evaluation)
    answers = answering(evaluation)
    progress.stage("tolerances")
    margins = tolerated(evaluation, found, plan.tolerances, answers)
    spread = None
    if plan.sobol:
        box = box_around(found, plan.percent, evaluation.model.name)
        spread = spread_over(box, found, plan.samples, plan.seed, answers, progress)
    return Study(
        evaluation,
        replace(found, count_changes=count_changes(original)),
        spread,
        margins,
        time.perf_counter() - began,
    )
