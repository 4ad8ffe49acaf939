"""The record of a printer profile: what a machine and its nozzle can do, with its bounds."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import AfterValidator, Field, model_validator

from printers.errors import quoted
from printers.validation import Record

LONGEST_TEXT = 2000
"""Characters."""


def _printable(text: str) -> str:
    """``text``, which goes to terminals and into manifests: no control characters, one line."""
    if not text.isprintable():
        raise ValueError(f"{quoted(text)} must be printable text on one line")
    return text


def _quantity(unit: str, text: str | None = None, **bounds: Any) -> Any:
    """A field in the unit, described by the text, within the bounds (ge, gt, le)."""
    return Field(**bounds, description=text, json_schema_extra={"unit": unit})


Text = Annotated[str, Field(max_length=LONGEST_TEXT), AfterValidator(_printable)]
Percent = Annotated[float, _quantity("percent", ge=0, le=100)]
Flow = Annotated[float, _quantity("percent", ge=50, le=200)]
Celsius = Annotated[float, _quantity("°C", ge=0, le=500)]
Side = Annotated[float, Field(ge=20, le=2000)]


class SlicerAdvice(Record):
    """Slicer settings that were reported together: one window, not independent limits.

    Attributes:
        nozzle_temperature: °C.
        first_layer_temperature: Of the nozzle, °C.
        bed_temperature: °C.
        print_speed: mm/s.
        maximum_volumetric_flow: mm³/s.
        perimeter_flow: Percent of the nominal extrusion.
        infill_flow: Percent of the nominal extrusion.
        infill_density: Percent.
        infill_overlap: Percent.
        fan: Percent.
        perimeters: Loops on each side of a wall.
        retraction: Whether the filament is pulled back before travels.
        supports: Whether supports are printed.
        seam: Where loops begin and end, in words.
        sources: Where the settings were reported.

    Raises:
        PrintersError: One sentence on an unknown key, NaN or a value out of bounds.
    """

    nozzle_temperature: Celsius = Field(description="of the nozzle")
    first_layer_temperature: Celsius = Field(description="of the nozzle, for the first layer")
    bed_temperature: Celsius = Field(description="of the bed")
    print_speed: float = _quantity("mm/s", "of the nozzle, within the flow below", gt=0, le=500)
    maximum_volumetric_flow: float = _quantity("mm³/s", "plastic melted at most", gt=0, le=100)
    perimeter_flow: Flow = Field(description="of the nominal extrusion")
    infill_flow: Flow = Field(description="of the nominal extrusion")
    infill_density: Percent = Field(description="of the infill")
    infill_overlap: Percent = Field(description="of infill over perimeters")
    fan: Percent = Field(description="of its speed")
    perimeters: int = Field(ge=1, le=20, description="loops on each side of a wall")
    retraction: bool = Field(description="whether the filament is pulled back before travels")
    supports: bool = Field(description="whether supports are printed")
    seam: Text = Field(description="where loops begin and end, in words")
    sources: tuple[Text, ...] = Field(
        min_length=1, strict=False, description="where the settings were reported"
    )


class PrinterProfile(Record):
    """One printer with one nozzle, one line width and one layer height.

    Attributes:
        name: As it is loaded by.
        description: One line.
        nozzle_diameter: mm.
        line_width: Of one printed line, mm.
        layer_height: mm.
        minimum_lines: Fewest lines side by side that seal.
        minimum_solid_layers: Fewest layers on top of each other that seal.
        build_volume: Largest part in (x, y, z), mm.
        minimum_gap: Narrowest air gap that stays open, mm.
        maximum_bridge: Widest roof over air, mm.
        maximum_overhang_angle: Steepest free-hanging face, degrees from the vertical.
        minimum_bed_contact: Part of the footprint's bounding rectangle that must lie on the bed.
        slicer: Settings that go with it.

    Raises:
        PrintersError: One sentence on an unknown key, NaN or a value out of bounds.
    """

    name: Text = Field(min_length=1, description="as it is loaded by")
    description: Text = Field(description="one line")
    nozzle_diameter: float = _quantity("mm", "of the nozzle", ge=0.1, le=2)
    line_width: float = _quantity("mm", "of one line; 0.75 to 2 nozzle diameters", ge=0.08, le=3)
    layer_height: float = _quantity("mm", "at most 0.8 nozzle diameters", ge=0.02, le=1.5)
    minimum_lines: int = Field(
        ge=1, le=20, description="fewest lines side by side that seal: leak-test a box first"
    )
    minimum_solid_layers: int = Field(
        ge=1, le=200, description="fewest layers on top of each other that seal"
    )
    build_volume: tuple[Side, Side, Side] = _quantity(
        "mm", "largest part in x, y and z, each from 20 to 2000", strict=False
    )
    minimum_gap: float = _quantity("mm", "narrowest air gap that stays open", ge=0.05, le=10)
    maximum_bridge: float = _quantity("mm", "widest roof over air", ge=0.5, le=200)
    maximum_overhang_angle: float = _quantity(
        "degrees", "steepest free-hanging face, from the vertical", ge=10, le=90
    )
    minimum_bed_contact: float = Field(
        gt=0, le=1, description="part of the footprint's rectangle that must lie on the bed"
    )
    slicer: SlicerAdvice = Field(description="settings that go with it")

    @property
    def minimum_wall(self) -> float:
        """Thinnest standing wall that seals, mm."""
        return self.minimum_lines * self.line_width

    @property
    def minimum_floor(self) -> float:
        """Thinnest floor or roof that seals, mm."""
        return self.minimum_solid_layers * self.layer_height

    @property
    def thickest_wall_of_lines(self) -> float:
        """Thickest wall, mm, of perimeters alone; a thicker one has infill that fits any rest."""
        return 2 * self.slicer.perimeters * self.line_width

    def counts_lines(self, thickness: Any) -> Any:
        """Whether a standing wall of the `thickness`, mm, must be a whole number of lines.

        One rule for declared and for measured walls; numbers and arrays give what they are.
        """
        return thickness <= self.thickest_wall_of_lines + 1e-6

    @property
    def volumetric_flow(self) -> float:
        """Plastic laid down at the print speed, mm³/s."""
        section = self.line_width * self.layer_height * self.slicer.perimeter_flow / 100
        return section * self.slicer.print_speed

    @model_validator(mode="after")
    def _line_fits_nozzle(self) -> Self:
        if not 0.75 <= self.line_width / self.nozzle_diameter <= 2:
            raise ValueError(
                f"line_width is {self.line_width:g} mm; it must lie between 0.75 and 2 times "
                f"the nozzle_diameter of {self.nozzle_diameter:g} mm"
            )
        if self.layer_height > 0.8 * self.nozzle_diameter:
            raise ValueError(
                f"layer_height is {self.layer_height:g} mm; it must not exceed 0.8 times "
                f"the nozzle_diameter of {self.nozzle_diameter:g} mm"
            )
        return self

    @model_validator(mode="after")
    def _speed_keeps_the_flow(self) -> Self:
        limit = self.slicer.maximum_volumetric_flow
        if self.volumetric_flow > limit:
            raise ValueError(
                f"print_speed {self.slicer.print_speed:g} mm/s asks for {self.volumetric_flow:.2f} "
                f"mm³/s, above maximum_volumetric_flow {limit:g} mm³/s"
            )
        return self
