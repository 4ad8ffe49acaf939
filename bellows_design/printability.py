"""What a design declares to the printability rules: walls, gaps and one opening. Their report."""

from __future__ import annotations

from typing import Any

from bellows_design.design.design import Design
from bellows_design.geometry.tessellation import ClosedMesh
from printers import (
    DeclaredGap,
    DeclaredWall,
    Opening,
    PrintabilityReport,
    PrintedModel,
)


def printed_model(design: Design, mesh: ClosedMesh) -> PrintedModel:
    """The design's mesh with its declared walls, gaps and opening, mm.

    A mount lies before the finger and keeps the printer's bounds only, not the cross-section's.
    """
    limits, bellows = design.limits, design.bellows
    gaps = (DeclaredGap("bubble_distance", bellows.bubble_distance),)
    return PrintedModel(
        vertices=mesh.vertices,
        triangles=mesh.triangles,
        walls=declared_walls(design),
        gaps=gaps if bellows.bubble_count > 1 else (),
        openings=(port_opening(design),),
        cross_section_limit=(limits.cross_section_width, limits.cross_section_height),
        cross_section_start=None if design.mount is None else 0.0,
    )


def declared_walls(design: Design) -> tuple[DeclaredWall, ...]:
    """Standing walls are made of lines; an indent's bottom wall, lying on the bed, of layers."""
    standing = (
        DeclaredWall("bubble_thickness", design.bellows.bubble_thickness),
        DeclaredWall("tendon_thickness", design.bellows.tendon_thickness),
        DeclaredWall("port.wall", design.port.wall, around=port_opening(design)),
    )
    if design.indent is None:
        return standing
    bottom = design.indent.remaining_wall(design.bellows)
    return (*standing, DeclaredWall("bottom wall at the indent", bottom, "layers"))


def port_opening(design: Design) -> Opening:
    """The mouth of the port's socket, where the tube goes in."""
    port = design.port
    return Opening(
        name="port",
        centre=(-port.depth, 0.0, port.axis_height),
        direction=(-1.0, 0.0, 0.0),
        radius=port.tube_diameter / 2,
    )


def check_dict(design: Design, report: PrintabilityReport) -> dict[str, Any]:
    """The report on ``design`` as plain values for JSON."""
    return {"design": design.name, "digest": design.digest, **report.to_dict()}
