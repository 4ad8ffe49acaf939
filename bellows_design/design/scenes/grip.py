"""Two or three fingers around an object."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from bellows_design.design.lengths import Millimetres, length_field
from bellows_design.design.scenes.fields import FRICTION, friction_field, mass_field
from bellows_design.validation.parameters import Parameters, require

ObjectShape = Literal["cylinder", "sphere", "box"]


class Grip(Parameters):
    """Equal fingers that hang with their lower sides towards an object between them.

    The object's axis is that of the gripper; it keeps its place while the fingers close on it, and
    its weight pulls along the fingers, away from their roots.

    Attributes:
        fingers: Two opposite ones, or three at 120 degrees.
        object: ``cylinder``: across the fingers' planes, with two fingers only. ``sphere``.
            ``box``: a flat face towards every finger.
        size: Diameter of cylinder or sphere; of a box the distance of opposite faces, of three
            faces the diameter of the circle that they touch, mm.
        height: Of a box along the fingers, mm; None for its size.
        mass_g: Of the object, g.
        friction: Coefficient of friction between finger and object.
        distance: From every finger's lower side at rest to the gripper's axis, mm.
        place: Of the object's middle from the root along the finger at rest, mm.
    """

    kind: Literal["grip"] = "grip"
    fingers: int = Field(default=2, ge=2, le=3, description="two opposite ones, or three")
    object: ObjectShape = Field(default="cylinder", description="shape of what is gripped")
    size: Millimetres = length_field(1, 500, "diameter, or distance of a box's faces")
    height: Millimetres | None = length_field(
        1, 500, "of a box along the fingers; without it its size", None
    )
    mass_g: float = mass_field("mass of the object")
    friction: float = friction_field(FRICTION)
    distance: Millimetres = length_field(
        0.5, 500, "from a finger's lower side at rest to the gripper's axis"
    )
    place: Millimetres = length_field(
        0, 1000, "of the object's middle from the root along the finger"
    )

    @model_validator(mode="after")
    def _describes_a_grip(self) -> Self:
        require(
            self.size / 2 <= self.distance,
            f"size = {self.size:g} mm reaches {self.size / 2 - self.distance:.3g} mm into the "
            f"finger at rest; at distance = {self.distance:g} mm it must be at most "
            f"{2 * self.distance:g} mm",
        )
        require(
            self.object == "box" or self.height is None,
            f"height belongs to a box; a {self.object} has its size alone",
        )
        require(
            self.object != "cylinder" or self.fingers == 2,
            "fingers = 3 cannot close on a cylinder, which lies across two of them; a sphere has "
            "three sides alike",
        )
        return self
