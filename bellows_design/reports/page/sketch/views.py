"""The views of a design's part: which sections, and which parameter is shown in which."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.page.sketch.cut import Loop, cut
from bellows_design.reports.page.sketch.dimension import Callout, Dimension, Side, View
from bellows_design.reports.page.sketch.features import fingertip_view, mount_view

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.geometry.tessellation import ClosedMesh

INSET = 1 - math.sqrt(0.5)
"""Of a radius: from the corner's sides to the middle of its round."""

HIGH = 0.7
"""Of a bubble's height: where its walls are straight, whatever the fillets."""


def views(design: Design, mesh: ClosedMesh) -> tuple[View, ...]:
    """Side, detail of a bubble, sections through bubble and tendon, mount and fingertip."""
    lengthwise = cut(mesh, 1, 0.0)
    found = [
        _side(design, lengthwise),
        _detail(design, lengthwise),
        _bubble(design, cut(mesh, 0, design.bellows.bubble_middles[_shown(design)])),
        _tendon(design, cut(mesh, 0, _between(design))),
    ]
    found += [] if design.mount is None else [mount_view(design, mesh)]
    found += [] if design.fingertip is None else [fingertip_view(design, mesh)]
    return tuple(found)


def _shown(design: Design) -> int:
    """Number of the bubble whose details are shown: in the middle, with another behind it."""
    return max(0, design.bellows.bubble_count // 2 - 1)


def _between(design: Design) -> float:
    """x of a place between bubbles, or of one within the root, mm."""
    bellows = design.bellows
    if bellows.bubble_count > 1:
        return bellows.bubble_middles[_shown(design)] + bellows.pitch / 2
    return (bellows.tendon_thickness + bellows.root_length) / 2


def _side(design: Design, loops: tuple[Loop, ...]) -> View:
    count = design.bellows.bubble_count
    bubbles = f"{count} bubble{'s' if count > 1 else ''}"
    title = f"Side, section through the middle: {bubbles}"
    return View(title, loops, tuple(_of_side(design)))


def _of_side(design: Design) -> Iterator[Dimension]:
    bellows, port = design.bellows, design.port
    socket = port.axis_height + port.tube_diameter / 2
    root = (0.0, socket)
    up = HIGH * bellows.bubble_height
    built = bellows.root_length
    note = "" if abs(built - bellows.offset) < 1e-9 else f", built {built:.4g}"
    yield Dimension("offset", bellows.offset, root, (built, up), "above", note)
    yield Dimension("length", bellows.length, root, (bellows.length, _face(design)), "below")
    mouth = -port.depth
    yield Dimension("port.depth", port.depth, (mouth, socket), root, "below")
    low = port.axis_height - port.tube_diameter / 2
    yield _upright("port.tube_diameter", port.tube_diameter, mouth, low, "left")
    yield _upright("port.wall", port.wall, mouth, 0.0, "left")
    last, height = bellows.bubble_middles[-1], bellows.bubble_height
    foot = (last - bellows.bubble_length / 2, 0.0)
    yield Dimension("bubble_height", height, foot, (last, height), "right")
    if design.fingertip is not None:
        pad, tip = design.fingertip, bellows.length
        yield _level("fingertip.length", pad.length, tip, pad.thickness, "below")
        yield _upright("fingertip.thickness", pad.thickness, tip + pad.length, 0.0)
        if pad.ribs:
            beside = tip + pad.rib_width + pad.groove_width / 2
            rib = beside + pad.groove_width / 2
            yield _level("fingertip.rib_width", pad.rib_width, rib, pad.rib_height / 2, "below")
            foot, roof = (tip + pad.rib_width, 0.0), (beside, pad.rib_height)
            yield Dimension("fingertip.rib_height", pad.rib_height, foot, roof, "right")
    if design.mount is not None and design.mount.kind == "flange":
        top = design.mount.height(port)
        yield _level(
            "mount.thickness", design.mount.thickness, -design.mount.thickness, top, "above"
        )


def _face(design: Design) -> float:
    """Height of a place of the tip's face that no fingertip hides, mm."""
    height, pad = design.bellows.tendon_height, design.fingertip
    return height / 2 if pad is None else (height + pad.thickness) / 2


def _detail(design: Design, loops: tuple[Loop, ...]) -> View:
    bellows, shown = design.bellows, _shown(design)
    first, last = bellows.bubble_middles[shown], bellows.bubble_middles[shown]
    if bellows.bubble_count > 1:
        last = bellows.bubble_middles[shown + 1]
    half = bellows.pitch / 2 + bellows.bubble_distance / 2
    inside = max(first - half, 0.0), min(last + half, design.finger_length)
    dimensions = tuple(_of_detail(design, first, last))
    callouts = tuple(_radii(design, last))
    return View("Section of the bubbles, enlarged", loops, dimensions, callouts, inside)


def _of_detail(design: Design, first: float, last: float) -> Iterator[Dimension]:
    bellows, indent = design.bellows, design.indent
    up, start = HIGH * bellows.bubble_height, first - bellows.bubble_length / 2
    wall = bellows.bubble_thickness
    yield _level("bubble_thickness", wall, start, up, "above")
    yield _level("chamber_length", bellows.chamber_length, start + wall, up, "above")
    if last > first:
        gap = start + bellows.bubble_length
        yield _level("bubble_distance", bellows.bubble_distance, gap, up, "above")
    between = (first + bellows.pitch / 2) if last > first else design.bellows.tendon_thickness
    yield _upright("tendon_thickness", bellows.tendon_thickness, between, 0.0, "left")
    yield _upright("tendon_height", bellows.tendon_height, between, 0.0, "left")
    if indent is None:
        return
    edge, deep = (0.0, indent.depth) if indent.side == "outside" else (wall, wall - indent.depth)
    side = indent.width / 2
    yield _level("indent.width", indent.width, last - side, edge, "below")
    yield Dimension("indent.depth", indent.depth, (first - side, edge), (first, deep), "left")


def _radii(design: Design, middle: float) -> Iterator[Callout]:
    bellows, indent = design.bellows, design.indent
    half, radius = bellows.bubble_length / 2, bellows.bubble_fillet
    corner = (middle + half - INSET * radius, bellows.bubble_height - INSET * radius)
    yield Callout("outer_fillet", bellows.outer_fillet, corner)
    half, radius = bellows.chamber_length / 2, bellows.chamber_fillet
    top = bellows.bubble_height - bellows.bubble_thickness
    yield Callout(
        "inner_fillet", bellows.inner_fillet, (middle + half - INSET * radius, top - INSET * radius)
    )
    if indent is not None and indent.shape == "rectangular":
        inside = indent.side == "inside"
        level = bellows.bubble_thickness - indent.depth if inside else indent.depth
        up = INSET * indent.fillet * (1 if inside else -1)
        right = middle + indent.width / 2 - INSET * indent.fillet
        yield Callout("indent.fillet", indent.fillet, (right, level + up))


def _bubble(design: Design, loops: tuple[Loop, ...]) -> View:
    """Front: through a chamber, within the room of the limits."""
    bellows, limits = design.bellows, design.limits
    left, up = -bellows.bubble_width / 2, HIGH * bellows.bubble_height
    room = limits.cross_section_width / 2
    frame = (-room, 0.0, room, limits.cross_section_height)
    dimensions = (
        _level("bubble_width", bellows.bubble_width, left, up, "below"),
        _level("bubble_thickness", bellows.bubble_thickness, left, up, "below"),
        _level("limits.cross_section_width", 2 * room, -room, limits.cross_section_height, "above"),
        _upright("limits.cross_section_height", limits.cross_section_height, room, 0.0),
    )
    return View("Front, section through a bubble", loops, dimensions, frame=frame)


def _tendon(design: Design, loops: tuple[Loop, ...]) -> View:
    bellows = design.bellows
    left, wall, height = -bellows.tendon_width / 2, bellows.tendon_thickness, bellows.tendon_height
    where = "between bubbles" if bellows.bubble_count > 1 else "at the root"
    dimensions = (
        _level("tendon_width", bellows.tendon_width, left, height / 2, "below"),
        _level("tendon_thickness", wall, left, height / 2, "above"),
        _upright("tendon_height", height, 0.0, 0.0, "right"),
    )
    return View(f"Front, section through the tendon {where}", loops, dimensions)


def _level(name: str, value: float, start: float, height: float, side: Side) -> Dimension:
    """A length along the horizontal from ``start``."""
    return Dimension(name, value, (start, height), (start + value, height), side)


def _upright(name: str, value: float, across: float, low: float, side: Side = "right") -> Dimension:
    """A height above ``low``."""
    return Dimension(name, value, (across, low), (across, low + value), side)
