"""Solids of the printed part and of the bodies that are computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.geometry.deferred_vtk import defer_vtk
from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.geometry.actuator import full_body, half_body, printed_part, unit_cell

defer_vtk()  # before CadQuery is imported, which all modules here do

__all__ = ["full_body", "half_body", "printed_part", "unit_cell"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "actuator": ("printed_part", "unit_cell", "half_body", "full_body"),
    },
)
