"""A printer's profile as the settings of PrusaSlicer, whole, in one INI file."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import TypeAlias

from printers.profile import PrinterProfile

OLDEST_PRUSASLICER = (2, 5)
"""The first with the perimeter generator Arachne, and the one the keys were checked with."""

Settings: TypeAlias = Mapping[str, str | int | float]


def prusa_settings(profile: PrinterProfile) -> str:
    """The airtight settings of the profile as an INI file for PrusaSlicer 2.5 or newer.

    Figures come from the profile; the rest is what keeps walls, floors and seams closed, each with
    its reason. What the file does not name is left at the slicer's own defaults: it has nothing to
    do with sealing (supports, multiple extruders, acceleration). The same profile always gives the
    same bytes.
    """
    lines = [
        f"# {profile.name} with {profile.filament.name}: airtight settings of bellows-design",
        f"# sha256 of the profile: {profile_digest(profile)}",
        "# PrusaSlicer 2.5 or newer: File > Import > Import Config, or --load. Keep the start and",
        "# end G-code of your own printer; those below only home it and switch the heaters off.",
    ]
    for title, settings in _groups(profile):
        lines += ["", f"# {title}", *(f"{key} = {_text(settings[key])}" for key in settings)]
    return "\n".join(lines) + "\n"


def profile_digest(profile: PrinterProfile) -> str:
    """The sha256 of all that the profile says."""
    said = json.dumps(profile.model_dump(mode="json"), sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(said.encode()).hexdigest()


def settings_digest(text: str) -> str:
    """The sha256 of a settings file's bytes."""
    return hashlib.sha256(text.encode()).hexdigest()


def parsed_settings(text: str) -> dict[str, str]:
    """Key -> value of an INI file for PrusaSlicer, which has no sections."""
    pairs = (line.split("=", 1) for line in text.splitlines() if "=" in line and line[0] != "#")
    return {key.strip(): value.strip() for key, value in pairs}


def _text(value: str | int | float) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def _groups(profile: PrinterProfile) -> Iterator[tuple[str, Settings]]:
    yield "printer", _printer(profile)
    yield "filament", _filament(profile)
    yield "layers", _layers(profile)
    yield "lines: one width everywhere, so that walls are whole numbers of lines", _lines(profile)
    yield "walls: as many loops as the profile says, fitted to the wall by Arachne", _walls(profile)
    yield "infill: solid, straight, and into the walls", _infill(profile)
    yield "floors and roofs", _floors(profile)
    yield "speed: one for all, so that the flow is steady", _speeds(profile)
    yield "fan", _fan(profile)
    yield "travel: each restart of the flow is a possible pinhole", _travel(profile)
    yield "shape: nothing is added, nothing is smoothed away", _shape(profile)


def _printer(profile: PrinterProfile) -> Settings:
    x, y, z = profile.build_volume
    return {
        "printer_technology": "FFF",
        "gcode_flavor": "marlin",
        "nozzle_diameter": profile.nozzle_diameter,
        "bed_shape": f"0x0,{x:g}x0,{x:g}x{y:g},0x{y:g}",
        "max_print_height": z,
        "use_relative_e_distances": 1,
        "use_firmware_retraction": 0,
        "use_volumetric_e": 0,
        "start_gcode": "G28\\nG92 E0",
        "layer_gcode": "G92 E0",
        "end_gcode": "M104 S0\\nM140 S0\\nM84",
    }


def _filament(profile: PrinterProfile) -> Settings:
    filament, advice = profile.filament, profile.slicer
    return {
        "filament_type": "FLEX",
        "filament_diameter": filament.diameter,
        "filament_density": filament.density,
        "temperature": round(advice.nozzle_temperature),
        "first_layer_temperature": round(advice.first_layer_temperature),
        "bed_temperature": round(advice.bed_temperature),
        "first_layer_bed_temperature": round(advice.bed_temperature),
        "extrusion_multiplier": advice.flow / 100,
        "filament_max_volumetric_speed": advice.maximum_volumetric_flow,
    }


def _layers(profile: PrinterProfile) -> Settings:
    return {
        "layer_height": profile.layer_height,
        "first_layer_height": profile.first_layer_height,
        "raft_layers": 0,
        "spiral_vase": 0,
    }


def _lines(profile: PrinterProfile) -> Settings:
    lines = ("", "external_perimeter_", "perimeter_", "infill_", "solid_infill_", "top_infill_")
    return {f"{line}extrusion_width": profile.line_width for line in (*lines, "first_layer_")}


def _walls(profile: PrinterProfile) -> Settings:
    return {
        "perimeters": profile.slicer.perimeters,
        "perimeter_generator": "arachne",
        "min_bead_width": "85%",
        "min_feature_size": "25%",
        "wall_distribution_count": 1,
        "thin_walls": 0,
        "gap_fill_enabled": 1,
        "extra_perimeters": 1,
        "overhangs": 1,
        "external_perimeters_first": 0,
        "infill_first": 0,
        "fuzzy_skin": "none",
        "seam_position": profile.slicer.seam,
    }


def _infill(profile: PrinterProfile) -> Settings:
    return {
        "fill_density": f"{profile.slicer.infill_density:g}%",
        "fill_pattern": "rectilinear",  # of the patterns that fill to 100 %
        "infill_overlap": f"{profile.slicer.infill_overlap:g}%",
        "infill_every_layers": 1,
        "interface_shells": 0,
    }


def _floors(profile: PrinterProfile) -> Settings:
    return {
        "top_solid_layers": profile.minimum_solid_layers,
        "bottom_solid_layers": profile.minimum_solid_layers,
        "top_fill_pattern": "rectilinear",
        "bottom_fill_pattern": "rectilinear",
        "ensure_vertical_shell_thickness": 1,
        "thick_bridges": 0,
        "bridge_flow_ratio": 1,
        "ironing": 0,
    }


def _speeds(profile: PrinterProfile) -> Settings:
    speeds = ("perimeter", "external_perimeter", "small_perimeter", "infill", "solid_infill")
    more = ("top_solid_infill", "gap_fill", "bridge", "first_layer")
    return {f"{name}_speed": profile.slicer.print_speed for name in (*speeds, *more)}


def _fan(profile: PrinterProfile) -> Settings:
    speed = round(profile.slicer.fan)
    return {
        "cooling": 1,
        "fan_always_on": int(speed > 0),
        "min_fan_speed": speed,
        "max_fan_speed": speed,
        "bridge_fan_speed": speed,
        "slowdown_below_layer_time": 0,
    }


def _travel(profile: PrinterProfile) -> Settings:
    without = {"retract_length": 0, "retract_layer_change": 0, "wipe": 0}
    return {
        "avoid_crossing_perimeters": 1,
        "retract_lift": 0,
        **({} if profile.slicer.retraction else without),
    }


def _shape(profile: PrinterProfile) -> Settings:
    return {
        "support_material": int(profile.slicer.supports),
        "skirts": 0,
        "brim_width": 0,
        "complete_objects": 0,
        "elefant_foot_compensation": 0,
        "xy_size_compensation": 0,
        "slice_closing_radius": 0.049,
        "slicing_mode": "regular",
        "resolution": 0,
        "gcode_resolution": 0.0125,
    }
