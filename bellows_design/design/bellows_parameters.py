"""What a bellows actuator is: its numbers, their bounds, and the lengths that follow from them.

Frame: x runs along the actuator from the root (x = 0) to the tip (x = length), y across it
(symmetric about y = 0), z up from the bottom of the tendon (z = 0). All lengths in mm.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

SMALLEST_FEATURE = 0.4
"""mm. No wall, channel or gap may be thinner: one line of a common nozzle."""

FULL_ROUND_SNAP = 0.05
"""mm. A fillet this close to half of what it rounds is taken as a full round.

The flat strip left between two fillets would be narrower than 0.1 mm: below what a printer
resolves, yet enough to fill a mesh with slivers.
"""

Millimetres = Annotated[float, Field(allow_inf_nan=False)]


def _length(lowest: float, highest: float, text: str) -> float:
    """Required field of a length within [lowest, highest] mm; the bounds catch mistaken units."""
    field: float = Field(ge=lowest, le=highest, description=text, json_schema_extra={"unit": "mm"})
    return field


class Parameters(BaseModel):
    """Frozen model that refuses unknown keys, numbers written as text, NaN and infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class BellowsParameters(Parameters):
    """The twelve numbers of Ćurković & Jambrečić (2020), Table 2, and the number of bubbles.

    Raises ``pydantic.ValidationError`` when a number leaves its bounds or when the numbers
    together describe no solid; each message names parameter, value and bound.
    """

    bubble_width: Millimetres = _length(4, 200, "outer width of a bubble, along y")
    bubble_height: Millimetres = _length(4, 200, "outer height of a bubble, along z")
    bubble_thickness: Millimetres = _length(0.4, 10, "wall of a bubble")
    tendon_width: Millimetres = _length(2, 200, "outer width of the tendon, along y")
    tendon_height: Millimetres = _length(2, 200, "outer height of the tendon, along z")
    tendon_thickness: Millimetres = _length(0.4, 10, "wall of the tendon around its air channel")
    chamber_length: Millimetres = _length(0.4, 50, "inner length of a bubble's chamber, along x")
    bubble_distance: Millimetres = _length(0.4, 50, "gap between neighbouring bubbles, along x")
    inner_fillet: Millimetres = _length(0, 25, "radius on the edges of chambers and channel")
    outer_fillet: Millimetres = _length(0, 25, "radius on the outer edges of a bubble")
    length: Millimetres = _length(10, 1000, "total length of the tendon")
    offset: Millimetres = _length(0, 200, "length of the root before the first bubble")
    number_of_bubbles: int | None = Field(default=None, ge=1, le=100)

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


def snapped_radius(radius: float, half: float) -> float:
    """Radius, or ``half`` (mm) when the two differ by less than ``FULL_ROUND_SNAP``."""
    return half if abs(half - radius) < FULL_ROUND_SNAP else radius


def _require(condition: bool, sentence: str) -> None:
    if not condition:
        raise ValueError(sentence)


def _check_hollow(p: BellowsParameters) -> None:
    for axis, outer in (("bubble_width", p.bubble_width), ("bubble_height", p.bubble_height)):
        inner = outer - 2 * p.bubble_thickness
        _require(
            inner >= SMALLEST_FEATURE,
            f"bubble_thickness = {p.bubble_thickness:g} mm leaves {inner:.3g} mm of {axis} = "
            f"{outer:g} mm hollow; at least {SMALLEST_FEATURE:g} mm are needed",
        )


def _check_channel(p: BellowsParameters) -> None:
    for axis, outer in (("tendon_width", p.tendon_width), ("tendon_height", p.tendon_height)):
        inner = outer - 2 * p.tendon_thickness
        _require(
            inner >= SMALLEST_FEATURE,
            f"tendon_thickness = {p.tendon_thickness:g} mm leaves an air channel of {inner:.3g} mm "
            f"in {axis} = {outer:g} mm; at least {SMALLEST_FEATURE:g} mm are needed",
        )
    _require(
        p.tendon_width <= p.bubble_width,
        f"tendon_width = {p.tendon_width:g} mm must not exceed bubble_width = "
        f"{p.bubble_width:g} mm",
    )
    _require(
        p.channel_width <= p.chamber_size[1],
        f"tendon_width = {p.tendon_width:g} mm makes the air channel {p.channel_width:.3g} mm "
        f"wide, wider than the chamber of {p.chamber_size[1]:.3g} mm it must open into",
    )
    highest = p.bubble_height - p.bubble_thickness
    _require(
        p.tendon_height <= highest,
        f"tendon_height = {p.tendon_height:g} mm must not exceed {highest:.3g} mm, the top of the "
        f"chamber in bubble_height = {p.bubble_height:g} mm",
    )
    opening = p.tendon_height - p.tendon_thickness - max(p.tendon_thickness, p.bubble_thickness)
    _require(
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
        _require(
            radius == 0 or radius >= FULL_ROUND_SNAP,
            f"{name} = {radius:g} mm is no radius a printer resolves; it must be 0 or at least "
            f"{FULL_ROUND_SNAP:g} mm",
        )
        half = min(size) / 2
        extent = ("length", "width", "height")[size.index(min(size))]
        _require(
            radius <= half + 1e-9,
            f"{name} = {radius:g} mm exceeds {half:.4g} mm, half of the {what}'s {extent}",
        )
    corner = corner_thickness(p.bubble_fillet, p.chamber_fillet, p.bubble_thickness)
    _require(
        corner >= p.bubble_thickness / 2,
        f"outer_fillet = {p.outer_fillet:g} mm leaves {corner:.3g} mm of wall at the bubble's "
        f"corners; at least half of bubble_thickness = {p.bubble_thickness:g} mm is needed",
    )


def corner_thickness(outer_radius: float, inner_radius: float, wall: float) -> float:
    """Least wall between two rounded boxes at a corner where three faces meet, mm."""
    offset = outer_radius - inner_radius - wall
    return outer_radius - inner_radius - math.sqrt(3) * offset if offset > 0 else wall


def _check_train(p: BellowsParameters) -> None:
    _require(
        p.bubble_count >= 1,
        f"length = {p.length:g} mm leaves no room for a bubble of {p.bubble_length:.3g} mm after "
        f"offset = {p.offset:g} mm",
    )
    _require(
        p.offset >= p.tendon_thickness - 1e-9,
        f"offset = {p.offset:g} mm leaves no room for the wall at the root; at least "
        f"tendon_thickness = {p.tendon_thickness:g} mm is needed",
    )
    _require(
        p.root_length >= p.tendon_thickness - 1e-9,
        f"number_of_bubbles = {p.bubble_count} makes a train of {p.train_length:.4g} mm that "
        f"leaves {p.root_length:.3g} mm of root in length = {p.length:g} mm; at least "
        f"tendon_thickness = {p.tendon_thickness:g} mm is needed",
    )


class Indent(Parameters):
    """Material taken from the bottom wall under every chamber, right across the bubble."""

    side: Literal["outside", "inside"] = Field(
        default="outside", description="which face of the bottom wall"
    )
    shape: Literal["arc", "rectangular"] = Field(
        default="arc", description="profile in the x-z plane"
    )
    depth: Millimetres = _length(0.05, 5, "greatest depth, along z")
    width: Millimetres = _length(0.2, 50, "width at the wall's face, along x")
    fillet: Millimetres = Field(
        default=0.0, ge=0, le=5, description="radius in the corners of a rectangular profile"
    )

    @model_validator(mode="after")
    def _describes_a_profile(self) -> Self:
        if self.shape == "arc":
            _require(
                self.side == "outside",
                "indent.shape = 'arc' is for the outside; an inside indent is rectangular, with "
                "indent.fillet in its corners",
            )
            _require(
                self.fillet == 0,
                f"indent.fillet = {self.fillet:g} mm belongs to the rectangular shape; an arc "
                "has no corners",
            )
            _require(
                self.depth <= self.width / 2,
                f"indent.depth = {self.depth:g} mm exceeds half of indent.width = "
                f"{self.width:g} mm, the deepest arc",
            )
        _require(
            self.fillet == 0 or self.fillet >= FULL_ROUND_SNAP,
            f"indent.fillet = {self.fillet:g} mm is no radius a printer resolves; it must be 0 or "
            f"at least {FULL_ROUND_SNAP:g} mm",
        )
        inside = self.side == "inside"
        most = self.width / 2 if inside else min(self.depth, self.width / 2)
        _require(
            self.fillet <= most + 1e-9,
            f"indent.fillet = {self.fillet:g} mm exceeds {most:.3g} mm, "
            + ("half of its width" if inside else "the lesser of its depth and half of its width"),
        )
        return self

    def check_fits(self, bellows: BellowsParameters) -> None:
        """Raise ``ValueError`` if the indent breaks through the wall or leaves the bubble."""
        remaining = self.remaining_wall(bellows)
        _require(
            remaining >= SMALLEST_FEATURE - 1e-9,
            f"indent.depth = {self.depth:g} mm leaves {remaining:.3g} mm of the bottom wall; at "
            f"least {SMALLEST_FEATURE:g} mm are needed",
        )
        inside = self.side == "inside"
        widest = bellows.chamber_length if inside else bellows.bubble_length
        _require(
            self.width <= widest + 1e-9,
            f"indent.width = {self.width:g} mm exceeds {widest:.3g} mm, the length of the "
            f"{'chamber' if inside else 'bubble'}",
        )
        if inside:
            self._check_room(bellows)

    def _check_room(self, bellows: BellowsParameters) -> None:
        _, across, height = self.inside_size(bellows)
        _require(
            across >= SMALLEST_FEATURE,
            f"indent.side = 'inside' finds {max(0.0, across):.3g} mm of flat floor across the "
            f"chamber; at least {SMALLEST_FEATURE:g} mm are needed",
        )
        most = min(across, height) / 2
        _require(
            self.fillet <= most + 1e-9,
            f"indent.fillet = {self.fillet:g} mm exceeds {most:.3g} mm, half of the room for the "
            "indent on the chamber's floor",
        )

    def inside_size(self, bellows: BellowsParameters) -> tuple[float, float, float]:
        """Size (x, y, z) of the rounded box that an inside indent takes from the floor, mm."""
        across = bellows.chamber_size[1] - 2 * max(bellows.chamber_fillet, SMALLEST_FEATURE)
        top = bellows.tendon_height - bellows.tendon_thickness
        return self.width, across, top - bellows.bubble_thickness + self.depth

    def remaining_wall(self, bellows: BellowsParameters) -> float:
        """Thickness of the bottom wall under the chamber where the indent is deepest, mm."""
        wall = bellows.bubble_thickness
        if self.side == "outside":
            wall = min(wall, bellows.tendon_thickness)
        return wall - self.depth


class Port(Parameters):
    """Socket for a pneumatic tube at the root: a boss that stands on the print bed.

    The tube is pushed in up to the root's face; a smaller hole leads on into the air channel.
    """

    tube_diameter: Millimetres = Field(
        default=4.0, ge=1, le=20, description="diameter of the socket: the tube's outer diameter"
    )
    depth: Millimetres = Field(default=8.0, ge=2, le=50, description="depth of the socket")
    wall: Millimetres = Field(default=1.6, ge=0.4, le=10, description="least wall of the boss")

    @property
    def axis_height(self) -> float:
        """Height z of the socket's axis, mm: the boss stands on the bed."""
        return self.tube_diameter / 2 + self.wall

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
        """Raise ``ValueError`` if the socket does not meet the air channel."""
        radius = self.hole_radius(bellows)
        _require(
            radius >= SMALLEST_FEATURE / 2 - 1e-9,
            f"port.tube_diameter = {self.tube_diameter:g} mm: the socket's axis at "
            f"{self.axis_height:.3g} mm leaves a hole of {max(0.0, 2 * radius):.2g} mm into the "
            f"air channel; at least {SMALLEST_FEATURE:g} mm are needed",
        )
