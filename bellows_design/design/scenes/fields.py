"""Fields that several scenes have: gravity, friction and masses."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import did_you_mean, quoted

Direction = tuple[float, float]

DIRECTIONS: dict[str, Direction] = {
    "none": (0.0, 0.0),
    "down": (0.0, -1.0),
    "up": (0.0, 1.0),
    "forward": (1.0, 0.0),
    "backward": (-1.0, 0.0),
}
"""Names of directions in the finger's plane, as (x, z). A finger that lies on a table as it was
printed has gravity down, one that hangs from its root has it forward."""

FRICTION = 0.5
"""Coefficient of friction of TPU on smooth, dry plastic or steel: an assumption, to be replaced by
a measurement. Friction of polyurethane rises as it is softer, and is similar to a rubber's
(Gallagher Corporation, Polyurethane design guide, coefficient of friction)."""


def _direction(value: Any) -> Any:
    """A unit vector, or no gravity, of a name or two numbers."""
    if isinstance(value, str):
        require(
            value in DIRECTIONS,
            f"gravity is {quoted(value)}{did_you_mean(value, DIRECTIONS)}",
        )
        return DIRECTIONS[value]
    numbers = isinstance(value, list | tuple) and len(value) == 2
    require(
        numbers and all(_is_number(each) for each in value),
        f"gravity is {quoted(value)} but must be {', '.join(DIRECTIONS)} or a direction [x, z]",
    )
    x, z = (float(each) for each in value)
    largest = max(abs(x), abs(z))
    if largest == 0:
        return DIRECTIONS["none"]
    # Once more normalized, a unit vector would differ in its last digit.
    if abs(math.hypot(x, z) - 1) < 1e-12:
        return x, z
    x, z = x / largest, z / largest  # whose squares neither overflow nor vanish
    return x / math.hypot(x, z), z / math.hypot(x, z)


def _is_number(value: Any) -> bool:
    if not isinstance(value, int | float) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond all floating-point numbers
        return False


Gravity = Annotated[Direction, BeforeValidator(_direction)]
"""Direction of gravity (x, z) in the finger's plane as a unit vector, (0, 0) without weight; also
given by one of ``DIRECTIONS`` or as any vector."""


def gravity_field(default: str) -> Direction:
    """Field of a direction; ``default`` is the name of one."""
    field: Direction = Field(
        default=DIRECTIONS[default],
        description=f"direction (x, z), or {', '.join(DIRECTIONS)}",
    )
    return field


def friction_field(default: float) -> float:
    """Field of a coefficient of Coulomb friction."""
    field: float = Field(default=default, ge=0, le=3, description="coefficient of friction")
    return field


def mass_field(text: str) -> float:
    """Field of a mass in g."""
    field: float = Field(gt=0, le=10_000, description=text, json_schema_extra={"unit": "g"})
    return field
