"""The files of settings, for both slicers."""

from __future__ import annotations

import json
from typing import Any

import pytest

from printers import available_profiles, load_profile
from printers.slicing.orca import SEAMS, orca_settings
from printers.slicing.prusa import parsed_settings, profile_digest, prusa_settings

PROFILE = load_profile("prusa_i3")


def orca(profile: Any) -> dict[str, dict[str, Any]]:
    """machine, process, filament -> the settings."""
    return {name.split(".")[-2]: json.loads(text) for name, text in orca_settings(profile).items()}


@pytest.mark.parametrize("name", available_profiles())
def test_the_figures_are_those_of_the_profile(name: str) -> None:
    profile = load_profile(name)
    settings = parsed_settings(prusa_settings(profile))
    for key, value in {
        "nozzle_diameter": profile.nozzle_diameter,
        "layer_height": profile.layer_height,
        "first_layer_height": profile.first_layer_height,
        "extrusion_width": profile.line_width,
        "first_layer_extrusion_width": profile.line_width,
        "filament_diameter": profile.filament.diameter,
        "filament_density": profile.filament.density,
        "temperature": profile.slicer.nozzle_temperature,
        "extrusion_multiplier": profile.slicer.flow / 100,
        "perimeters": profile.slicer.perimeters,
        "perimeter_speed": profile.slicer.print_speed,
        "top_solid_layers": profile.minimum_solid_layers,
        "max_fan_speed": profile.slicer.fan,
    }.items():
        assert float(settings[key]) == pytest.approx(value), key
    assert settings["infill_overlap"] == f"{profile.slicer.infill_overlap:g}%"
    assert settings["seam_position"] == profile.slicer.seam


@pytest.mark.parametrize("name", available_profiles())
def test_both_slicers_are_asked_for_the_same(name: str) -> None:
    profile = load_profile(name)
    prusa, files = parsed_settings(prusa_settings(profile)), orca(profile)
    for key, (kind, theirs) in {
        "nozzle_diameter": ("machine", "nozzle_diameter"),
        "bed_shape": ("machine", "printable_area"),
        "max_print_height": ("machine", "printable_height"),
        "layer_height": ("process", "layer_height"),
        "first_layer_height": ("process", "initial_layer_print_height"),
        "extrusion_width": ("process", "line_width"),
        "solid_infill_extrusion_width": ("process", "internal_solid_infill_line_width"),
        "perimeters": ("process", "wall_loops"),
        "perimeter_generator": ("process", "wall_generator"),
        "fill_density": ("process", "sparse_infill_density"),
        "infill_overlap": ("process", "infill_wall_overlap"),
        "top_solid_layers": ("process", "top_shell_layers"),
        "perimeter_speed": ("process", "inner_wall_speed"),
        "slice_closing_radius": ("process", "slice_closing_radius"),
        "filament_diameter": ("filament", "filament_diameter"),
        "extrusion_multiplier": ("filament", "filament_flow_ratio"),
        "temperature": ("filament", "nozzle_temperature"),
        "filament_max_volumetric_speed": ("filament", "filament_max_volumetric_speed"),
    }.items():
        value = files[kind][theirs]
        assert (",".join(value) if isinstance(value, list) else value) == prusa[key], key
    assert files["process"]["seam_position"] == SEAMS[profile.slicer.seam]


def test_orcaslicers_files_stand_alone_and_fit_each_other() -> None:
    files = orca(PROFILE)
    assert set(files) == {"machine", "process", "filament"}
    for kind, settings in files.items():
        assert (settings["type"], settings["inherits"]) == (kind, "")
        values = [value for value in settings.values() if not isinstance(value, list)]
        values += [
            entry for value in settings.values() if isinstance(value, list) for entry in value
        ]
        assert all(isinstance(value, str) for value in values)
    for kind in ("process", "filament"):
        assert files[kind]["compatible_printers"] == [files["machine"]["name"]]


def test_the_same_profile_gives_the_same_bytes_and_another_one_others() -> None:
    assert prusa_settings(PROFILE) == prusa_settings(load_profile("prusa_i3"))
    assert orca_settings(PROFILE) == orca_settings(load_profile("prusa_i3"))
    other = PROFILE.model_copy(update={"minimum_gap": 0.5})
    assert profile_digest(other) != profile_digest(PROFILE)
    assert profile_digest(PROFILE) in prusa_settings(PROFILE).splitlines()[1]


def test_a_setting_stands_once() -> None:
    lines = [
        line for line in prusa_settings(PROFILE).splitlines() if "=" in line and line[0] != "#"
    ]
    assert len(lines) == len(parsed_settings(prusa_settings(PROFILE)))


def test_with_retraction_the_printers_own_figures_hold() -> None:
    advice = PROFILE.slicer.model_copy(update={"retraction": True})
    profile = PROFILE.model_copy(update={"slicer": advice})
    assert "retract_length" not in parsed_settings(prusa_settings(profile))
    assert "retraction_length" not in orca(profile)["machine"]
