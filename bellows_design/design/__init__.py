"""What is to be built and under which conditions it is approved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.design.bellows_parameters import BellowsParameters, Indent, Port
    from bellows_design.design.design import Design, Limits, Load, load_design, shipped_designs
    from bellows_design.design.overrides import with_overrides

__all__ = [
    "BellowsParameters",
    "Design",
    "Indent",
    "Limits",
    "Load",
    "Port",
    "load_design",
    "shipped_designs",
    "with_overrides",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "bellows_parameters": ("BellowsParameters", "Indent", "Port"),
        "design": ("Design", "Limits", "Load", "load_design", "shipped_designs"),
        "overrides": ("with_overrides",),
    },
)
