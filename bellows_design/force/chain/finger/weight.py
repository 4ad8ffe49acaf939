"""Weights of a finger's pieces and stubs, from the boxes it is made of; fillets are left out."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.design.bellows_parameters import BellowsParameters

GRAVITY = 9.80665
"""Standard acceleration of free fall, m/s²."""


@dataclass(frozen=True)
class Weight:
    """A weight (N) and the height of its centre above the lower side (mm)."""

    newtons: float
    height: float


NO_WEIGHT = Weight(0.0, 0.0)


@dataclass(frozen=True)
class Weights:
    """Weights of one piece, half a bubble with half a gap, and of both stubs."""

    piece: Weight = NO_WEIGHT
    root: Weight = NO_WEIGHT
    tip: Weight = NO_WEIGHT

    @classmethod
    def of(cls, bellows: BellowsParameters, density: float) -> Weights:
        """Weights of a design whose plastic has ``density`` (g/cm³).

        Walls that close the channel at both ends are left out.
        """
        stubs = bellows.length - bellows.bubble_count * bellows.pitch
        root = bellows.bubble_middles[0] - bellows.pitch / 2
        middle = bellows.tendon_height / 2
        half = [
            _box(bellows.bubble_size, bellows.bubble_height / 2, 0.5),
            _box(bellows.chamber_size, bellows.bubble_height / 2, -0.5),
            (_channel(bellows) * -bellows.bubble_thickness, middle),
            (_tendon(bellows) * bellows.bubble_distance / 2, middle),
        ]
        volume = sum(each for each, _ in half)
        height = sum(each * centre for each, centre in half) / volume
        newtons = density * 1e-6 * GRAVITY
        return cls(
            piece=Weight(volume * newtons, height),
            root=Weight(_tendon(bellows) * root * newtons, middle),
            tip=Weight(_tendon(bellows) * (stubs - root) * newtons, middle),
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
