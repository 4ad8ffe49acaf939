"""The solid of a fingertip: a pad beyond the tip, with ribs across its lower side."""

from __future__ import annotations

import cadquery as cq

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.geometry.face_names import OUTSIDE, TIP
from bellows_design.geometry.named_solids import BEYOND, NamedSolid, box, cut, named


def fingertip_pad(fingertip: Fingertip, bellows: BellowsParameters) -> NamedSolid:
    """The pad; its end is ``tip``, all other faces are ``outside``."""
    start, half = bellows.length, fingertip.width / 2
    upper = (start + fingertip.length, half, fingertip.thickness)
    pad = named(box((start, -half, 0), upper), OUTSIDE).renamed(_end_name)
    return cut(pad, *(named(groove, OUTSIDE) for groove in _grooves(fingertip, start, half)))


def _end_name(face: cq.Face, own: str) -> str:
    return TIP if face.normalAt().x > 0.5 else own


def _grooves(fingertip: Fingertip, start: float, half: float) -> list[cq.Solid]:
    """What the grooves between the ribs take from the pad, which begins at ``start``."""
    across = half + BEYOND
    return [
        box(
            (start + x, -across, -BEYOND),
            (start + x + fingertip.groove_width, across, fingertip.rib_height),
        )
        for x in fingertip.grooves
    ]
