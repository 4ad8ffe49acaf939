"""The flat pad at the tip with which a finger grips."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.lengths import SMALLEST_FEATURE, Millimetres, length_field
from bellows_design.validation.parameters import Parameters, require


class Fingertip(Parameters):
    """A solid pad beyond the tip's face, flat on the print bed as its lower side grips.

    Ribs across it stay when grooves are cut into that lower side, so they stand on the bed and
    need no support; the first begins at the tip's face, the last ends with the pad.

    Examples:
        >>> from bellows_design.design import Design, Fingertip, load_design
        >>> pad = Fingertip(length=12, width=16, thickness=3.2, ribs=4)  # mm
        >>> table = load_design("finger").model_dump()
        >>> finger = Design.of(table | {"name": "padded", "fingertip": pad})
        >>> print(finger.finger_length, "mm")
        62.0 mm
    """

    length: Millimetres = length_field(2, 100, "length beyond the tip, along x")
    width: Millimetres = length_field(2, 200, "width, along y")
    thickness: Millimetres = length_field(0.8, 50, "thickness, along z")
    ribs: int = Field(
        default=0, ge=0, le=50, description="number of ribs across the lower side: 0, or 2 and more"
    )
    rib_width: Millimetres = length_field(0.4, 20, "width of a rib, along x", 1.2)
    rib_height: Millimetres = length_field(
        0.2, 10, "height of a rib: the depth of the grooves between them", 0.8
    )

    @property
    def groove_width(self) -> float:
        """Width of a groove between two ribs, along x, mm; 0 without ribs."""
        if self.ribs < 2:
            return 0.0
        return (self.length - self.ribs * self.rib_width) / (self.ribs - 1)

    @property
    def grooves(self) -> tuple[float, ...]:
        """Where each groove begins, mm from the tip's face."""
        pitch = self.rib_width + self.groove_width
        return tuple(self.rib_width + index * pitch for index in range(self.ribs - 1))

    @property
    def volume(self) -> float:
        """mm³."""
        grooves = len(self.grooves) * self.groove_width * self.rib_height
        return self.width * (self.length * self.thickness - grooves)

    @property
    def centroid(self) -> tuple[float, float]:
        """x from the tip's face and z of its centre of volume, mm: the ribs are symmetric in x."""
        grooves = len(self.grooves) * self.groove_width * self.rib_height
        area = self.length * self.thickness - grooves
        moment = self.length * self.thickness**2 / 2 - grooves * self.rib_height / 2
        return self.length / 2, moment / area

    @model_validator(mode="after")
    def _has_ribs_apart(self) -> Self:
        if not self.ribs:
            return self
        require(self.ribs >= 2, "fingertip.ribs = 1 leaves no groove; it must be 0 or at least 2")
        require(
            self.groove_width >= SMALLEST_FEATURE - 1e-9,
            f"fingertip.ribs = {self.ribs} of fingertip.rib_width = {self.rib_width:g} mm leave "
            f"grooves of {max(0.0, self.groove_width):.3g} mm in fingertip.length = "
            f"{self.length:g} mm; at least {SMALLEST_FEATURE:g} mm are needed",
        )
        left = self.thickness - self.rib_height
        require(
            left >= SMALLEST_FEATURE - 1e-9,
            f"fingertip.rib_height = {self.rib_height:g} mm leaves {max(0.0, left):.3g} mm of "
            f"fingertip.thickness = {self.thickness:g} mm; at least {SMALLEST_FEATURE:g} mm are "
            "needed",
        )
        return self

    def check_fits(self, bellows: BellowsParameters) -> None:
        """Raise ``ValueError`` if the pad leaves the bubbles' section or comes near the last one.

        A ``Design``, whose validation calls this, raises ``DesignError`` instead.
        """
        for name, value, bound, limit in (
            ("width", self.width, "bubble_width", bellows.bubble_width),
            ("thickness", self.thickness, "bubble_height", bellows.bubble_height),
        ):
            require(
                value <= limit + 1e-9,
                f"fingertip.{name} = {value:g} mm exceeds {bound} = {limit:g} mm",
            )
        within = self.width <= bellows.tendon_width and self.thickness <= bellows.tendon_height
        gap = bellows.length - bellows.root_length - bellows.train_length
        require(
            within or gap >= bellows.bubble_distance - 1e-9,
            f"length = {bellows.length:g} mm leaves {gap:.3g} mm between the last bubble and the "
            f"fingertip; at least bubble_distance = {bellows.bubble_distance:g} mm are needed, or "
            "a fingertip no wider and thicker than the tendon",
        )
