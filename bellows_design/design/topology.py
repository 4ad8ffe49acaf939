"""Which faces the body of a design has, told by signs of a few lengths.

Faces appear and vanish where an edge of one box or fillet passes one of another: where the length
between them changes its sign. Two designs with the same signs have the same faces.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.design.indent import Indent
from bellows_design.design.lengths import SMALLEST_FEATURE, snapped_radius

NOTHING = 1e-9
"""mm. Lengths shorter than this are zero but for rounding."""

CHAMBER_FILLET, CHANNEL_FILLET = "the chamber's fillet", "the channel's fillet"
INNER_DEPTH = "the indent's depth beyond its fillet"
FLOORS = "the channel's floor above the chamber's"
FILLETS_AT_THE_FLOORS = "the top of the channel's lower fillet above that of the chamber's"
LEVEL = (FLOORS, FILLETS_AT_THE_FLOORS)
"""Lengths that may leave zero: floors that are level keep their faces when one is moved a little,
but for a step lower than the elements beside it, which runs through these."""


def same_topology(own: Design, other: Design, model: str = "full") -> str:
    """Why the body of ``other`` has not the faces of ``own``, so that no mesh fits both; or ''.

    Of a ``unit-cell`` the faces at root and tip are left out; the number of bubbles never is.
    """
    for what, here, there in (
        ("bubbles", own.bellows.bubble_count, other.bellows.bubble_count),
        ("indent", _kind(own.indent), _kind(other.indent)),
        ("ribs of the fingertip", *(_ribs(each, model) for each in (own, other))),
    ):
        if here != there:
            return f"{what}: {there} instead of {here}"
    before, after = signature(own, model), signature(other, model)
    changes = (_change(n, before, after) for n in before if _differs(n, before, after))
    return next(changes, "")


def signature(design: Design, model: str = "full") -> dict[str, float]:
    """The lengths whose signs tell the faces, mm, each by what it is."""
    bellows, indent = design.bellows, design.indent
    lengths = dict(_rounds(bellows)) | dict(_outside(bellows)) | dict(_inside(bellows))
    if model != "unit-cell":
        lengths |= dict(_ends(bellows))
        if design.fingertip is not None:
            lengths |= dict(_at_the_fingertip(bellows, design.fingertip))
    if indent is not None:
        groove = _outer_groove if indent.side == "outside" else _inner_groove
        lengths |= dict(groove(bellows, indent))
    return lengths


def _kind(indent: Indent | None) -> str:
    return "none" if indent is None else f"{indent.side} {indent.shape}"


def _ribs(design: Design, model: str) -> str:
    if model == "unit-cell":
        return ""
    return "no fingertip" if design.fingertip is None else str(design.fingertip.ribs)


def _sign(length: float) -> int:
    return 0 if abs(length) < NOTHING else 1 if length > 0 else -1


def _differs(name: str, before: Mapping[str, float], after: Mapping[str, float]) -> bool:
    if name not in after:  # a length that is told by the sign of another one
        return False
    sign = _sign(before[name])
    return sign != _sign(after[name]) and not (sign == 0 and name in _may_leave_zero(before))


def _may_leave_zero(lengths: Mapping[str, float]) -> tuple[str, ...]:
    """Steps between level floors are followed where fillets smooth them and no indent cuts them."""
    rounded = all(_sign(lengths[name]) > 0 for name in (CHAMBER_FILLET, CHANNEL_FILLET))
    return LEVEL if rounded and INNER_DEPTH not in lengths else ()


def _change(name: str, before: Mapping[str, float], after: Mapping[str, float]) -> str:
    return f"{name}: {after[name] + 0.0:.4g} mm instead of {before[name] + 0.0:.4g} mm"


def _rounds(p: BellowsParameters) -> Iterator[tuple[str, float]]:
    """Fillets, and the flats between them."""
    r, q, outer = p.chamber_fillet, p.channel_fillet, p.bubble_fillet
    yield CHAMBER_FILLET, r
    yield CHANNEL_FILLET, q
    yield "the bubble's fillet", outer
    for axis, size in zip("xyz", p.chamber_size, strict=True):
        yield f"flat between the chamber's fillets along {axis}", size / 2 - r
    yield "flat between the channel's fillets along y", p.channel_width / 2 - q
    yield "flat between the channel's fillets along z", p.channel_height / 2 - q
    for axis, size in zip("xy", p.bubble_size, strict=False):
        yield f"flat between the bubble's fillets along {axis}", size / 2 - outer


def _outside(p: BellowsParameters) -> Iterator[tuple[str, float]]:
    """Where the tendon meets the bubble."""
    half, outer = p.tendon_width / 2, p.bubble_fillet
    across, up = half - (p.bubble_width / 2 - outer), p.tendon_height - (p.bubble_height - outer)
    yield "the tendon's side inside of the bubble's", p.bubble_width / 2 - half
    yield "the tendon's side beyond the start of the bubble's fillet", across
    yield "the tendon's top beyond the start of the bubble's fillet", up
    beyond = math.hypot(max(across, 0.0), max(up, 0.0)) - outer
    yield "the tendon's edge beyond the bubble's fillet", beyond if up > 0 else -1.0


def _inside(p: BellowsParameters) -> Iterator[tuple[str, float]]:
    """Where the channel opens into the chamber."""
    r, q, floor, wall = p.chamber_fillet, p.channel_fillet, p.bubble_thickness, p.tendon_thickness
    yield FLOORS, wall - floor
    yield "the channel's floor above the chamber's lower fillet", wall - floor - r
    yield "the channel's lower fillet above the chamber's floor", wall + q - floor
    yield FILLETS_AT_THE_FLOORS, wall + q - floor - r
    below_roof = (p.bubble_height - floor - r) - (p.tendon_height - wall)
    yield "the channel's roof below the chamber's upper fillet", below_roof
    yield "the channel's upper fillet below that of the chamber", below_roof + q
    beside = p.chamber_size[1] / 2 - p.channel_width / 2
    yield "the channel's side inside of the chamber's", beside
    yield "the channel's side inside of the chamber's fillet", beside - r
    yield "the channel's fillet inside of the chamber's", beside - r + q
    yield from _channel_in_corners(r, q, beside, wall - floor, below_roof)


def _channel_in_corners(
    r: float, q: float, beside: float, step: float, below_roof: float
) -> Iterator[tuple[str, float]]:
    """The channel's edges beside the chamber's ones, where both are rounded, in the y-z plane.

    ``r`` and ``q`` are the fillets of chamber and channel, ``beside`` the channel's side inside of
    the chamber's, ``step`` its floor above the chamber's, ``below_roof`` its roof below the
    start of the chamber's upper fillet, mm.
    """
    across = r - q - beside  # from the middle of the chamber's fillet to that of the channel's
    lower, upper = r - q - step, -q - below_roof
    if step > NOTHING and across > 0 and lower > 0:
        yield "the channel's lower edge inside of the chamber's", r - q - math.hypot(across, lower)
    if across > 0 and upper > 0:
        yield "the channel's upper edge inside of the chamber's", r - q - math.hypot(across, upper)
    if step < -NOTHING:
        up = min(max(q + step, 0.0), q)
        yield "flat of the chamber's floor beside the channel", -across - math.sqrt(q**2 - up**2)


def _ends(p: BellowsParameters) -> Iterator[tuple[str, float]]:
    """Root and tip of the actuator."""
    yield "the tip beyond the last bubble", p.length - p.root_length - p.train_length
    start = p.root_length + p.bubble_thickness - p.tendon_thickness - p.channel_fillet
    yield "the end of the channel's fillet at the root before the first chamber", start
    yield "the same before that chamber's fillet", start + p.chamber_fillet
    if p.tendon_thickness < p.bubble_thickness:
        beyond = p.chamber_size[0] / 2 - p.channel_fillet / 2
        yield "the channel's end inside of the last chamber", beyond
        yield "the channel's end inside of the last chamber's fillet", beyond - p.chamber_fillet


def _at_the_fingertip(p: BellowsParameters, pad: Fingertip) -> Iterator[tuple[str, float]]:
    """Where the tendon meets the pad."""
    yield "the fingertip's side outside of the tendon's", pad.width / 2 - p.tendon_width / 2
    yield "the fingertip's top above the tendon's", pad.thickness - p.tendon_height


def _outer_groove(p: BellowsParameters, indent: Indent) -> Iterator[tuple[str, float]]:
    half, f, depth, outer = indent.width / 2, indent.fillet, indent.depth, p.bubble_fillet
    length, side = p.bubble_length / 2, p.tendon_width / 2 - (p.bubble_width / 2 - outer)
    yield "the indent inside of the bubble's length", length - half
    yield "the indent inside of the bubble's fillet", length - outer - half
    at_tendon = length - outer + math.sqrt(max(outer**2 - max(side, 0.0) ** 2, 0.0))
    yield "the indent inside of the bubble at the tendon's side", at_tendon - half
    if indent.shape == "arc":
        yield "flat of the indent's side", half - depth
        return
    yield "the indent's fillet", f
    yield "flat of the indent's side", depth - f
    yield "flat of the indent's roof", half - f
    yield "the indent's roof inside of the bubble's fillet", length - outer - half + f
    yield "the indent's roof inside of the bubble at the tendon's side", at_tendon - half + f


def _inner_groove(p: BellowsParameters, indent: Indent) -> Iterator[tuple[str, float]]:
    size = indent.inside_size(p)
    f, r, q = (
        snapped_radius(indent.fillet, min(size) / 2),
        p.chamber_fillet,
        p.channel_fillet,
    )
    yield "the indent's fillet", f
    for axis, extent in zip("xyz", size, strict=True):
        yield f"flat between the indent's fillets along {axis}", extent / 2 - f
    along = p.chamber_length / 2 - size[0] / 2
    yield "the indent inside of the chamber", along
    yield "the indent inside of the chamber's fillet", along - r
    yield "the indent's floor inside of the chamber's fillet", along - r + f
    yield "the chamber's fillet above a line's width", r - SMALLEST_FEATURE
    yield INNER_DEPTH, indent.depth - f
    across = size[1] / 2 - p.channel_width / 2
    yield "the indent's side beyond the channel's", across
    yield "the indent's side beyond the channel's floor", across + q
    yield "the indent's floor beyond the channel's side", across - f
    yield "the indent's floor beyond the channel's floor", across - f + q
    bottom = p.bubble_thickness - indent.depth
    for name, height in (("floor", bottom), ("fillet", bottom + f)):
        yield f"the indent's {name} above the channel's floor", height - p.tendon_thickness
        yield f"the indent's {name} above the channel's fillet", height - p.tendon_thickness - q
