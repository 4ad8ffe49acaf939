"""What other programs get: meshes and decks of a design, and the whole deformed actuator."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.exchange.actuator import write_actuator
    from bellows_design.exchange.design_mesh import design_problem
    from bellows_design.exchange.files import Written, write_design_mesh

__all__ = ["Written", "design_problem", "write_actuator", "write_design_mesh"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "actuator": ("write_actuator",),
        "design_mesh": ("design_problem",),
        "files": ("Written", "write_design_mesh"),
    },
)
