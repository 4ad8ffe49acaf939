"""The socket through which the actuator gets its air."""

from __future__ import annotations

import math

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.lengths import SMALLEST_FEATURE, Millimetres, length_field
from bellows_design.validation.parameters import Parameters, require


class Port(Parameters):
    """Socket for a pneumatic tube at the root: a boss that stands on the print bed.

    The tube is pushed in up to the root's face; a smaller hole leads on into the air channel.

    Examples:
        >>> from bellows_design.design import Port
        >>> port = Port(tube_diameter=6.0)  # mm
        >>> print(f"{port.axis_height:.1f} mm above the bed")
        4.6 mm above the bed
    """

    tube_diameter: Millimetres = length_field(
        1, 20, "diameter of the socket: the tube's outer diameter", 4.0
    )
    depth: Millimetres = length_field(2, 50, "depth of the socket", 8.0)
    wall: Millimetres = length_field(0.4, 10, "least wall of the boss", 1.6)

    @property
    def axis_height(self) -> float:
        """Height z of the socket's axis, mm: the boss stands on the bed."""
        return self.tube_diameter / 2 + self.wall

    @property
    def radius(self) -> float:
        """Half of the boss's width, and the radius of its round upper half, mm."""
        return self.tube_diameter / 2 + self.wall

    @property
    def height(self) -> float:
        """Height of the boss, mm."""
        return self.axis_height + self.radius

    def section(self, height: float) -> float:
        """Area of the boss's section below that height (at most its own), bore included, mm²."""
        above = max(0.0, height - self.axis_height)
        round_part = above * math.sqrt(self.radius**2 - above**2)
        round_part += self.radius**2 * math.asin(above / self.radius)
        return 2 * self.radius * min(height, self.axis_height) + round_part

    def hole_radius(self, bellows: BellowsParameters) -> float:
        """Radius of the hole from the socket into the channel, mm (negative: they miss)."""
        channel = 0.4 * min(bellows.channel_height, bellows.channel_width)
        miss = abs(self.hole_height(bellows) - self.axis_height)
        return min(channel, 0.45 * self.tube_diameter, self.tube_diameter / 2 - miss - 0.05)

    def hole_height(self, bellows: BellowsParameters) -> float:
        """Height z of that hole's axis, mm: as near to the socket's axis as the channel allows."""
        lowest = bellows.tendon_thickness + bellows.channel_height / 2
        half = max(0.0, bellows.channel_height / 2 - 0.5 * self.tube_diameter)
        return min(max(self.axis_height, lowest - half), lowest + half)

    def check_fits(self, bellows: BellowsParameters) -> None:
        """Raise ``ValueError`` if the socket does not meet the air channel.

        A ``Design``, whose validation calls this, raises ``DesignError`` instead.
        """
        radius = self.hole_radius(bellows)
        require(
            radius >= SMALLEST_FEATURE / 2 - 1e-9,
            f"port.tube_diameter = {self.tube_diameter:g} mm: the socket's axis at "
            f"{self.axis_height:.3g} mm leaves a hole of {max(0.0, 2 * radius):.2g} mm into the "
            f"air channel; at least {SMALLEST_FEATURE:g} mm are needed",
        )
