"""Views of what is added to the bellows: the mount's plate and the fingertip."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.reports.page.sketch.cut import cut
from bellows_design.reports.page.sketch.dimension import Callout, Dimension, View

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.geometry.tessellation import ClosedMesh


def mount_view(design: Design, mesh: ClosedMesh) -> View:
    """The plate's face with its holes: of a flange from the front, of a foot from above."""
    mount, bellows, port = design.mount, design.bellows, design.port
    assert mount is not None
    flange = mount.kind == "flange"
    loops = cut(mesh, 0, -mount.thickness / 2) if flange else cut(mesh, 2, mount.thickness / 2)
    x, y, z = mount.hole_places(bellows, port)[-1]
    edge, half = mount.width(bellows, port) / 2, mount.hole_diameter / 2
    radius = 0.2929 * mount.corner_radius
    hole, rim = ((y, z), (edge, z)) if flange else ((x, y), (x, edge))
    dimensions = _hole_and_edge(mount.hole_diameter, mount.edge_distance, hole, rim, flange)
    top = mount.height(port)
    corner = (edge - radius, top - radius) if flange else (-radius, edge - radius)
    across = None if flange else (-mount.length(port), max(3 * half, bellows.root_length))
    callouts = (Callout("mount.fillet", mount.fillet, corner),)
    what = "flange from the front" if flange else "foot from above"
    return View(f"Mount: {what}, {mount.holes} holes", loops, dimensions, callouts, across)


def _hole_and_edge(
    diameter: float,
    distance: float,
    hole: tuple[float, float],
    rim: tuple[float, float],
    flange: bool,
) -> tuple[Dimension, ...]:
    """Across the outermost hole, and from it to the plate's edge."""
    half = diameter / 2
    if flange:
        (y, z), (edge, _) = hole, rim
        return (
            Dimension("mount.hole_diameter", diameter, (y - half, z), (y + half, z), "below"),
            Dimension("mount.edge_distance", distance, (edge - distance, z), (edge, z), "below"),
        )
    (x, y), (_, edge) = hole, rim
    return (
        Dimension("mount.hole_diameter", diameter, (x, y - half), (x, y + half), "left"),
        Dimension("mount.edge_distance", distance, (x, edge - distance), (x, edge), "left"),
    )


def fingertip_view(design: Design, mesh: ClosedMesh) -> View:
    """The pad from the front."""
    pad = design.fingertip
    assert pad is not None
    loops = cut(mesh, 0, design.bellows.length + pad.rib_width / 2)
    half = pad.width / 2
    dimensions = (
        Dimension(
            "fingertip.width",
            pad.width,
            (-half, 0.9 * pad.thickness),
            (half, 0.9 * pad.thickness),
            "below",
        ),
        Dimension(
            "fingertip.thickness", pad.thickness, (half, 0.0), (half, pad.thickness), "right"
        ),
    )
    return View(f"Fingertip from the front, {pad.ribs} ribs", loops, dimensions)
