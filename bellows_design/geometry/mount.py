"""The solid of a mount: a plate with screw holes at the root."""

from __future__ import annotations

from collections.abc import Sequence

import cadquery as cq

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.features.mount import Mount
from bellows_design.design.port import Port
from bellows_design.geometry.face_names import MOUNT
from bellows_design.geometry.named_solids import BEYOND, NamedSolid, Point, box, cut, named


def mount_plate(mount: Mount, bellows: BellowsParameters, port: Port) -> NamedSolid:
    """The plate with its holes; all faces ``mount``. A foot leaves the way to the socket free."""
    plate = named(_slab(mount, bellows, port), MOUNT)
    tools = [_hole(mount, place) for place in mount.hole_places(bellows, port)]
    if mount.kind == "foot" and mount.length(port) > port.depth:
        tools.append(_way_to_the_socket(mount, port))
    return cut(plate, *(named(tool, MOUNT) for tool in tools))


def _slab(mount: Mount, bellows: BellowsParameters, port: Port) -> cq.Solid:
    """The plate with rounded corners: four of a foot, of a flange the two above the bed."""
    half, length, height = mount.width(bellows, port) / 2, mount.length(port), mount.height(port)
    if mount.kind == "foot":
        flat = [(0.0, half), (-length, half), (-length, -half), (0.0, -half)]
        return _extruded([(x, y, 0.0) for x, y in flat], 4, mount.corner_radius, (0.0, 0.0, height))
    upright = [(-half, height), (half, height), (half, 0.0), (-half, 0.0)]
    return _extruded([(0.0, y, z) for y, z in upright], 2, mount.corner_radius, (-length, 0.0, 0.0))


def _extruded(corners: Sequence[Point], rounded: int, radius: float, along: Point) -> cq.Solid:
    """Prism over a polygon whose first corners, so many, are rounded by ``radius``, mm."""
    points = [cq.Vector(*corner) for corner in corners]
    outline = cq.Wire.makePolygon(points, close=True)
    if radius > 0:
        chosen = [vertex for vertex in outline.Vertices() if vertex.Center() in points[:rounded]]
        outline = outline.fillet2D(radius, chosen)
    return cq.Solid.extrudeLinear(outline, [], cq.Vector(*along))


def _hole(mount: Mount, place: Point) -> cq.Solid:
    """What a screw hole takes from the plate."""
    along = cq.Vector(0, 0, 1) if mount.kind == "foot" else cq.Vector(-1, 0, 0)
    start = cq.Vector(*place) - along * BEYOND
    return cq.Solid.makeCylinder(
        mount.hole_diameter / 2, mount.thickness + 2 * BEYOND, start, along
    )


def _way_to_the_socket(mount: Mount, port: Port) -> cq.Solid:
    """What a foot that is longer than the boss leaves free for the tube."""
    lower = (-mount.length(port) - BEYOND, -port.radius, -BEYOND)
    return box(lower, (-port.depth, port.radius, mount.thickness + BEYOND))
