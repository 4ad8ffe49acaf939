"""How far angle and stress may come out from what was computed, and through what.

Changes are those of the derivatives; the largest are compared with evaluations at both ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question
from bellows_design.design.design import Design
from bellows_design.design.variation import parameters, varied
from bellows_design.errors import DesignError
from bellows_design.neighbours.sensitivities import ANGLE, STRESS
from bellows_design.study.sensitivity.answers import Answers
from bellows_design.study.sensitivity.causes import Cause, Tolerances, causes
from bellows_design.study.sensitivity.local import slopes

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.neighbours.sensitivities import Sensitivities

JUDGED = (ANGLE, STRESS)
"""Responses that have tolerances: for these there is an estimate of the mesh's error."""

SOURCES = ("print", "material", "mesh")

Changes = Mapping[str, float]
"""Of each response judged, ° and MPa."""


@dataclass(frozen=True)
class Check:
    """Evaluations at both ends of a cause.

    Attributes:
        lower, upper: Changes of the responses there.
        nonlinearity_percent: How far the change farther off is from that of the derivative, in
            percent of that; by response.
    """

    lower: Changes
    upper: Changes
    nonlinearity_percent: Changes


@dataclass(frozen=True)
class Contribution:
    """What a cause does.

    Attributes:
        cause: The cause.
        changes: Of the responses at its upper end, by derivatives.
        check: Evaluations at both ends; None where there are none.
        unchecked: Why an end that should have been evaluated could not be; else empty.
    """

    cause: Cause
    changes: Changes
    check: Check | None = None
    unchecked: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {
            "cause": self.cause.label,
            "source": self.cause.source,
            "part_of": self.cause.part_of or None,
            "parameters": dict(self.cause.direction),
            "changes": dict(self.changes),
            "check": None if self.check is None else asdict(self.check),
            "unchecked": self.unchecked or None,
        }


@dataclass(frozen=True)
class Margin:
    """How far a response may be off, ° or MPa.

    ``likely`` is the root of the sum of squares of independent causes, walls counting together;
    ``worst`` the sum of all, each wall by itself.
    """

    likely: float
    worst: float


@dataclass(frozen=True)
class Tolerated:
    """Angle and stress with their margins.

    Attributes:
        tolerances: What was assumed.
        layer_height: Of the printer, mm.
        values: Of the responses.
        contributions: Of all causes.
        margins: By response and source: print, material, mesh (None without an estimate), total.
    """

    tolerances: Tolerances
    layer_height: float
    values: Mapping[str, float]
    contributions: tuple[Contribution, ...]
    margins: Mapping[str, Mapping[str, Margin | None]]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {
            "wall_mm": self.tolerances.wall,
            "height_mm": self.tolerances.layers * self.layer_height,
            "modulus_percent": self.tolerances.modulus_percent,
            "contributions": [each.to_dict() for each in self.contributions],
            "margins": {
                response: {
                    source: None if margin is None else asdict(margin)
                    for source, margin in margins.items()
                }
                for response, margins in self.margins.items()
            },
        }


def tolerated(
    evaluation: Evaluation, found: Sensitivities, tolerances: Tolerances, answers: Answers
) -> Tolerated:
    """What ``tolerances`` do to the results of an evaluation with sensitivities.

    Raises ``PrintersError`` if there is no profile of the design's printer.
    """
    values = {name: float(getattr(evaluation, name)) for name in JUDGED}
    by_derivatives = _contributions(found, tolerances)
    contributions = tuple(_checked(found.design, values, by_derivatives, answers))
    return Tolerated(
        tolerances=tolerances,
        layer_height=found.design.profile().layer_height,
        values=values,
        contributions=contributions,
        margins={name: _margins(name, contributions, evaluation) for name in JUDGED},
    )


def _contributions(found: Sensitivities, tolerances: Tolerances) -> tuple[Contribution, ...]:
    by_response = slopes(found)
    return tuple(
        Contribution(cause, {name: _along(by_response[name], cause) for name in JUDGED})
        for cause in causes(found.design, tolerances)
    )


def _along(slope: Mapping[str, float], cause: Cause) -> float:
    return sum(slope[name] * change for name, change in cause.direction.items())


def _checked(
    design: Design,
    values: Mapping[str, float],
    contributions: Sequence[Contribution],
    answers: Answers,
) -> Iterator[Contribution]:
    """All contributions, the largest of each source and response with evaluations of both ends."""
    ends = {each.cause.label: _ends(design, each.cause) for each in _largest(contributions)}
    asked = [end for pair in ends.values() if not isinstance(pair, str) for end in pair]
    given = answers(Question(end, design) for end in asked)
    for each in contributions:
        pair = ends.get(each.cause.label)
        if pair is None:
            yield each
        elif isinstance(pair, str):
            yield replace(each, unchecked=pair)
        else:
            yield _compared(each, values, next(given), next(given))


def _largest(contributions: Sequence[Contribution]) -> list[Contribution]:
    """Of each source and response, in the order of all; those that do nothing are none."""

    def size(each: Contribution, response: str) -> float:
        return abs(each.changes[response])

    chosen = {
        max(own, key=lambda each: size(each, response)).cause.label
        for response in JUDGED
        for own in (_independent(contributions, source) for source in SOURCES[:2])
        if any(size(each, response) for each in own)
    }
    return [each for each in contributions if each.cause.label in chosen]


def _ends(design: Design, cause: Cause) -> tuple[Design, Design] | str:
    """The designs at the lower and upper end, or why there is none."""
    values = parameters(design)
    try:
        lower, upper = (
            varied(design, {n: values[n] + sign * c for n, c in cause.direction.items()})
            for sign in (-1, 1)
        )
    except DesignError as error:
        return str(error)
    return lower, upper


def _compared(
    each: Contribution, values: Mapping[str, float], lower: Answer, upper: Answer
) -> Contribution:
    for answer in (lower, upper):
        if not answer.done or answer.origin == "ordinary":  # on a mesh of its own
            return replace(each, unchecked=answer.reason or answer.fallback)
    low = {name: getattr(lower, name) - values[name] for name in JUDGED}
    high = {name: getattr(upper, name) - values[name] for name in JUDGED}
    off = {
        name: 100 * max(abs(high[name] - change), abs(low[name] + change)) / abs(change)
        for name, change in each.changes.items()
        if change
    }
    return replace(each, check=Check(low, high, off))


def _margins(
    response: str, contributions: Sequence[Contribution], evaluation: Evaluation
) -> dict[str, Margin | None]:
    margins: dict[str, Margin | None] = {
        source: Margin(
            math.hypot(*(each.changes[response] for each in _independent(contributions, source))),
            sum(abs(each.changes[response]) for each in _alone(contributions, source)),
        )
        for source in SOURCES[:2]
    }
    margins["mesh"] = _mesh(response, evaluation)
    known = [margin for margin in margins.values() if margin is not None]
    return margins | {"total": _total(known)}


def _mesh(response: str, evaluation: Evaluation) -> Margin | None:
    """The estimated error; None without an estimate."""
    errors = evaluation.error_estimate
    percent = errors.bending_angle_percent if response == ANGLE else errors.max_von_mises_percent
    if percent is None:
        return None
    off = percent / 100 * abs(getattr(evaluation, response))
    return Margin(off, off)


def _total(margins: Iterable[Margin]) -> Margin:
    known = list(margins)
    return Margin(
        math.hypot(*(margin.likely for margin in known)), sum(margin.worst for margin in known)
    )


def _independent(contributions: Sequence[Contribution], source: str) -> list[Contribution]:
    """Those that stand by themselves: walls together."""
    own = [each for each in contributions if each.cause.source == source]
    return [each for each in own if not each.cause.part_of]


def _alone(contributions: Sequence[Contribution], source: str) -> list[Contribution]:
    """Those that have no parts: each wall alone."""
    return [e for e in contributions if e.cause.source == source and not e.cause.parts]
