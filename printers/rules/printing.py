"""What printing takes: layers thin enough to seal, plastic, filament and time."""

from __future__ import annotations

import math
from collections.abc import Iterator

from printers.measure.part import MeasuredPart
from printers.profile import PrinterProfile
from printers.report import RuleResult, Verdict

LEAKED = 0.15
"""mm. From this layer height on printed vessels leaked (Zillen): from 7.6 bar to 0.6 bar in a
minute; those with 0.10 mm kept 7.5 bar. Between the two nobody measured."""


def check_layer_height(part: MeasuredPart) -> Iterator[RuleResult]:
    """The layers that the profile asks for."""
    yield judged_layer_height(part.profile.layer_height, part.profile, "all layers")


def judged_layer_height(height: float, profile: PrinterProfile, where: str) -> RuleResult:
    """The layers must be as thin as those that were measured to seal on this printer.

    Args:
        height: Of the thickest layers, mm.
        profile: The printer.
        where: Which layers they are.
    """
    sealing = profile.sealing_layer_height
    if height <= sealing + 1e-9:
        verdict: Verdict = "pass"
        message = f"layers of {height:g} mm are no thicker than those that seal, {sealing:g} mm"
    elif height < LEAKED - 1e-9:
        verdict = "warn"
        message = f"layers of {height:g} mm were not measured: {sealing:g} mm seal, {LEAKED:g} leak"
    else:
        verdict = "fail"
        message = f"layers of {height:g} mm leak: those of {LEAKED:g} mm did, {sealing:g} mm seal"
    margin = round(sealing - height, 4)
    return RuleResult("layer_height", verdict, height, sealing, "mm", where, message, margin=margin)


def check_plastic(part: MeasuredPart) -> Iterator[RuleResult]:
    """What the part weighs, how much filament it takes, and how long printing takes at least."""
    profile = part.profile
    filament, flow = profile.filament, profile.slicer.flow / 100
    volume = part.shells.material * flow
    mass = volume * filament.density / 1000
    length = volume / (math.pi / 4 * filament.diameter**2) / 1000
    hours = volume / profile.volumetric_flow / 3600
    fed = f"{volume / 1000:.2f} cm³ of plastic with a flow of {flow:.0%}"
    yield _told("mass", mass, "g", f"{mass:.1f} g of {filament.name}: {fed}")
    yield _told("filament_length", length, "m", f"{length:.2f} m of filament: {fed}")
    speed = f"{profile.slicer.print_speed:g} mm/s, {profile.volumetric_flow:.2f} mm³/s"
    yield _told("print_time", hours, "h", f"at least {hours:.1f} h at {speed}, travels apart")


def _told(rule: str, value: float, unit: str, message: str) -> RuleResult:
    return RuleResult(rule, "info", round(value, 2), "", unit, "whole part", message)
