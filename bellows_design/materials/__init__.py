"""Materials: what is known of each, the library, and fits to measurements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.materials.library import load_material, material_names, write_material
    from bellows_design.materials.material import Material
    from bellows_design.materials.measurements.loading import load_measurements
    from bellows_design.materials.measurements.options import ReadingOptions
    from bellows_design.materials.measurements.points import Measurements
    from bellows_design.materials.selection import fit

__all__ = [
    "Material",
    "Measurements",
    "ReadingOptions",
    "fit",
    "load_material",
    "load_measurements",
    "material_names",
    "write_material",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "measurements.points": ("Measurements",),
        "measurements.options": ("ReadingOptions",),
        "measurements.loading": ("load_measurements",),
        "selection": ("fit",),
        "library": ("load_material", "material_names", "write_material"),
        "material": ("Material",),
    },
)
