"""What is to be built and under which conditions it is approved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.design.bellows_parameters import BellowsParameters
    from bellows_design.design.conditions import Limits, Load
    from bellows_design.design.design import Design
    from bellows_design.design.features.fingertip import Fingertip
    from bellows_design.design.features.mount import Mount
    from bellows_design.design.indent import Indent
    from bellows_design.design.overrides import with_overrides
    from bellows_design.design.port import Port
    from bellows_design.design.shipped import load_design, shipped_designs

__all__ = [
    "BellowsParameters",
    "Design",
    "Fingertip",
    "Indent",
    "Limits",
    "Load",
    "Mount",
    "Port",
    "load_design",
    "shipped_designs",
    "with_overrides",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "bellows_parameters": ("BellowsParameters",),
        "conditions": ("Limits", "Load"),
        "design": ("Design",),
        "features.fingertip": ("Fingertip",),
        "features.mount": ("Mount",),
        "indent": ("Indent",),
        "overrides": ("with_overrides",),
        "port": ("Port",),
        "shipped": ("load_design", "shipped_designs"),
    },
)
