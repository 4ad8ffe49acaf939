"""Air outside of the chain's pieces."""

from __future__ import annotations

from bellows_design.design.bellows_parameters import BellowsParameters


def dead_volume(bellows: BellowsParameters) -> float:
    """Air of the channel in the root, less that of the last half gap, which has none, mm³.

    Both keep their volume; the socket of the port is left out, as it is filled by the tube.
    """
    root = bellows.first_gap_middle - bellows.tendon_thickness
    area = bellows.channel_width * bellows.channel_height
    return area * (max(0.0, root) - bellows.bubble_distance / 2)
