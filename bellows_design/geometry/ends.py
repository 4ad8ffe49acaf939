"""The rigid ends of a finger beyond its outermost gaps' middles, for chains of half bubbles.

A chain goes from bubble to bubble by halves: before the first half bubble and behind the last one
lies half a gap of tendon with what follows it. Known without the CAD kernel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from bellows_design.design.design import Design


@dataclass(frozen=True)
class TipStub:
    """What lies beyond the middle of the gap behind the last bubble, full width.

    Attributes:
        length: from there to the finger's end, its pad included, mm. Negative, by half a gap at
            most, where the last bubble ends the finger.
        height: of its end's face, mm: the fingertip's thickness, or the tendon's height.
        lower_edge: x from there and z of the end's lower edge, which grips, mm.
        volume: of its material, mm³.
        centroid: x from there and z of its centre of volume, mm.
    """

    length: float
    height: float
    lower_edge: tuple[float, float]
    volume: float
    centroid: tuple[float, float]


def root_length(design: Design) -> float:
    """From the root's face to the middle of the gap before the first bubble, mm.

    Negative, by less than half a gap, where the root is shorter than that.
    """
    bellows = design.bellows
    return bellows.first_gap_middle


def tip_length(design: Design) -> float:
    """From the middle of the gap behind the last bubble to the finger's end, mm."""
    bellows = design.bellows
    return design.finger_length - (bellows.bubble_middles[-1] + bellows.pitch / 2)


def tip_stub(design: Design) -> TipStub:
    """The stub at the tip: solid tendon, and the pad."""
    length, pad, parts = tip_length(design), design.fingertip, list(_parts(design))
    height = design.bellows.tendon_height if pad is None else pad.thickness
    volume = sum(part for part, _, _ in parts)
    x = sum(part * along for part, along, _ in parts) / volume if volume else 0.0
    z = sum(part * above for part, _, above in parts) / volume if volume else 0.0
    return TipStub(length, height, (length, 0.0), volume, (x, z))


def _parts(design: Design) -> Iterator[tuple[float, float, float]]:
    """Volume (mm³), x and z of the centre of volume (mm) of what the tip's stub consists of."""
    bellows, pad = design.bellows, design.fingertip
    tendon = tip_length(design) - (0.0 if pad is None else pad.length)
    section = bellows.tendon_width * bellows.tendon_height
    yield section * max(0.0, tendon), tendon / 2, bellows.tendon_height / 2
    if pad is not None:
        x, z = pad.centroid
        yield pad.volume, tendon + x, z
