"""Materials: what is known of each, the library, and fits to measurements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.materials.library import Material, load_material, material_names

__all__ = ["Material", "load_material", "material_names"]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "library": ("Material", "load_material", "material_names"),
    },
)
