"""The record of a printer profile: what a machine and its nozzle can do, with its bounds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

from pydantic import Field, field_validator, model_validator

from printers.profile.filament import Filament
from printers.profile.quantities import Side, Text, quantity
from printers.profile.slicer_advice import SlicerAdvice, refuse_earlier_flows
from printers.rule_table import RULES, Severity, severity_problem
from printers.validation import Record


class PrinterProfile(Record):
    """One printer with one nozzle, one line width and one layer height.

    Attributes:
        name: As it is loaded by.
        description: One line.
        nozzle_diameter: mm.
        line_width: Of one printed line, mm.
        layer_height: mm.
        first_layer_height: Of the layer on the bed, mm.
        minimum_lines: Fewest lines side by side that seal.
        minimum_solid_layers: Fewest layers on top of each other that seal.
        sealing_layer_height: Thickest layer that was measured to seal, mm.
        build_volume: Largest part in (x, y, z), mm.
        minimum_gap: Narrowest air gap that stays open, mm: what strings and blobs of molten TPU
            bridge, not what a slicer closes, which is about 0.1 mm.
        maximum_bridge: Widest roof over air, mm.
        maximum_overhang_angle: Steepest free-hanging face, degrees from the vertical.
        minimum_bed_contact: Part of the footprint's bounding rectangle that must lie on the bed.
        filament: What is printed.
        slicer: Settings that go with it.
        rules: Name of a rule -> its severity here, where it differs from that of the rule.

    Raises:
        PrintersError: One sentence on an unknown key, NaN or a value out of bounds.

    Examples:
        >>> from printers import load_profile
        >>> printer = load_profile("prusa_i3")
        >>> print(f"{printer.minimum_wall:.1f} mm, {printer.minimum_floor:.1f} mm")  # wall, floor
        1.2 mm, 0.8 mm
        >>> changed = printer.model_copy(update={"build_volume": (120.0, 120.0, 120.0)})
    """

    name: Text = Field(min_length=1, description="as it is loaded by")
    description: Text = Field(description="one line")
    nozzle_diameter: float = quantity("mm", "of the nozzle", ge=0.1, le=2)
    line_width: float = quantity("mm", "of one line; 0.75 to 2 nozzle diameters", ge=0.08, le=3)
    layer_height: float = quantity("mm", "at most 0.8 nozzle diameters", ge=0.02, le=1.5)
    first_layer_height: float = quantity(
        "mm", "of the layer on the bed; at most 0.8 nozzle diameters", ge=0.02, le=1.5
    )
    minimum_lines: int = Field(
        ge=1, le=20, description="fewest lines side by side that seal: leak-test a box first"
    )
    minimum_solid_layers: int = Field(
        ge=1, le=200, description="fewest layers on top of each other that seal"
    )
    sealing_layer_height: float = quantity(
        "mm", "thickest layer that was measured to seal", ge=0.02, le=1.5
    )
    build_volume: tuple[Side, Side, Side] = quantity(
        "mm", "largest part in x, y and z, each from 20 to 2000", strict=False
    )
    minimum_gap: float = quantity("mm", "narrowest air gap that stays open", ge=0.05, le=10)
    maximum_bridge: float = quantity("mm", "widest roof over air", ge=0.5, le=200)
    maximum_overhang_angle: float = quantity(
        "degrees", "steepest free-hanging face, from the vertical", ge=10, le=90
    )
    minimum_bed_contact: float = Field(
        gt=0, le=1, description="part of the footprint's rectangle that must lie on the bed"
    )
    filament: Filament = Field(description="what is printed")
    slicer: SlicerAdvice = Field(description="settings that go with it")
    rules: dict[str, Severity] = Field(
        default={}, description="rules whose severity differs on this printer"
    )

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
        section = self.line_width * self.layer_height * self.slicer.flow / 100
        return section * self.slicer.print_speed

    @model_validator(mode="before")
    @classmethod
    def _written_for_an_earlier_version(cls, table: Any) -> Any:
        if isinstance(table, dict):
            refuse_earlier_flows(table)
        return table

    @model_validator(mode="after")
    def _line_fits_nozzle(self) -> Self:
        if not 0.75 <= self.line_width / self.nozzle_diameter <= 2:
            raise ValueError(
                f"line_width is {self.line_width:g} mm; it must lie between 0.75 and 2 times "
                f"the nozzle_diameter of {self.nozzle_diameter:g} mm"
            )
        for name in ("layer_height", "first_layer_height"):
            if getattr(self, name) > 0.8 * self.nozzle_diameter:
                raise ValueError(
                    f"{name} is {getattr(self, name):g} mm; it must not exceed 0.8 times "
                    f"the nozzle_diameter of {self.nozzle_diameter:g} mm"
                )
        return self

    @field_validator("rules")
    @classmethod
    def _severities_may_be_changed(cls, rules: Mapping[str, Severity]) -> Mapping[str, Severity]:
        for name in rules:
            problem = severity_problem(name)
            if problem:
                raise ValueError(problem)
        return rules

    def severity(self, rule: str) -> Severity:
        """What it means on this printer that the part does not keep the `rule`."""
        return self.rules.get(rule, RULES[rule].severity)

    @model_validator(mode="after")
    def _speed_keeps_the_flow(self) -> Self:
        limit = self.slicer.maximum_volumetric_flow
        if self.volumetric_flow > limit:
            raise ValueError(
                f"print_speed {self.slicer.print_speed:g} mm/s asks for {self.volumetric_flow:.2f} "
                f"mm³/s, above maximum_volumetric_flow {limit:g} mm³/s"
            )
        return self
