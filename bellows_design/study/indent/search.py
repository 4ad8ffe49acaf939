"""The search: spread over the room of every kind, then walk from the best towards each aim."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from bellows_design.errors import BellowsError, DesignError
from bellows_design.study.changes import Changes
from bellows_design.study.indent.aims import (
    LEAST_STRESS,
    Aim,
    as_in_the_paper,
    deepest_printed,
    like,
    of_whole_layers,
)
from bellows_design.study.indent.kinds import KINDS, Kind, kind_of, spread
from bellows_design.study.indent.tester import Evaluate, Tester
from bellows_design.study.indent.trial import Trial, front
from bellows_design.study.indent.walk import Walk, walk_bounds
from solver.errors import MeshingError, SolverError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.design.design import Design

POINTS, MOST_POINTS = 4, 200
"""Indents of each kind that are spread over its room."""

MOST_WALKS = 3
"""One after the other, each from the ordinary evaluation of what the one before found."""


@dataclass(frozen=True)
class Found:
    """The best indent for an aim; ``refused_by``: printability rules that refuse the part."""

    aim: Aim
    trial: Trial
    refused_by: tuple[str, ...]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "aim": self.aim.name,
            "value": self.aim.value(self.trial.changes),
            **self.trial.to_dict(),
            "printable": not self.refused_by,
            "refused_by": list(self.refused_by),
        }


@dataclass(frozen=True)
class IndentStudy:
    """What was tried on a design, and what was found; ``plain`` is the design without indent."""

    design: Design
    plain: Trial
    trials: tuple[Trial, ...]
    found: tuple[Found, ...]

    @property
    def front(self) -> tuple[Trial, ...]:
        """Tried indents that no other betters, the design without one among them."""
        return self.front_of(self.trials)

    def front_of(self, trials: Sequence[Trial]) -> tuple[Trial, ...]:
        """The same of other trials."""
        return front([self.plain, *trials])

    @property
    def in_the_paper(self) -> Changes:
        """What the paper's indent changed."""
        return as_in_the_paper()

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        return {
            "design": self.design.name,
            "paper": asdict(self.in_the_paper),
            "plain": self.plain.to_dict(),
            "found": [each.to_dict() for each in self.found],
            "front": [each.to_dict() for each in self.front],
            "trials": [each.to_dict() for each in self.trials],
        }


def default_aims() -> tuple[Aim, ...]:
    """What the paper reports, and the least stress at no loss of angle."""
    return like(as_in_the_paper()), LEAST_STRESS


def searched(
    design: Design,
    evaluate: Evaluate,
    points: int = POINTS,
    kinds: Sequence[Kind] = KINDS,
    aims: Sequence[Aim] | None = None,
    tell: Callable[[Trial], None] = lambda _: None,
) -> IndentStudy:
    """Search for indents of ``design``.

    Args:
        design: An indent that it has is left out.
        evaluate: Gives the evaluations.
        points: Indents of each kind that are spread over its room.
        kinds: Of indents.
        aims: What to search for; without it :func:`default_aims`.
        tell: Hears of every trial.

    Raises:
        DesignError: ``points`` out of bounds, or the design itself is not solved.
        BellowsError, MeshingError: As the evaluation of the design itself.
    """
    require_points(points)
    tester = Tester(design, evaluate, tell)
    starts = [found for kind in kinds for found in _spread(tester, kind, points)]
    found = [_found(tester, aim, starts) for aim in (default_aims() if aims is None else aims)]
    plain = tester.trial(tester.plain, "plain")
    return IndentStudy(tester.design, plain, tuple(tester.trials), tuple(filter(None, found)))


def require_points(points: int) -> None:
    """Raise ``DesignError`` if ``points`` is out of bounds."""
    if not 1 <= points <= MOST_POINTS:
        raise DesignError(f"points is {points} but must lie between 1 and {MOST_POINTS}.")


def _spread(tester: Tester, kind: Kind, points: int) -> Iterator[Evaluation]:
    for indent in spread(kind, tester.design.bellows, points):
        found = tester.tried(indent, "spread")
        if found is not None:
            yield found


def _found(tester: Tester, aim: Aim, starts: Sequence[Evaluation]) -> Found | None:
    """The best for an aim: from the best start, walk by walk; None without a start."""
    best = _best(tester, aim, starts)
    for _ in range(MOST_WALKS if best else 0):
        assert best is not None
        after = _walked(tester, aim, best)
        if after is None or _value(tester, aim, after) >= _value(tester, aim, best):
            break
        best = after
    if best is None:
        return None
    return Found(aim, tester.trial(best, "found"), refused_by(best.design))


def _best(tester: Tester, aim: Aim, starts: Sequence[Evaluation]) -> Evaluation | None:
    """The best start; for a printable aim after its depth is of whole layers."""
    if not aim.printable:
        return min(starts, key=lambda each: _value(tester, aim, each), default=None)
    nearest = sorted(starts, key=lambda each: _value(tester, aim, each))[:MOST_WALKS]
    layered = [_layered(tester, each.design) for each in nearest]
    known = [each for each in layered if each is not None]
    return min(known, key=lambda each: _value(tester, aim, each), default=None)


def _walked(tester: Tester, aim: Aim, start: Evaluation) -> Evaluation | None:
    """The ordinary evaluation of what a walk finds; None if it leads nowhere."""
    indent = start.design.indent
    assert indent is not None
    kind = kind_of(indent)
    deepest = deepest_printed(start.design, kind.side == "outside") if aim.printable else 1e9
    bounds = walk_bounds(start.design, kind, deepest)
    try:
        end = Walk(start, tester.plain, aim, tester.note).best(bounds)
    except (BellowsError, MeshingError, SolverError):  # no neighbour can start there
        return None
    if aim.printable:
        return _layered(tester, end)
    assert end.indent is not None
    return tester.tried(end.indent, "found")


def _layered(tester: Tester, design: Design) -> Evaluation | None:
    """With its indent of whole layers; None if no such indent fits, or it is not solved."""
    assert design.indent is not None
    indent = of_whole_layers(design, design.indent)
    return None if indent is None else tester.tried(indent, "found")


def _value(tester: Tester, aim: Aim, found: Evaluation) -> float:
    return aim.value(tester.trial(found, "").changes)


def refused_by(design: Design) -> tuple[str, ...]:
    """Printability rules that refuse the part; none if it may be printed."""
    from bellows_design import pipeline

    report = pipeline.check(design, pipeline.build_part(design))
    return tuple(dict.fromkeys(result.rule for result in report.failures))
