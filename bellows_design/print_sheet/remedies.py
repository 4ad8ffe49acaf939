"""What to do when a print leaks: what costs least first, each with its reason and source.

Settings that the printer's profile has already are looked up in the slicer rather than changed.
"""

from __future__ import annotations

from collections.abc import Iterator

from printers import PrinterProfile

SEALING_OVERLAP = 50.0
"""Percent of a line: that of the shipped profiles, which say what it rests on."""

MORE_FLOW, MOST_FLOW = 5.0, 125.0
"""Percent: a step, our choice, and the flow of the infill in Abboodi, arXiv 2608.13233."""

MORE_HEAT = 5.0
"""°C, a step: our choice. No profile states the highest temperature that a filament's maker allows,
so the remedy names it as the bound."""

Remedy = tuple[str, str]
"""What is done, and why."""


def remedies(profile: PrinterProfile) -> tuple[Remedy, ...]:
    """In the order in which to try them."""
    return (
        ("Look where it leaks.", "A leak around the tube needs a clip or glue, not another print."),
        (
            "Dry the filament.",
            "TPU takes up water from the air; in the nozzle it boils and leaves bubbles in the "
            "lines. Keep to the maker's temperature and hours.",
        ),
        (
            "Check the first layer.",
            "A leak in the floor is a nozzle too high or a dirty bed: lines lie side by side "
            "without joining.",
        ),
        _settings(profile),
        *_flow(profile),
        _heat(profile),
        *_changes(profile),
        (
            "Print more slowly.",
            f"Below {profile.slicer.print_speed:g} mm/s the extruder has less to push, and feeds "
            "soft filament more evenly.",
        ),
        (
            "Change the design.",
            "One more line in every wall: more lines seal better than wider ones (Abboodi, arXiv "
            "2608.13233), and bend less. Evaluate it anew.",
        ),
    )


def _settings(profile: PrinterProfile) -> Remedy:
    slicer = profile.slicer
    return (
        f"Look up the slicer's settings: layers {profile.layer_height:g} mm, overlap "
        f"{slicer.infill_overlap:g} %, seam {slicer.seam}, {slicer.perimeters} perimeters.",
        "A slicer may drop what the files beside this sheet ask for; thin layers, overlap and "
        "scattered seams are what seals.",
    )


def _flow(profile: PrinterProfile) -> Iterator[Remedy]:
    flow = min(profile.slicer.flow + MORE_FLOW, MOST_FLOW)
    if flow > profile.slicer.flow:
        why = (
            "More plastic closes the voids between lines; too much of it closes gaps, too. "
            f"{MORE_FLOW:g} % are our choice of a step."
        )
        yield f"Raise the flow from {profile.slicer.flow:g} to {flow:g} %.", why


def _heat(profile: PrinterProfile) -> Remedy:
    now = profile.slicer.nozzle_temperature
    why = (
        f"Hotter lines weld better; stop where strings begin. {MORE_HEAT:g} °C are our choice of a "
        "step. The stiffness changes with it."
    )
    highest = "if the filament's maker allows it"
    return f"Raise the nozzle from {now:g} to {now + MORE_HEAT:g} °C, {highest}.", why


def _changes(profile: PrinterProfile) -> Iterator[Remedy]:
    """Settings that the profile has otherwise than what sealed."""
    slicer, thickest = profile.slicer, profile.sealing_layer_height
    if profile.layer_height > thickest:
        why = (
            "Of printed vessels those with layers of 0.06 and 0.10 mm held 7.5 bar, those with "
            "0.15 and 0.20 mm did not (Zillen)."
        )
        yield f"Lower the layers from {profile.layer_height:g} to {thickest:g} mm.", why
    if slicer.infill_overlap < SEALING_OVERLAP:
        why = "Infill that ends before the perimeters leaves channels along them."
        yield f"Raise the overlap from {slicer.infill_overlap:g} to {SEALING_OVERLAP:g} %.", why
    if slicer.seam != "random":
        why = "Seams in one line through all layers are a path for air (PrusaSlicer issue 7225)."
        yield f"Set the seam from {slicer.seam} to random.", why
