"""The sheet of a part: how it is printed, tested, and what to do when it leaks."""

from __future__ import annotations

from collections.abc import Iterator

from bellows_design.print_sheet.blocks import Block, Heading, Paragraph, Steps, Table
from bellows_design.print_sheet.figures import (
    ALLOWED_LOSS,
    HOLD_SECONDS,
    ExpectedAngle,
    Figures,
    Wall,
)
from bellows_design.print_sheet.remedies import remedies


def sheet(figures: Figures) -> tuple[Block, ...]:
    """The sheet with the ``figures`` of a part."""
    return (*_head(figures), *_print(figures), *_test(figures), *_leaks(figures), *_limits(figures))


def _head(figures: Figures) -> Iterator[Block]:
    design = figures.design
    yield Heading(f"{design.name}: print and leak test", 1)
    if design.description:
        yield Paragraph(design.description)
    yield Paragraph(f"Design digest {design.digest}. Approved for {_load(figures)}.")


def _print(figures: Figures) -> Iterator[Block]:
    profile, slicer = figures.profile, figures.profile.slicer
    x, y, z = figures.extents
    yield Heading("Print")
    yield Table(
        ("what", "this part"),
        (
            ("printer", f"{profile.description} ({profile.name})"),
            ("filament", f"{profile.filament.description}, {profile.filament.diameter:g} mm, dry"),
            (
                "orientation",
                f"as placed in the 3MF: flat floor on the bed, {x:.1f} × {y:.1f} × {z:.1f} mm; do "
                f"not turn it over, {_supports(figures)}",
            ),
            (
                "lines and layers",
                f"nozzle {profile.nozzle_diameter:g}, line {profile.line_width:g}, layer "
                f"{profile.layer_height:g}, first layer {profile.first_layer_height:g} mm",
            ),
            (
                "temperatures",
                f"nozzle {slicer.nozzle_temperature:g} °C (first layer "
                f"{slicer.first_layer_temperature:g}), bed {slicer.bed_temperature:g} °C, fan "
                f"{slicer.fan:g} %",
            ),
            (
                "extrusion",
                f"flow {slicer.flow:g} %, {slicer.print_speed:g} mm/s, {slicer.perimeters} "
                f"perimeters, infill {slicer.infill_density:g} % with {slicer.infill_overlap:g} % "
                f"overlap, seam {slicer.seam}, retraction {'on' if slicer.retraction else 'off'}",
            ),
            ("walls", ", ".join(map(_wall, figures.walls))),
            (
                "needs",
                f"{figures.mass:.1f} g, {figures.filament_length:.2f} m of filament, more than "
                f"{figures.least_hours:.1f} h (plastic at print speed, without travels)",
            ),
        ),
    )


def _supports(figures: Figures) -> str:
    """As the settings beside the sheet have it."""
    return "with supports" if figures.profile.slicer.supports else "no supports"


def _wall(wall: Wall) -> str:
    count = f"{wall.count:.2f}".rstrip("0").rstrip(".")
    return f"{wall.name} {wall.thickness:g} mm = {count} {wall.made_of}"


def _test(figures: Figures) -> Iterator[Block]:
    pressure = figures.design.load.pressure
    yield Heading("Leak test")
    yield Paragraph(
        f"Proof pressure: {_pressure(pressure)}, the design pressure. Nothing was computed beyond "
        f"it, and {_stress(figures)}; do not go higher. The cavity holds {_volumes(figures)}."
    )
    yield Steps(
        (
            ("Look and blow.", "No gaps, threads or holes; a breath must meet resistance."),
            (
                f"{'Pump up' if pressure > 0 else 'Evacuate'} slowly to "
                f"{_pressure(figures.angles[0].pressure)}, then to {_pressure(pressure)}.",
                "Compare the angle with the table below; stop if one bubble alone bulges.",
            ),
            (
                f"Hold: wait a minute at {_pressure(pressure)}, close the valve next to the port, "
                f"read the gauge, and again after {HOLD_SECONDS} s.",
                _allowed(figures),
            ),
            (
                "Find leaks under water" if pressure > 0 else "Find leaks with soapy water outside",
                f"at {_pressure(figures.angles[0].pressure)}: bubbles show the place. Dry it "
                "inside and outside before use."
                if pressure > 0
                else "at a low pressure inside: bubbles show the place.",
            ),
        )
    )
    yield Heading("First test: does it bend as computed?")
    yield Table(
        ("pressure", "bending angle", "error of the computation"),
        tuple(map(_angle, figures.angles)),
    )
    yield Paragraph(
        "The angle is the turn of the tip against the root. The ± is the estimated error of mesh "
        "and model, not of print and filament: what these add, bellows study sensitivity says. An "
        "angle that is far too small points to walls too thick or stiff, one that is too large to "
        "walls too thin."
    )


def _angle(expected: ExpectedAngle) -> tuple[str, ...]:
    error = "not estimated" if expected.error is None else f"± {expected.error:.1f}°"
    return _pressure(expected.pressure), f"{expected.angle:.1f}°", error


def _allowed(figures: Figures) -> str:
    pressure = abs(figures.design.load.pressure)
    text = (
        f"Up to {100 * ALLOWED_LOSS:g} % ({1000 * ALLOWED_LOSS * pressure:.2g} kPa) may be lost: "
        "the plastic still creeps and the air cools; printed TPU that counted as airtight lost 10 "
        "of 220, 6 of 160 and 6 of 50 kPa in 120 s (arXiv 2609.24499)."
    )
    if figures.hole is None:
        return text
    hole = (
        f"{1000 * figures.hole:.0f} µm through the thinnest wall, {figures.thinnest.thickness:g} mm"
    )
    return f"{text} For this cavity that is one round hole of {hole}."


def _volumes(figures: Figures) -> str:
    loaded = f"{figures.volume_under_pressure / 1000:.1f} cm³ of air at that pressure"
    if figures.volume_at_rest is None:
        return loaded
    return f"{loaded}, {figures.volume_at_rest / 1000:.1f} cm³ at rest"


def _stress(figures: Figures) -> str:
    stress, percent = figures.highest_stress
    error = "" if percent is None else f" (± {percent:.1f} %)"
    limit = figures.design.max_von_mises
    return f"the highest stress there is {stress:.2f} MPa{error} of {limit:g} MPa allowed"


def _leaks(figures: Figures) -> Iterator[Block]:
    yield Heading("When it leaks: one change at a time, in this order")
    yield Steps(remedies(figures.profile))


def _limits(figures: Figures) -> Iterator[Block]:
    result, why = figures.leak_test
    tested = f"not run: {why}" if result == "not run" else result
    yield Heading("Limits")
    yield Paragraph(f"Leak test on the slicer's G-code: {tested}.")
    yield from (Paragraph(f"Warning: {warning}") for warning in figures.warnings)
    yield Paragraph(
        f"At most {_pressure(figures.design.load.pressure)}, kept by a relief valve; wear eye "
        "protection. The verdict is about a model: it knows the material's strength, not its "
        "fatigue, and the printer's rules, not the state of the filament: test again from time to "
        "time."
    )


def _load(figures: Figures) -> str:
    material = figures.design.material.name
    return f"{_pressure(figures.design.load.pressure)}, computed with {material}"


def _pressure(pressure: float) -> str:
    kind = " vacuum" if pressure < 0 else ""
    return f"{abs(pressure):.3g} MPa ({10 * abs(pressure):.3g} bar){kind}"
