"""Responses in closed form in place of evaluations, for studies of many designs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from bellows_design.batch.answer import Answer, failed
from bellows_design.batch.question import Question
from bellows_design.design.design import Design
from bellows_design.design.variation import parameters
from bellows_design.neighbours.sensitivities import RESPONSES, STRESS, Sensitivities, Sensitivity

SMOOTH = 1.05
"""The smooth maximum of the stress over the highest one."""


@dataclass(frozen=True)
class Responding:
    """Every response is ``middle * (1 + sum a_i r_i + sum b_ij r_i r_j)``.

    Where ``r_i`` is the relative difference of a parameter from the design's. ``failing`` are
    numbers of questions that have no answer.
    """

    design: Design
    elasticities: Mapping[str, float]
    products: Mapping[tuple[str, str], float] = field(default_factory=dict)
    middle: float = 400.0
    failing: tuple[int, ...] = ()

    def answers(self, questions: Iterable[Question]) -> Iterator[Answer]:
        """One for each question."""
        for number, question in enumerate(questions):
            if number in self.failing:
                yield failed(question, "as the test wants it.")
            else:
                yield self.answer(question)

    def answer(self, question: Question) -> Answer:
        """Value and, if asked for, derivatives: of the stress those of the smooth maximum."""
        value, slopes = self.at(question.design)
        above = {name: SMOOTH if name == STRESS else 1.0 for name in RESPONSES}
        derivatives = {
            name: {key: factor * slope for key, slope in slopes.items()}
            for name, factor in above.items()
        }
        return Answer(
            key=question.key,
            digest=question.design.digest,
            **dict.fromkeys(RESPONSES, value),
            origin="neighbour",
            derivatives=derivatives if question.derivatives else None,
        )

    def at(self, design: Design) -> tuple[float, dict[str, float]]:
        """The response and its derivatives by all parameters."""
        before, after = parameters(self.design), parameters(design)
        r = {name: after[name] / value - 1 for name, value in before.items()}
        slopes = {name: self.elasticities.get(name, 0.0) for name in r}
        total = 1 + sum(slopes[name] * r[name] for name in r)
        for (one, other), factor in self.products.items():
            total += factor * r[one] * r[other]
            slopes[one] += factor * r[other]
            slopes[other] += factor * r[one]
        return self.middle * total, {n: self.middle * s / before[n] for n, s in slopes.items()}

    def sensitivities(self) -> Sensitivities:
        """Those at the design itself."""
        answer = self.answer(Question(self.design, derivatives=True))
        assert answer.derivatives is not None
        return Sensitivities(
            design=self.design,
            responses={n: self.middle * (SMOOTH if n == STRESS else 1) for n in RESPONSES},
            parameters=tuple(
                Sensitivity(
                    name,
                    value,
                    "mm",
                    {key: answer.derivatives[key][name] for key in RESPONSES},
                    dict.fromkeys(RESPONSES, self.elasticities.get(name, 0.0)),
                )
                for name, value in parameters(self.design).items()
            ),
            led_along={},
            kinked=(),
            count_changes=(),
            smooth_peak_ratio=SMOOTH,
            ends_bound=0.0,
            adjoint_residual=0.0,
            warnings=(),
            seconds=0.0,
        )
