"""A finger with nothing around it."""

from __future__ import annotations

from typing import Literal

from bellows_design.design.scenes.fields import Gravity, gravity_field
from bellows_design.validation.parameters import Parameters


class Free(Parameters):
    """The finger under pressure, and under its own weight if gravity has a direction."""

    kind: Literal["free"] = "free"
    gravity: Gravity = gravity_field("none")
