"""Deformed and CAD surfaces as bytes for the page's viewer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.web.packing import packed
from bellows_design.web.scene import Field, Surface

if TYPE_CHECKING:
    from bellows_design.deformed import SurfaceFrames
    from bellows_design.geometry.tessellation import ClosedMesh

STRESS = "von Mises stress"


def deformed(frames: SurfaceFrames) -> bytes:
    """The actuator at rest and at the pressure reached, coloured by its stress."""
    labels = tuple(f"{pressure:.4g} MPa" for pressure in frames.pressures_mpa)
    stress = Field(STRESS, "MPa", frames.von_mises)
    surface = Surface("actuator", frames.triangles, frames.positions, (stress,), labels)
    return packed([surface])


def part(mesh: ClosedMesh) -> bytes:
    """The printed part."""
    return packed([Surface("actuator", mesh.triangles, mesh.vertices)])
