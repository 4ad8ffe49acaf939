"""From the twelve numbers of a soft bellows actuator to an approved, printable STL."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.design.overrides import with_overrides
    from bellows_design.design.shipped import load_design
    from bellows_design.errors import BellowsError, DesignError
    from bellows_design.own_body.body import OwnBody
    from bellows_design.own_body.parts import BodyPart

__version__ = "0.1.0"

__all__ = [
    "BellowsError",
    "BodyPart",
    "Design",
    "DesignError",
    "OwnBody",
    "__version__",
    "load_design",
    "with_overrides",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "design.design": ("Design",),
        "design.overrides": ("with_overrides",),
        "design.shipped": ("load_design",),
        "errors": ("BellowsError", "DesignError"),
        "own_body.body": ("OwnBody",),
        "own_body.parts": ("BodyPart",),
    },
)
