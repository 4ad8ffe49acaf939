"""The whole deformed actuator, put together from what was solved; docs/accuracy.md says how.

    body = deformed_actuator(evaluate(load_design("finger")))

Names are imported when first used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.deformed.actuator import (
        Assembly,
        DeformedActuator,
        deformed_actuator,
        deformed_surface,
    )
    from bellows_design.deformed.bodies import deformed_body
    from bellows_design.deformed.frames import surface_frames
    from bellows_design.deformed.surface import SurfaceFrames

__all__ = [
    "Assembly",
    "DeformedActuator",
    "SurfaceFrames",
    "deformed_actuator",
    "deformed_body",
    "deformed_surface",
    "surface_frames",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "actuator": ("Assembly", "DeformedActuator", "deformed_actuator", "deformed_surface"),
        "bodies": ("deformed_body",),
        "frames": ("surface_frames",),
        "surface": ("SurfaceFrames",),
    },
)
