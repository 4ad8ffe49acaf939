"""Weights of a finger's pieces and stubs, from the boxes it is made of; fillets are left out."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.geometry.ends import root_length, tip_stub

GRAVITY = 9.80665
"""Standard acceleration of free fall, m/s²."""


@dataclass(frozen=True)
class Weight:
    """A weight.

    Attributes:
        newtons: N.
        height: of its centre above the lower side, mm.
        ahead: of its centre beyond the middle of what it is the weight of, mm.
    """

    newtons: float
    height: float
    ahead: float = 0.0


NO_WEIGHT = Weight(0.0, 0.0)


@dataclass(frozen=True)
class Weights:
    """Weights of one piece, half a bubble with half a gap, and of both stubs."""

    piece: Weight = NO_WEIGHT
    root: Weight = NO_WEIGHT
    tip: Weight = NO_WEIGHT

    @classmethod
    def of(cls, design: Design, density: float) -> Weights:
        """Weights of a design whose plastic has ``density`` (g/cm³).

        Walls that close the channel at both ends are left out.
        """
        bellows, stub = design.bellows, tip_stub(design)
        middle = bellows.tendon_height / 2
        half = [
            _box(bellows.bubble_size, bellows.bubble_height / 2, 0.5),
            _box(bellows.chamber_size, bellows.bubble_height / 2, -0.5),
            (_channel(bellows) * -bellows.bubble_thickness, middle),
            (_tendon(bellows) * bellows.bubble_distance / 2, middle),
        ]
        volume = sum(each for each, _ in half)
        height = sum(each * centre for each, centre in half) / volume
        newtons, (x, z) = density * 1e-6 * GRAVITY, stub.centroid
        return cls(
            piece=Weight(volume * newtons, height),
            root=Weight(_tendon(bellows) * max(0.0, root_length(design)) * newtons, middle),
            tip=Weight(stub.volume * newtons, z, x - stub.length / 2),
        )


def _box(size: tuple[float, float, float], centre: float, factor: float) -> tuple[float, float]:
    """``factor`` times the volume of a box, mm³, and the height of its centre, mm."""
    return factor * size[0] * size[1] * size[2], centre


def _channel(bellows: BellowsParameters) -> float:
    """Cross-section of the air channel, mm²."""
    return bellows.channel_width * bellows.channel_height


def _tendon(bellows: BellowsParameters) -> float:
    """Cross-section of the tendon's walls, mm²."""
    return bellows.tendon_width * bellows.tendon_height - _channel(bellows)
