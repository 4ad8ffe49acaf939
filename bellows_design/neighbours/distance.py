"""How far designs are apart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from bellows_design.design.design import Design

WITHOUT_EFFECT = {"length", "offset", "number_of_bubbles"}
"""Numbers of the bellows that change an actuator of so many bubbles at its ends only."""

LAW = ("model", "mu", "alpha", "higher", "constants")
"""What of a material decides how it deforms."""


def distance(one: Design, other: Design) -> float:
    """Root of the sum of squares of the relative differences of two designs' numbers.

    Infinite where other things differ. Port, mount, printer and limits do not count, nor do lengths
    of the actuator's ends.
    """
    ours, theirs = _numbers(one), _numbers(other)
    if ours.keys() != theirs.keys():
        return float("inf")
    return math.hypot(*(_apart(value, theirs[name]) for name, value in ours.items()))


def _numbers(design: Design) -> dict[str, Any]:
    """What decides angle and stress, by dotted name."""
    table = design.model_dump(mode="json")
    counting = {
        "bellows": {k: v for k, v in table["bellows"].items() if k not in WITHOUT_EFFECT},
        "indent": table["indent"],
        "fingertip": table["fingertip"],
        "material": {key: table["material"][key] for key in LAW},
        "load": table["load"],
    }
    return dict(_flat("", counting))


def _flat(name: str, content: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(content, Mapping):
        for key, value in content.items():
            yield from _flat(f"{name}.{key}", value)
    elif isinstance(content, list):
        for index, value in enumerate(content):
            yield from _flat(f"{name}.{index}", value)
    else:
        yield name, content


def _apart(one: Any, other: Any) -> float:
    """Relative difference of two numbers; 0 or infinite for other values."""
    if one == other:
        return 0.0
    if not (isinstance(one, float) and isinstance(other, float)):
        return float("inf")
    return abs(one - other) / max(abs(one), abs(other))
