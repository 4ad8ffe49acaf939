"""The plate at the root by which the actuator is fastened with screws."""

from __future__ import annotations

import math
from typing import Literal, Self

from pydantic import Field, model_validator

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.lengths import (
    FULL_ROUND_SNAP,
    Millimetres,
    length_field,
    snapped_radius,
)
from bellows_design.design.port import Port
from bellows_design.validation.parameters import Parameters, require


class Mount(Parameters):
    """A plate with screw holes, fused to the port's boss on the side x <= 0 of the root.

    A foot lies on the print bed, left and right of the boss, with holes along z. A flange stands
    on it around the boss, with holes along x beside the bubbles, so that a screw's head and its
    tool pass them. The holes are made in the plate before it is fused to the boss: whatever their
    places, they cannot open the socket.

    Examples:
        >>> from bellows_design.design import Design, Mount, load_design
        >>> foot = Mount(kind="foot", hole_diameter=3.4)  # mm, for M3
        >>> table = load_design("finger").model_dump()
        >>> finger = Design.of(table | {"name": "standing", "mount": foot})
        >>> print(len(foot.hole_places(finger.bellows, finger.port)), "holes")
        2 holes
    """

    kind: Literal["foot", "flange"] = Field(
        description="a plate that lies on the bed, or one that stands on it around the port"
    )
    thickness: Millimetres = length_field(1, 20, "thickness of the plate", 3.0)
    holes: Literal[2, 4] = Field(default=2, description="number of screw holes, 2 or 4")
    hole_diameter: Millimetres = length_field(
        2, 10, "diameter of a screw hole; 3.4 mm lets an M3 screw pass", 3.4
    )
    edge_distance: Millimetres = length_field(
        1.2, 20, "least material around a hole: to the plate's edge, the boss, the next hole", 3.0
    )
    fillet: Millimetres = length_field(0, 20, "radius of the plate's corners", 2.0)

    @model_validator(mode="after")
    def _rounds_its_corners(self) -> Self:
        require(
            self.fillet == 0 or self.fillet >= FULL_ROUND_SNAP,
            f"mount.fillet = {self.fillet:g} mm is no radius a printer resolves; it must be 0 or "
            f"at least {FULL_ROUND_SNAP:g} mm",
        )
        most = self.border
        require(
            self.fillet <= most + 1e-9,
            f"mount.fillet = {self.fillet:g} mm exceeds {most:.3g} mm, the distance from the "
            "plate's edge to the middle of a hole",
        )
        return self

    def check_fits(self, bellows: BellowsParameters, port: Port) -> None:
        """Raise ``ValueError`` if the plate hides boss or socket, or nears the first bubble.

        A ``Design``, whose validation calls this, raises ``DesignError`` instead.
        """
        foot = self.kind == "foot"
        most = port.height if foot else port.depth
        what = "the height of the port's boss" if foot else "port.depth: the mouth of the socket"
        require(
            self.thickness <= most + 1e-9,
            f"mount.thickness = {self.thickness:g} mm exceeds {most:.3g} mm, {what}",
        )
        require(
            foot or bellows.root_length >= bellows.bubble_distance - 1e-9,
            f"offset = {bellows.offset:g} mm and length = {bellows.length:g} mm leave "
            f"{bellows.root_length:.3g} mm between a mount of the kind 'flange' and the first "
            f"bubble; at least bubble_distance = {bellows.bubble_distance:g} mm are needed",
        )

    @property
    def border(self) -> float:
        """Distance of the outer holes' middles from the plate's edges, mm."""
        return self.edge_distance + self.hole_diameter / 2

    @property
    def corner_radius(self) -> float:
        """Radius built on the plate's corners, mm: the fillet, snapped to that distance."""
        return snapped_radius(self.fillet, self.border)

    def length(self, port: Port) -> float:
        """Extent along x, mm: of a foot as long as the boss, or as two holes in a row need."""
        if self.kind == "flange":
            return self.thickness
        row = (self.holes // 2 - 1) * (self.hole_diameter + self.edge_distance)
        return max(port.depth, 2 * self.border + row)

    def width(self, bellows: BellowsParameters, port: Port) -> float:
        """Extent along y, mm."""
        return 2 * (self._beside(bellows, port) + self.border)

    def height(self, port: Port) -> float:
        """Extent along z, mm: of a flange at least as high as the boss."""
        if self.kind == "foot":
            return self.thickness
        return max(port.height, self._heights(port)[-1] + self.border)

    def hole_places(
        self, bellows: BellowsParameters, port: Port
    ) -> tuple[tuple[float, float, float], ...]:
        """Middles of the holes where the plate begins, mm: at z = 0, or at x = 0."""
        y = self._beside(bellows, port)
        if self.kind == "foot":
            return tuple((x, side * y, 0.0) for x in self._lengthwise(port) for side in (-1, 1))
        return tuple((0.0, side * y, z) for z in self._heights(port) for side in (-1, 1))

    def volume(self, bellows: BellowsParameters, port: Port) -> float:
        """What the plate adds to the part beside the boss, mm³."""
        foot = self.kind == "foot"
        corners = (4 if foot else 2) * (1 - math.pi / 4) * self.corner_radius**2
        holes = self.holes * math.pi / 4 * self.hole_diameter**2
        if not foot:
            face = self.width(bellows, port) * self.height(port) - corners - holes
            return self.thickness * (face - port.section(port.height))
        length = self.length(port)
        face = length * self.width(bellows, port) - corners - holes
        free = (length - port.depth) * 2 * port.radius
        return self.thickness * (face - free) - port.depth * port.section(self.thickness)

    def _beside(self, bellows: BellowsParameters, port: Port) -> float:
        """Distance of the holes' middles from the plane y = 0, mm."""
        clear = port.radius + self.border
        if self.kind == "foot":
            return clear
        return max(clear, bellows.bubble_width / 2 + self.hole_diameter)

    def _lengthwise(self, port: Port) -> tuple[float, ...]:
        """x of the middles of a foot's holes, mm."""
        length = self.length(port)
        return (-length / 2,) if self.holes == 2 else (self.border - length, -self.border)

    def _heights(self, port: Port) -> tuple[float, ...]:
        """z of the middles of a flange's holes, mm: two at the socket's height, or above others."""
        if self.holes == 2:
            return (max(port.axis_height, self.border),)
        return self.border, self.border + self.hole_diameter + self.edge_distance
