"""A finger that carries a mass."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import model_validator

from bellows_design.design.lengths import Millimetres, length_field
from bellows_design.design.scenes.fields import DIRECTIONS, Gravity, gravity_field, mass_field
from bellows_design.validation.parameters import Parameters, require


class Payload(Parameters):
    """A mass that hangs on the finger's lower side.

    Attributes:
        mass_g: g.
        place: From the root along the finger at rest, mm; None for the tip.
        gravity: Direction of the weight of the mass and of the finger.
    """

    kind: Literal["payload"] = "payload"
    mass_g: float = mass_field("mass that hangs on the finger")
    place: Millimetres | None = length_field(
        0, 1000, "from the root along the finger at rest; without it the tip", None
    )
    gravity: Gravity = gravity_field("down")

    @model_validator(mode="after")
    def _has_a_weight(self) -> Self:
        require(
            self.gravity != DIRECTIONS["none"],
            f"gravity is 'none', and so mass_g = {self.mass_g:g} g has no weight; a finger without "
            "load is a scene of the kind 'free'",
        )
        return self
