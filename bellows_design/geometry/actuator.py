"""Parameters to CAD solids: the part as printed, and the bodies that are analysed.

Everything is solids added and subtracted; nothing is shelled or filleted afterwards. Chambers and
channel are rounded on all their edges before they are joined, so every loaded re-entrant edge of
the part, the junction of chamber and channel included, carries the inner fillet.
"""

from __future__ import annotations

import itertools
import math
from contextlib import suppress

import cadquery as cq

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.design.features.mount import Mount
from bellows_design.design.indent import Indent
from bellows_design.design.lengths import FULL_ROUND_SNAP, SMALLEST_FEATURE, snapped_radius
from bellows_design.design.port import Port
from bellows_design.geometry.channel_ends import CHANNEL_ENDS
from bellows_design.geometry.face_names import (
    BUBBLE_MIDDLE,
    CAVITY,
    GAP_MIDDLE,
    OUTSIDE,
    PORT,
    ROOT,
    SYMMETRY,
    TIP,
)
from bellows_design.geometry.fingertip import fingertip_pad
from bellows_design.geometry.mount import mount_plate
from bellows_design.geometry.named_solids import (
    BEYOND,
    GeometryError,
    NamedSolid,
    box,
    cut,
    fused,
    named,
    prism,
    rounded_box,
)

LOOSEST = 0.02
"""mm. A solid whose faces meet less exactly has no mesh that keeps the tolerance of an STL."""


def printed_part(
    bellows: BellowsParameters,
    indent: Indent | None,
    port: Port,
    mount: Mount | None = None,
    fingertip: Fingertip | None = None,
) -> NamedSolid:
    """Solid as printed: closed tip, socket for the tube at the root.

    Args:
        bellows: The twelve numbers, mm.
        indent: Groove under every chamber, mm; None without one.
        port: Socket for the tube, mm.
        mount: Plate with screw holes at the root, mm; None without one.
        fingertip: Pad beyond the tip, mm; None without one.

    Returns:
        The solid, mm, with the faces ``cavity``, ``outside``, ``root``, ``tip``, ``port`` (the
        socket and its mouth) and ``mount`` (its plate, where that is no part of another face).

    Raises:
        DesignError: indent, port, mount or fingertip do not fit the bellows.
        GeometryError: the CAD kernel failed.

    Examples:
        >>> from bellows_design.design import load_design
        >>> from bellows_design.geometry import printed_part
        >>> design = load_design("prototype_1")
        >>> part = printed_part(design.bellows, design.indent, design.port)
        >>> print(sorted(set(part.face_names)), part.solid.isValid())
        ['cavity', 'outside', 'port', 'root', 'tip'] True
    """
    port.check_fits(bellows)
    body = fused(_outer(bellows, indent, fingertip), _port_boss(bellows, port))
    if mount is not None:
        mount.check_fits(bellows, port)
        body = fused(body, mount_plate(mount, bellows, port))
    return cut(body, _cavity(bellows, indent), *_port_bore(bellows, port))


def half_body(
    bellows: BellowsParameters, indent: Indent | None, fingertip: Fingertip | None = None
) -> NamedSolid:
    """Half y >= 0 of the actuator with its cavity closed (no port), for analysis.

    Args:
        bellows: The twelve numbers, mm.
        indent: Groove under every chamber, mm; None without one.
        fingertip: Pad beyond the tip, mm; None without one.

    Returns:
        The solid, mm, with the faces ``cavity``, ``outside``, ``root`` (x = 0), ``tip`` (the end of
        the tendon, or of the fingertip) and ``symmetry`` (y = 0).

    Raises:
        DesignError: Indent or fingertip do not fit the bellows.
        GeometryError: The CAD kernel failed.

    Examples:
        >>> from bellows_design.design import load_design
        >>> from bellows_design.geometry import full_body, half_body
        >>> design = load_design("prototype_1")
        >>> half, full = (of(design.bellows, design.indent).solid for of in (half_body, full_body))
        >>> print(f"{half.Volume() / full.Volume():.3f}")
        0.500
    """
    end = bellows.length + (0.0 if fingertip is None else fingertip.length)
    other_half = box(
        (-BEYOND, -bellows.bubble_width, -BEYOND),
        (end + BEYOND, 0, bellows.bubble_height + BEYOND),
    )
    return cut(full_body(bellows, indent, fingertip), named(other_half, SYMMETRY))


def unit_cell(bellows: BellowsParameters, indent: Indent | None) -> NamedSolid:
    """Half of a bubble, half of its width: what repeats in the middle of the actuator.

    From the middle of a bubble at x = 0 to the middle of the gap at x = pitch / 2, y >= 0.

    Args:
        bellows: The twelve numbers, mm.
        indent: Groove under every chamber, mm; None without one.

    Returns:
        The solid, mm, with the faces ``cavity``, ``outside``, ``bubble_middle``, ``gap_middle`` and
        ``symmetry``.

    Raises:
        DesignError: Indent does not fit the bellows.
        GeometryError: The CAD kernel failed.

    Examples:
        >>> from bellows_design.design import load_design
        >>> from bellows_design.geometry import unit_cell
        >>> bellows = load_design("prototype_1").bellows
        >>> cell = unit_cell(bellows, None)
        >>> print(f"{cell.solid.BoundingBox().xlen - bellows.pitch / 2:.6f} mm from half a pitch")
        0.000000 mm from half a pitch
    """
    width, height, end = bellows.bubble_width, bellows.bubble_height, bellows.pitch / 2
    body = cut(_cell_outside(bellows, indent), _cell_cavity(bellows, indent))
    other_half = box((-2 * end, -width, -BEYOND), (2 * end, 0, height + BEYOND))
    before = box((-2 * end, -width, -BEYOND), (0, width, height + BEYOND))
    return cut(body, named(other_half, SYMMETRY), named(before, BUBBLE_MIDDLE))


def _cell_outside(bellows: BellowsParameters, indent: Indent | None) -> NamedSolid:
    """Outside of one bubble at x = 0 with the tendon from gap middle to gap middle."""
    half, end = bellows.tendon_width / 2, bellows.pitch / 2
    tendon = named(box((-end, -half, 0), (end, half, bellows.tendon_height)), OUTSIDE)
    outer = fused(tendon.renamed(_section_name), named(_bubble(bellows), OUTSIDE))
    if indent is None or indent.side == "inside":
        return outer
    indent.check_fits(bellows)
    return cut(outer, named(_outside_groove(indent, bellows.bubble_width / 2 + BEYOND), OUTSIDE))


def _cell_cavity(bellows: BellowsParameters, indent: Indent | None) -> NamedSolid:
    """Air in one bubble at x = 0, and in the channel beyond its gap's middles."""
    half, wall, radius = bellows.channel_width / 2, bellows.tendon_thickness, bellows.channel_fillet
    end = bellows.pitch / 2 + radius + BEYOND
    channel = rounded_box((-end, -half, wall), (end, half, bellows.tendon_height - wall), radius)
    cavity = fused(named(channel, CAVITY), named(_chamber(bellows), CAVITY))
    if indent is None or indent.side == "outside":
        return cavity
    indent.check_fits(bellows)
    return fused(cavity, named(_inside_groove(bellows, indent), CAVITY))


def _section_name(face: cq.Face, own: str) -> str:
    """Name of a face of the cell's tendon: its ends are middles of gaps."""
    return GAP_MIDDLE if abs(face.normalAt().x) > 0.5 else own


def full_body(
    bellows: BellowsParameters, indent: Indent | None, fingertip: Fingertip | None = None
) -> NamedSolid:
    """The whole actuator with its cavity closed (no port), for analysis.

    Args:
        bellows: The twelve numbers, mm.
        indent: Groove under every chamber, mm; None without one.
        fingertip: Pad beyond the tip, mm; None without one.

    Returns:
        The solid, mm, with the faces ``cavity``, ``outside``, ``root`` (x = 0) and ``tip`` (the end
        of the tendon, or of the fingertip).

    Raises:
        DesignError: Indent or fingertip do not fit the bellows.
        GeometryError: The CAD kernel failed.

    Examples:
        >>> from bellows_design.design import load_design
        >>> from bellows_design.geometry import full_body
        >>> design = load_design("prototype_1")
        >>> body = full_body(design.bellows, design.indent)
        >>> print(sorted(set(body.face_names)), f"{body.solid.Volume() / 1000:.1f} cm³")
        ['cavity', 'outside', 'root', 'tip'] 9.9 cm³
    """
    return cut(_outer(bellows, indent, fingertip), _cavity(bellows, indent))


def _outer(
    bellows: BellowsParameters, indent: Indent | None, fingertip: Fingertip | None
) -> NamedSolid:
    parts = [_tendon(bellows), *_repeated(_bubble(bellows), bellows, OUTSIDE)]
    if fingertip is not None:
        fingertip.check_fits(bellows)
        tendon = parts[0].renamed(lambda _, own: OUTSIDE if own == TIP else own)
        parts = [tendon, *parts[1:], fingertip_pad(fingertip, bellows)]
    outer = fused(*parts)
    if indent is None or indent.side == "inside":
        return outer
    indent.check_fits(bellows)
    groove = _outside_groove(indent, bellows.bubble_width / 2 + BEYOND)
    return cut(outer, *_repeated(groove, bellows, OUTSIDE))


def _tendon(bellows: BellowsParameters) -> NamedSolid:
    half = bellows.tendon_width / 2
    solid = box((0, -half, 0), (bellows.length, half, bellows.tendon_height))
    return named(solid, OUTSIDE).renamed(_end_name)


def _end_name(face: cq.Face, own: str) -> str:
    """Name of a face of the tendon's box: its two ends are root and tip."""
    along = face.normalAt().x
    return ROOT if along < -0.5 else TIP if along > 0.5 else own


def _bubble(bellows: BellowsParameters) -> cq.Solid:
    """A bubble about x = 0, rounded on all edges but those it stands on: flat on the print bed.

    Rounding these too would leave an overhang that starts at the bed, and a cusp where the round
    touches the tendon's flat bottom; it moves the angle by less than 0.5 % for Prototype 1.
    """
    length, width, height = bellows.bubble_size
    below = bellows.bubble_fillet + BEYOND
    lower, upper = (-length / 2, -width / 2, -below), (length / 2, width / 2, height)
    rounded = named(rounded_box(lower, upper, bellows.bubble_fillet), OUTSIDE)
    under = box((-length, -width, -2 * below), (length, width, 0))
    return cut(rounded, named(under, OUTSIDE)).solid


def _cavity(bellows: BellowsParameters, indent: Indent | None) -> NamedSolid:
    """All the air inside as one solid: the chambers and the channel that joins them.

    Where a fillet is a hair short of a full round, the channel's end may touch several faces of
    the last chamber within a few µm, which the CAD kernel joins badly or not at all. The end may
    lie elsewhere, so others are tried then.
    """
    for end in CHANNEL_ENDS:
        with suppress(GeometryError):
            cavity = _cavity_to(bellows, indent, end)
            if cavity.looseness <= LOOSEST:
                return cavity
    raise GeometryError(
        "the CAD kernel cannot join the chambers and the air channel of this design; change "
        f"inner_fillet = {bellows.inner_fillet:g} mm to {_smaller(bellows.inner_fillet):g} mm"
    )


def _smaller(fillet: float) -> float:
    """An admissible fillet 0.1 mm below ``fillet``, or none."""
    return fillet - 0.1 if fillet - 0.1 >= FULL_ROUND_SNAP else 0.0


def _cavity_to(bellows: BellowsParameters, indent: Indent | None, end: float) -> NamedSolid:
    """The cavity with a channel that ends so many of its fillets past the last chamber's middle."""
    chambers = _repeated(_chamber(bellows), bellows, CAVITY)
    cavity = fused(_channel(bellows, end), *chambers)
    if indent is None or indent.side == "outside":
        return cavity
    indent.check_fits(bellows)
    return fused(cavity, *_repeated(_inside_groove(bellows, indent), bellows, CAVITY))


def _chamber(bellows: BellowsParameters) -> cq.Solid:
    """The air in a bubble about x = 0."""
    length, width, height = bellows.chamber_size
    floor = bellows.bubble_thickness
    lower, upper = (-length / 2, -width / 2, floor), (length / 2, width / 2, floor + height)
    return rounded_box(lower, upper, bellows.chamber_fillet)


def _channel(bellows: BellowsParameters, end: float) -> NamedSolid:
    """Air channel, from its wall at the root to ``end`` fillets past the last chamber's middle.

    Ending inside the chamber leaves that bubble's end wall whole: the tip is closed. A channel no
    deeper than the chamber's floor ends in mid-air, so its end needs no rounding.
    """
    half, wall = bellows.channel_width / 2, bellows.tendon_thickness
    radius, last = bellows.channel_fillet, bellows.bubble_middles[-1]
    lower, upper = (wall, -half, wall), (last + end * radius, half, bellows.tendon_height - wall)
    if wall < bellows.bubble_thickness:
        return named(rounded_box(lower, upper, radius), CAVITY)
    longer = rounded_box(lower, (upper[0] + BEYOND + radius, *upper[1:]), radius)
    return cut(named(longer, CAVITY), named(_half_space_beyond(last, bellows), CAVITY))


def _half_space_beyond(x: float, bellows: BellowsParameters) -> cq.Solid:
    """Everything of the actuator's neighbourhood beyond ``x``, mm."""
    width, height = bellows.bubble_width, bellows.bubble_height
    return box((x, -width, -height), (x + bellows.length, width, 2 * height))


def _repeated(solid: cq.Solid, bellows: BellowsParameters, name: str) -> list[NamedSolid]:
    """``solid`` (built about x = 0) at the middle of every bubble."""
    places = (cq.Location(cq.Vector(x, 0, 0)) for x in bellows.bubble_middles)
    return [named(solid.moved(place), name) for place in places]


def _outside_groove(indent: Indent, half: float) -> cq.Solid:
    """What an outside indent takes from the bottom, about x = 0, from y = -half to half (mm)."""
    edges = _arc_profile(indent) if indent.shape == "arc" else _rectangle_profile(indent)
    return prism(cq.Wire.assembleEdges(edges), -half, half)


def _segments(*points: tuple[float, float]) -> list[cq.Edge]:
    """Straight edges from point to point (x, z) in the plane y = 0."""
    corners = [cq.Vector(x, 0, z) for x, z in points]
    return [cq.Edge.makeLine(a, b) for a, b in itertools.pairwise(corners)]


def _bend(*points: tuple[float, float]) -> cq.Edge:
    """Circular edge through three points (x, z) in the plane y = 0."""
    return cq.Edge.makeThreePointArc(*(cq.Vector(x, 0, z) for x, z in points))


def _arc_profile(indent: Indent) -> list[cq.Edge]:
    half = indent.width / 2
    below = _segments((half, 0), (half, -BEYOND), (-half, -BEYOND), (-half, 0))
    return [_bend((-half, 0), (0, indent.depth), (half, 0)), *below]


def _rectangle_profile(indent: Indent) -> list[cq.Edge]:
    half, top, r = indent.width / 2, indent.depth, indent.fillet
    if r == 0:
        return _segments(
            (-half, -BEYOND), (-half, top), (half, top), (half, -BEYOND), (-half, -BEYOND)
        )
    inset = r * (1 - math.sqrt(0.5))
    left = _bend((-half, top - r), (-half + inset, top - inset), (-half + r, top))
    right = _bend((half - r, top), (half - inset, top - inset), (half, top - r))
    roof = _segments((-half + r, top), (half - r, top)) if half - r > 1e-9 else []
    below = _segments((half, top - r), (half, -BEYOND), (-half, -BEYOND), (-half, top - r))
    return [left, *roof, right, *below]


def _inside_groove(bellows: BellowsParameters, indent: Indent) -> cq.Solid:
    """What an inside indent takes from the chamber's floor, about x = 0."""
    x, y, z = indent.inside_size(bellows)
    bottom = bellows.bubble_thickness - indent.depth
    radius = snapped_radius(indent.fillet, min(x, y, z) / 2)
    return rounded_box((-x / 2, -y / 2, bottom), (x / 2, y / 2, bottom + z), radius)


def _port_boss(bellows: BellowsParameters, port: Port) -> NamedSolid:
    """Outside of the socket: round above, flat-sided below so that it stands on the bed.

    It reaches past the root's face by its wall, which keeps that wall around the socket's end;
    where that would leave less than a line's gap, it joins the first bubble.
    """
    reach = port.wall
    if bellows.root_length - reach < SMALLEST_FEATURE:
        reach = bellows.root_length + bellows.bubble_thickness / 2
    radius, axis = port.radius, port.axis_height
    round_part = _cylinder_x(radius, axis, -port.depth, reach)
    foot = box((-port.depth, -radius, 0), (reach, radius, axis))
    return fused(named(round_part, OUTSIDE), named(foot, OUTSIDE))


def _port_bore(bellows: BellowsParameters, port: Port) -> tuple[NamedSolid, NamedSolid]:
    """The socket down to the root's face, and the hole that leads on into the channel."""
    socket = _cylinder_x(port.tube_diameter / 2, port.axis_height, -port.depth - BEYOND, 0)
    inward = bellows.tendon_thickness + bellows.channel_fillet + SMALLEST_FEATURE
    hole = _cylinder_x(port.hole_radius(bellows), port.hole_height(bellows), -BEYOND / 2, inward)
    return named(socket, PORT), named(hole, CAVITY)


def _cylinder_x(radius: float, height: float, start: float, stop: float) -> cq.Solid:
    """Cylinder about the line y = 0, z = ``height``, from x = ``start`` to ``stop``, mm."""
    base = cq.Vector(start, 0, height)
    return cq.Solid.makeCylinder(radius, stop - start, base, cq.Vector(1, 0, 0))
