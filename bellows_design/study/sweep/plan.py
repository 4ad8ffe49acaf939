"""Which designs a sweep asks for, in which order; what cannot exist is known without asking."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import NDArray

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question, Start
from bellows_design.batch.results import Study
from bellows_design.batch.schema import Row
from bellows_design.design.design import Design
from bellows_design.design.topology import NOTHING, signature
from bellows_design.errors import DesignError
from bellows_design.study.sweep.order import ordered
from bellows_design.study.sweep.sampling import Sampling, points
from bellows_design.study.sweep.space import Axis, design_at

if TYPE_CHECKING:
    from collections.abc import Hashable

ENDS_LEFT_OUT = "unit-cell"
"""Faces at root and tip do not part designs: most are evaluated by the model that has neither."""


@dataclass(frozen=True)
class Space:
    """What a sweep looks at.

    Attributes:
        base: The design that others are varied from.
        axes: What is varied.
        sampling, number, seed: How points are chosen, as for :func:`sampling.points`.
        start: What each evaluation starts from, ``nearest`` or ``ordinary``.
        accuracy_percent: Of ordinary evaluations.
    """

    base: Design
    axes: tuple[Axis, ...]
    sampling: Sampling = Sampling.GRID
    number: int | None = None
    seed: int = 0
    start: Start = "nearest"
    accuracy_percent: float | None = None


@dataclass(frozen=True)
class Plan:
    """The points of a space: those that are designs, in their order, and why others are none.

    Attributes:
        space: What it is the plan of.
        points: All of them, shape (points, axes).
        order: Places of the points that are designs, neighbours after each other.
        keys: Of their questions, in this order.
        impossible: Place of every other point -> why it is no design.
    """

    space: Space
    points: NDArray[np.float64]
    order: NDArray[np.intp]
    keys: tuple[str, ...]
    impossible: dict[int, str]

    @property
    def study(self) -> Study:
        """What its results file belongs to."""
        space = self.space
        options = {
            "vary": [str(axis) for axis in space.axes],
            "sample": space.sampling.value,
            "number": space.number,
            "seed": None if space.sampling is Sampling.GRID else space.seed,
            "start": space.start,
            "accuracy_percent": space.accuracy_percent,
            "points": hashlib.sha256(np.ascontiguousarray(self.points).tobytes()).hexdigest(),
        }
        return Study("sweep", space.base, options)

    def varied(self, place: int) -> dict[str, float]:
        """The values at a point, by the names of the axes."""
        names = (axis.name for axis in self.space.axes)
        return dict(zip(names, self.points[place].tolist(), strict=True))

    def question(self, place: int) -> Question:
        """What is asked about a point that is a design."""
        design = design_at(self.space.base, self.varied(place))
        return Question(design, self.space.start, accuracy_percent=self.space.accuracy_percent)

    def row(self, position: int, question: Question, answer: Answer) -> Row:
        """The row of an answer to the question that is at ``position`` of the order."""
        place = int(self.order[position])
        return Row(answer, question.design, self.varied(place), position)

    def impossible_rows(self) -> list[Row]:
        """A failure for each point that is no design; they follow those that are."""
        return [
            Row(self._impossible(place, why), None, self.varied(place), len(self.order) + number)
            for number, (place, why) in enumerate(self.impossible.items())
        ]

    def _impossible(self, place: int, why: str) -> Answer:
        asked = [self.space.base.digest, "no design", self.varied(place)]
        key = hashlib.sha256(json.dumps(asked).encode()).hexdigest()
        return Answer(key=key, digest="", status="failed", reason=why)


class Questions(Sequence[Question]):
    """Questions of a plan at some positions; each is made when it is asked for."""

    def __init__(self, plan: Plan, positions: Sequence[int]) -> None:
        self._plan, self.positions = plan, positions

    def __len__(self) -> int:
        return len(self.positions)

    @overload
    def __getitem__(self, index: int) -> Question: ...
    @overload
    def __getitem__(self, index: slice) -> Questions: ...
    def __getitem__(self, index: int | slice) -> Question | Questions:
        if isinstance(index, slice):
            return Questions(self._plan, self.positions[index])
        return self._plan.question(int(self._plan.order[self.positions[index]]))


def planned(space: Space) -> Plan:
    """All points of a space; those that are the same design are asked once.

    Raises ``DesignError`` for numbers that make no sample, as :func:`sampling.points`.
    """
    found = points(space.axes, space.sampling, space.number, space.seed)
    draft = Plan(space, found, np.arange(len(found)), (), {})
    impossible: dict[int, str] = {}
    kinds: dict[str, tuple[int, int]] = {}  # key -> place and number of the topology
    topologies: dict[Hashable, int] = {}
    for place in range(len(found)):
        try:
            question = draft.question(place)
        except DesignError as error:
            impossible[place] = " ".join(error.sentences)
        else:
            kind = topologies.setdefault(_topology(question.design), len(topologies))
            kinds.setdefault(question.key, (place, kind))
    places = np.array([place for place, _ in kinds.values()], dtype=np.intp)
    order = ordered(_relative(space.axes, found)[places], [kind for _, kind in kinds.values()])
    keys = tuple(kinds)
    return Plan(space, found, places[order], tuple(keys[each] for each in order), impossible)


def _topology(design: Design) -> Hashable:
    """Equal for designs that may be neighbours."""
    lengths = signature(design, ENDS_LEFT_OUT)
    signs = ((name, 0 if abs(v) < NOTHING else v > 0) for name, v in lengths.items())
    return (design.bellows.bubble_count, *signs)


def _relative(axes: Sequence[Axis], found: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points in units of each axis's middle: relative differences, as designs are compared by."""
    middles = [(axis.low + axis.high) / 2 for axis in axes]
    scales = [abs(m) or axis.high - axis.low for m, axis in zip(middles, axes, strict=True)]
    return found / np.array(scales)
