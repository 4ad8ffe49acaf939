"""What a bellows actuator is: its numbers, their bounds, and the lengths that follow from them.

Frame: x runs along the actuator from the root (x = 0) to the tip (x = length), y across it
(symmetric about y = 0), z up from the bottom of the tendon (z = 0). All lengths in mm.
"""

from __future__ import annotations

import math
from typing import Self

from pydantic import Field, model_validator

from bellows_design.design.lengths import (
    FULL_ROUND_SNAP,
    SMALLEST_FEATURE,
    Millimetres,
    length_field,
    snapped_radius,
)
from bellows_design.validation.parameters import Parameters, require


class BellowsParameters(Parameters):
    """The twelve numbers of Ćurković & Jambrečić (2020), Table 2, and the number of bubbles.

    All numbers but the last are lengths in mm.

    Raises:
        pydantic.ValidationError: A number leaves its bounds, or the numbers together describe no
            solid; each message names parameter, value and bound. A ``Design`` makes sentences
            of it.

    Examples:
        >>> from bellows_design import BellowsParameters
        >>> bellows = BellowsParameters(
        ...     bubble_width=20, bubble_height=20, bubble_thickness=1.2, tendon_width=6,
        ...     tendon_height=6, tendon_thickness=1.6, chamber_length=2, bubble_distance=1.2,
        ...     inner_fillet=1, outer_fillet=2.2, length=50, offset=5,
        ... )
        >>> print(bellows.bubble_count, f"bubbles, one every {bellows.pitch:.1f} mm")
        8 bubbles, one every 5.6 mm
    """

    bubble_width: Millimetres = length_field(4, 200, "outer width of a bubble, along y")
    bubble_height: Millimetres = length_field(4, 200, "outer height of a bubble, along z")
    bubble_thickness: Millimetres = length_field(0.4, 10, "wall of a bubble")
    tendon_width: Millimetres = length_field(2, 200, "outer width of the tendon, along y")
    tendon_height: Millimetres = length_field(2, 200, "outer height of the tendon, along z")
    tendon_thickness: Millimetres = length_field(
        0.4, 10, "wall of the tendon around its air channel"
    )
    chamber_length: Millimetres = length_field(
        0.4, 50, "inner length of a bubble's chamber, along x"
    )
    bubble_distance: Millimetres = length_field(
        0.4, 50, "gap between neighbouring bubbles, along x"
    )
    inner_fillet: Millimetres = length_field(0, 25, "radius on the edges of chambers and channel")
    outer_fillet: Millimetres = length_field(0, 25, "radius on the outer edges of a bubble")
    length: Millimetres = length_field(10, 1000, "total length of the tendon")
    offset: Millimetres = length_field(0, 200, "length of the root before the first bubble")
    number_of_bubbles: int | None = Field(
        default=None, ge=1, le=100, description="without it as many as fit into the length"
    )

    @property
    def bubble_length(self) -> float:
        """Outer length of a bubble along x, mm: the chamber and its two end walls."""
        return self.chamber_length + 2 * self.bubble_thickness

    @property
    def pitch(self) -> float:
        """Distance from bubble to bubble along x, mm."""
        return self.bubble_length + self.bubble_distance

    @property
    def bubble_count(self) -> int:
        """Number of bubbles: as given, else (length - offset)/pitch rounded, if they fit."""
        if self.number_of_bubbles is not None:
            return self.number_of_bubbles
        room = self.length - self.tendon_thickness + self.bubble_distance
        fitting = math.floor(room / self.pitch + 1e-9)
        return min(round((self.length - self.offset) / self.pitch), fitting)

    @property
    def train_length(self) -> float:
        """From the first bubble's start to the last one's end along x, mm."""
        return self.bubble_count * self.pitch - self.bubble_distance

    @property
    def root_length(self) -> float:
        """Length before the first bubble, mm: the offset, or less where bubbles need the room."""
        return min(self.offset, self.length - self.train_length)

    @property
    def first_gap_middle(self) -> float:
        """x of the middle of the gap before the first bubble, mm.

        Negative, by less than half a gap, where the root is shorter than that.
        """
        return self.bubble_middles[0] - self.pitch / 2

    @property
    def bubble_middles(self) -> tuple[float, ...]:
        """x of every bubble's middle plane, mm."""
        first = self.root_length + self.bubble_length / 2
        return tuple(first + index * self.pitch for index in range(self.bubble_count))

    @property
    def chamber_size(self) -> tuple[float, float, float]:
        """Inner size (x, y, z) of a chamber, mm."""
        wall = 2 * self.bubble_thickness
        return self.chamber_length, self.bubble_width - wall, self.bubble_height - wall

    @property
    def bubble_size(self) -> tuple[float, float, float]:
        """Outer size (x, y, z) of a bubble, mm."""
        return self.bubble_length, self.bubble_width, self.bubble_height

    @property
    def channel_width(self) -> float:
        """Inner width of the tendon's air channel, along y, mm."""
        return self.tendon_width - 2 * self.tendon_thickness

    @property
    def channel_height(self) -> float:
        """Inner height of the tendon's air channel, along z, mm."""
        return self.tendon_height - 2 * self.tendon_thickness

    @property
    def chamber_fillet(self) -> float:
        """Radius built on the chamber's edges, mm: the inner fillet, snapped to a full round."""
        return snapped_radius(self.inner_fillet, min(self.chamber_size) / 2)

    @property
    def channel_fillet(self) -> float:
        """Radius built on the channel's edges, mm: the chamber's as far as it fits."""
        half = min(self.channel_width, self.channel_height) / 2
        return snapped_radius(min(self.chamber_fillet, half), half)

    @property
    def bubble_fillet(self) -> float:
        """Radius built on the bubble's outer edges, mm: the outer fillet, snapped likewise."""
        return snapped_radius(self.outer_fillet, min(self.bubble_size) / 2)

    @model_validator(mode="after")
    def _describes_a_solid(self) -> Self:
        for check in (_check_hollow, _check_channel, _check_fillets, _check_train):
            check(self)
        return self


def _check_hollow(p: BellowsParameters) -> None:
    for axis, outer in (("bubble_width", p.bubble_width), ("bubble_height", p.bubble_height)):
        inner = outer - 2 * p.bubble_thickness
        require(
            inner >= SMALLEST_FEATURE,
            f"bubble_thickness = {p.bubble_thickness:g} mm leaves {inner:.3g} mm of {axis} = "
            f"{outer:g} mm hollow; at least {SMALLEST_FEATURE:g} mm are needed",
        )


def _check_channel(p: BellowsParameters) -> None:
    for axis, outer in (("tendon_width", p.tendon_width), ("tendon_height", p.tendon_height)):
        inner = outer - 2 * p.tendon_thickness
        require(
            inner >= SMALLEST_FEATURE,
            f"tendon_thickness = {p.tendon_thickness:g} mm leaves an air channel of {inner:.3g} mm "
            f"in {axis} = {outer:g} mm; at least {SMALLEST_FEATURE:g} mm are needed",
        )
    require(
        p.tendon_width <= p.bubble_width,
        f"tendon_width = {p.tendon_width:g} mm must not exceed bubble_width = "
        f"{p.bubble_width:g} mm",
    )
    require(
        p.channel_width <= p.chamber_size[1],
        f"tendon_width = {p.tendon_width:g} mm makes the air channel {p.channel_width:.3g} mm "
        f"wide, wider than the chamber of {p.chamber_size[1]:.3g} mm it must open into",
    )
    highest = p.bubble_height - p.bubble_thickness
    require(
        p.tendon_height <= highest,
        f"tendon_height = {p.tendon_height:g} mm must not exceed {highest:.3g} mm, the top of the "
        f"chamber in bubble_height = {p.bubble_height:g} mm",
    )
    opening = p.tendon_height - p.tendon_thickness - max(p.tendon_thickness, p.bubble_thickness)
    require(
        opening >= SMALLEST_FEATURE,
        f"bubble_thickness = {p.bubble_thickness:g} mm leaves the air channel of tendon_height = "
        f"{p.tendon_height:g} mm an opening of {opening:.3g} mm into the chamber; at least "
        f"{SMALLEST_FEATURE:g} mm are needed",
    )


def _check_fillets(p: BellowsParameters) -> None:
    for name, radius, size, what in (
        ("inner_fillet", p.inner_fillet, p.chamber_size, "chamber"),
        ("outer_fillet", p.outer_fillet, p.bubble_size, "bubble"),
    ):
        require(
            radius == 0 or radius >= FULL_ROUND_SNAP,
            f"{name} = {radius:g} mm is no radius a printer resolves; it must be 0 or at least "
            f"{FULL_ROUND_SNAP:g} mm",
        )
        half = min(size) / 2
        extent = ("length", "width", "height")[size.index(min(size))]
        require(
            radius <= half + 1e-9,
            f"{name} = {radius:g} mm exceeds {half:.4g} mm, half of the {what}'s {extent}; "
            f"set {name}={_rounded_down(half):g} or less",
        )
    corner = corner_thickness(p.bubble_fillet, p.chamber_fillet, p.bubble_thickness)
    require(
        corner >= p.bubble_thickness / 2,
        f"outer_fillet = {p.outer_fillet:g} mm leaves {corner:.3g} mm of wall at the bubble's "
        f"corners; at least half of bubble_thickness = {p.bubble_thickness:g} mm is needed",
    )


def _rounded_down(length: float) -> float:
    """To a thousandth, mm."""
    return math.floor(1000 * length + 1e-6) / 1000


def corner_thickness(outer_radius: float, inner_radius: float, wall: float) -> float:
    """Least wall between two rounded boxes at a corner where three faces meet, mm."""
    offset = outer_radius - inner_radius - wall
    return outer_radius - inner_radius - math.sqrt(3) * offset if offset > 0 else wall


def _check_train(p: BellowsParameters) -> None:
    require(
        p.bubble_count >= 1,
        f"length = {p.length:g} mm leaves no room for a bubble of {p.bubble_length:.3g} mm after "
        f"offset = {p.offset:g} mm",
    )
    require(
        p.offset >= p.tendon_thickness - 1e-9,
        f"offset = {p.offset:g} mm leaves no room for the wall at the root; at least "
        f"tendon_thickness = {p.tendon_thickness:g} mm is needed",
    )
    require(
        p.root_length >= p.tendon_thickness - 1e-9,
        f"number_of_bubbles = {p.bubble_count} makes a train of {p.train_length:.4g} mm that "
        f"leaves {p.root_length:.3g} mm of root in length = {p.length:g} mm; at least "
        f"tendon_thickness = {p.tendon_thickness:g} mm is needed",
    )
