"""A groove in the bottom wall under every chamber, which bends more easily there."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.lengths import (
    FULL_ROUND_SNAP,
    SMALLEST_FEATURE,
    Millimetres,
    length_field,
)
from bellows_design.validation.parameters import Parameters, require


class Indent(Parameters):
    """Material taken from the bottom wall under every chamber, right across the bubble.

    Examples:
        >>> from bellows_design import Indent, load_design, with_overrides
        >>> design = load_design("prototype_2")
        >>> groove = Indent(depth=0.4, width=2.4)  # mm
        >>> print(f"{groove.remaining_wall(design.bellows):.2f} mm of wall remain")
        0.80 mm of wall remain
        >>> changed = with_overrides(design, ["indent={depth=0.4, width=2.4}"])
    """

    side: Literal["outside", "inside"] = Field(
        default="outside", description="which face of the bottom wall"
    )
    shape: Literal["arc", "rectangular"] = Field(
        default="arc", description="profile in the x-z plane"
    )
    depth: Millimetres = length_field(0.05, 5, "greatest depth, along z")
    width: Millimetres = length_field(0.2, 50, "width at the wall's face, along x")
    fillet: Millimetres = length_field(0, 5, "radius in the corners of a rectangular profile", 0.0)

    @model_validator(mode="after")
    def _describes_a_profile(self) -> Self:
        if self.shape == "arc":
            self._check_arc()
        self._check_fillet()
        return self

    def check_fits(self, bellows: BellowsParameters) -> None:
        """Raise ``ValueError`` if the indent breaks through the wall or leaves the bubble.

        A ``Design``, whose validation calls this, raises ``DesignError`` instead.
        """
        remaining = self.remaining_wall(bellows)
        require(
            remaining >= SMALLEST_FEATURE - 1e-9,
            f"indent.depth = {self.depth:g} mm leaves {remaining:.3g} mm of the bottom wall; at "
            f"least {SMALLEST_FEATURE:g} mm are needed",
        )
        inside = self.side == "inside"
        widest = bellows.chamber_length if inside else bellows.bubble_length
        require(
            self.width <= widest + 1e-9,
            f"indent.width = {self.width:g} mm exceeds {widest:.3g} mm, the length of the "
            f"{'chamber' if inside else 'bubble'}",
        )
        if inside:
            self._check_room(bellows)

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

    def _check_arc(self) -> None:
        require(
            self.side == "outside",
            "indent.shape = 'arc' is for the outside; an inside indent is rectangular, with "
            "indent.fillet in its corners",
        )
        require(
            self.fillet == 0,
            f"indent.fillet = {self.fillet:g} mm belongs to the rectangular shape; an arc "
            "has no corners",
        )
        require(
            self.depth <= self.width / 2,
            f"indent.depth = {self.depth:g} mm exceeds half of indent.width = "
            f"{self.width:g} mm, the deepest arc",
        )

    def _check_fillet(self) -> None:
        require(
            self.fillet == 0 or self.fillet >= FULL_ROUND_SNAP,
            f"indent.fillet = {self.fillet:g} mm is no radius a printer resolves; it must be 0 or "
            f"at least {FULL_ROUND_SNAP:g} mm",
        )
        inside = self.side == "inside"
        most = self.width / 2 if inside else min(self.depth, self.width / 2)
        require(
            self.fillet <= most + 1e-9,
            f"indent.fillet = {self.fillet:g} mm exceeds {most:.3g} mm, "
            + ("half of its width" if inside else "the lesser of its depth and half of its width"),
        )

    def _check_room(self, bellows: BellowsParameters) -> None:
        _, across, height = self.inside_size(bellows)
        require(
            across >= SMALLEST_FEATURE,
            f"indent.side = 'inside' finds {max(0.0, across):.3g} mm of flat floor across the "
            f"chamber; at least {SMALLEST_FEATURE:g} mm are needed",
        )
        most = min(across, height) / 2
        require(
            self.fillet <= most + 1e-9,
            f"indent.fillet = {self.fillet:g} mm exceeds {most:.3g} mm, half of the room for the "
            "indent on the chamber's floor",
        )
