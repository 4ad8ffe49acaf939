"""A printer's profile as the settings of OrcaSlicer: a machine, a process and a filament."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from printers.profile import PrinterProfile
from printers.slicing.prusa import profile_digest

SEAMS = {"random": "random", "aligned": "aligned", "nearest": "nearest", "rear": "back"}
"""The profile's word -> OrcaSlicer's."""

SEAM_GAP = "15%"
"""Of the nozzle, by which a loop ends before its beginning: OrcaSlicer's own default."""


def orca_settings(profile: PrinterProfile) -> dict[str, str]:
    """The airtight settings of the profile as three JSON files for OrcaSlicer.

    Its command line does not resolve what a profile inherits
    (github.com/OrcaSlicer/OrcaSlicer/issues/14718), so the files inherit nothing and name every
    setting that has to do with sealing. The keys and words are those of
    OrcaSlicer 2.3 and newer, held against its own project files; the files were not run through
    it here.

    Returns:
        File name -> text: `NAME.machine.json`, `NAME.process.json` and `NAME.filament.json`, used
        as `--load-settings "NAME.machine.json;NAME.process.json" --load-filaments
        NAME.filament.json`. The same profile always gives the same text.
    """
    machine = f"{profile.name} {profile.nozzle_diameter:g} nozzle"
    files = {
        "machine": (machine, _machine(profile)),
        "process": (f"airtight {profile.layer_height:g}mm @{profile.name}", _process(profile)),
        "filament": (f"{profile.filament.name} @{profile.name}", _filament(profile)),
    }
    return {
        f"{profile.name}.{kind}.json": _file(kind, name, machine, settings, profile)
        for kind, (name, settings) in files.items()
    }


def _file(
    kind: str, name: str, machine: str, settings: Mapping[str, Any], profile: PrinterProfile
) -> str:
    about: dict[str, Any] = {
        "type": kind,
        "name": name,
        "from": "User",
        "version": "2.0.0.0",
        "instantiation": "true",
        "inherits": "",
    }
    if kind == "machine":
        about["printer_settings_id"] = machine
        about["printer_notes"] = f"sha256 of the profile: {profile_digest(profile)}"
    else:
        about["compatible_printers"] = [machine]
    values = {key: _value(value) for key, value in settings.items()}
    return json.dumps({**about, **values}, indent=4, ensure_ascii=False) + "\n"


def _value(value: Any) -> Any:
    """All values are text, those of an extruder or filament lists of it."""
    if isinstance(value, list):
        return [_value(entry) for entry in value]
    return value if isinstance(value, str) else f"{value:g}"


def _machine(profile: PrinterProfile) -> Mapping[str, Any]:
    x, y, z = profile.build_volume
    retraction = {} if profile.slicer.retraction else {"retraction_length": [0]}
    return {
        "printer_technology": "FFF",
        "printer_model": profile.name,
        "printer_variant": f"{profile.nozzle_diameter:g}",
        "gcode_flavor": "marlin",
        "nozzle_diameter": [profile.nozzle_diameter],
        "printable_area": ["0x0", f"{x:g}x0", f"{x:g}x{y:g}", f"0x{y:g}"],
        "printable_height": z,
        "min_layer_height": [min(profile.layer_height, 0.2 * profile.nozzle_diameter)],
        "max_layer_height": [0.8 * profile.nozzle_diameter],
        "use_relative_e_distances": 1,
        "use_firmware_retraction": 0,
        "machine_start_gcode": "G28\nG92 E0",
        "machine_end_gcode": "M104 S0\nM140 S0\nM84",
        "before_layer_change_gcode": "G92 E0",
        "layer_change_gcode": "",
        **retraction,
        "retract_when_changing_layer": [int(profile.slicer.retraction)],
        "wipe": [0],
        "z_hop": [0],
    }


def _filament(profile: PrinterProfile) -> Mapping[str, Any]:
    filament, advice = profile.filament, profile.slicer
    plates = ("cool_plate", "eng_plate", "hot_plate", "textured_plate")
    bed = {f"{plate}_temp": [round(advice.bed_temperature)] for plate in plates}
    first = {f"{key}_initial_layer": value for key, value in bed.items()}
    return {
        "filament_type": ["TPU"],
        "filament_diameter": [filament.diameter],
        "filament_density": [filament.density],
        "filament_flow_ratio": [advice.flow / 100],
        "filament_max_volumetric_speed": [advice.maximum_volumetric_flow],
        "nozzle_temperature": [round(advice.nozzle_temperature)],
        "nozzle_temperature_initial_layer": [round(advice.first_layer_temperature)],
        **bed,
        **first,
        "fan_min_speed": [round(advice.fan)],
        "fan_max_speed": [round(advice.fan)],
        "overhang_fan_speed": [round(advice.fan)],
        "reduce_fan_stop_start_freq": [1],
        "slow_down_for_layer_cooling": [0],
    }


def _process(profile: PrinterProfile) -> Mapping[str, Any]:
    return {
        "layer_height": profile.layer_height,
        "initial_layer_print_height": profile.first_layer_height,
        **_lines(profile),
        **_walls(profile),
        **_solid(profile),
        **_speeds(profile),
        "enable_support": int(profile.slicer.supports),
        "raft_layers": 0,
        "skirt_loops": 0,
        "brim_type": "no_brim",
        "spiral_mode": 0,
        "print_sequence": "by layer",
        "enable_prime_tower": 0,
        "elefant_foot_compensation": 0,
        "xy_contour_compensation": 0,
        "xy_hole_compensation": 0,
        "slice_closing_radius": 0.049,
        "slicing_mode": "regular",
        "resolution": 0.0125,
        "enable_arc_fitting": 0,
    }


def _lines(profile: PrinterProfile) -> Mapping[str, Any]:
    lines = ("", "initial_layer_", "outer_wall_", "inner_wall_", "top_surface_")
    more = ("sparse_infill_", "internal_solid_infill_", "support_")
    return {f"{line}line_width": profile.line_width for line in (*lines, *more)}


def _walls(profile: PrinterProfile) -> Mapping[str, Any]:
    return {
        "wall_loops": profile.slicer.perimeters,
        "wall_generator": "arachne",
        "min_bead_width": "85%",
        "min_feature_size": "25%",
        "wall_distribution_count": 1,
        "wall_sequence": "inner wall/outer wall",
        "is_infill_first": 0,
        "precise_outer_wall": 0,  # it moves the outer wall away from the inner ones
        "only_one_wall_top": 0,
        "only_one_wall_first_layer": 0,
        "detect_thin_wall": 0,
        "detect_overhang_wall": 1,
        "enable_overhang_speed": 0,
        "fuzzy_skin": "none",
        "seam_position": SEAMS[profile.slicer.seam],
        "seam_gap": SEAM_GAP,
        "seam_slope_type": "none",
        "staggered_inner_seams": int(profile.slicer.seam == "random"),
        "wipe_on_loops": 0,
        "reduce_crossing_wall": 1,
    }


def _solid(profile: PrinterProfile) -> Mapping[str, Any]:
    return {
        "sparse_infill_density": f"{profile.slicer.infill_density:g}%",
        "sparse_infill_pattern": "rectilinear",
        "infill_wall_overlap": f"{profile.slicer.infill_overlap:g}%",
        "top_bottom_infill_wall_overlap": f"{profile.slicer.infill_overlap:g}%",
        "infill_combination": 0,
        "top_shell_layers": profile.minimum_solid_layers,
        "bottom_shell_layers": profile.minimum_solid_layers,
        "top_shell_thickness": 0,
        "bottom_shell_thickness": 0,
        "top_surface_pattern": "monotonic",
        "bottom_surface_pattern": "monotonic",
        "internal_solid_infill_pattern": "monotonic",
        "ensure_vertical_shell_thickness": "ensure_all",
        "gap_fill_target": "everywhere",
        "thick_bridges": 0,
        "bridge_flow": 1,
        "ironing_type": "no ironing",
        "interface_shells": 0,
    }


def _speeds(profile: PrinterProfile) -> Mapping[str, Any]:
    names = ("outer_wall", "inner_wall", "sparse_infill", "internal_solid_infill", "top_surface")
    more = ("gap_infill", "bridge", "internal_bridge", "initial_layer", "initial_layer_infill")
    speeds = {f"{name}_speed": profile.slicer.print_speed for name in (*names, *more)}
    return {**speeds, "small_perimeter_speed": profile.slicer.print_speed}
