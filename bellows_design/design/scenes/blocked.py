"""A finger whose tip is kept from going where the pressure sends it."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from bellows_design.design.lengths import Millimetres, length_field
from bellows_design.design.scenes.fields import Gravity, friction_field, gravity_field
from bellows_design.validation.parameters import Parameters, require

Support = Literal["load_cell", "held", "wall"]


class Blocked(Parameters):
    """The tip presses on a load cell or a wall, or is held.

    Attributes:
        support: ``load_cell``: a frictionless level plate below the lower edge of the tip, which
            is free to turn and to slide on it; the rest of the finger does not touch it. ``wall``:
            a level plane below the whole finger, which any point of its lower side may touch.
            ``held``: the tip's face is held in its angle and at its place.
        distance: From the finger's lower side at rest down to plate or wall, mm.
        friction: Coefficient of friction on the wall.
        gravity: Direction of the finger's own weight.
    """

    kind: Literal["blocked"] = "blocked"
    support: Support = Field(default="load_cell", description="what keeps the tip")
    distance: Millimetres = length_field(
        0, 500, "from the lower side at rest down to plate or wall", 0.0
    )
    friction: float = friction_field(0.0)
    gravity: Gravity = gravity_field("none")

    @model_validator(mode="after")
    def _has_what_its_support_knows(self) -> Self:
        require(
            self.support == "wall" or self.friction == 0,
            f"friction = {self.friction:g} belongs to the support 'wall'; a load cell has none, "
            "and a tip that is held does not slide",
        )
        require(
            self.support != "held" or self.distance == 0,
            f"distance = {self.distance:g} mm belongs to the supports 'load_cell' and 'wall'; a "
            "tip that is held stays where it is at rest",
        )
        return self
