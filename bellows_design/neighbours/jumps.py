"""Where the number of bubbles changes, which no derivative knows of."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design

SPAN, SAMPLES, HALVINGS = 0.25, 50, 30
"""Relative change of a parameter that is searched, in so many steps, and how far it is narrowed."""

NAMES = (
    "length",
    "offset",
    "bubble_thickness",
    "tendon_thickness",
    "chamber_length",
    "bubble_distance",
)
"""What the number of bubbles depends on."""


@dataclass(frozen=True)
class CountChange:
    """From ``value`` (mm) of ``parameter`` on, away from the design's, there are ``bubbles``."""

    parameter: str
    value: float
    bubbles: int


def count_changes(design: Design) -> tuple[CountChange, ...]:
    """The nearest changes of the number of bubbles on either side of each parameter's value.

    None where the design states the number, nor beyond a quarter of the value.
    """
    bellows = design.bellows
    if bellows.number_of_bubbles is not None:
        return ()
    found = (_change(bellows, name, sign) for name in NAMES for sign in (-1, 1))
    return tuple(change for change in found if change is not None)


def _change(bellows: BellowsParameters, name: str, sign: int) -> CountChange | None:
    value = float(getattr(bellows, name))
    before = value
    for step in range(1, SAMPLES + 1):
        there = value * (1 + sign * SPAN * step / SAMPLES)
        if _count(bellows, name, there) != bellows.bubble_count:
            return _located(bellows, name, before, there)
        before = there
    return None


def _located(bellows: BellowsParameters, name: str, low: float, high: float) -> CountChange:
    """The change between two values, of which the first has the design's number of bubbles."""
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        same = _count(bellows, name, middle) == bellows.bubble_count
        low, high = (middle, high) if same else (low, middle)
    return CountChange(name, high, _count(bellows, name, high))


def _count(bellows: BellowsParameters, name: str, value: float) -> int:
    """Number of bubbles with another value of a parameter, whether or not it is admissible."""
    return type(bellows).model_construct(**bellows.model_dump() | {name: value}).bubble_count
