"""What to do when a print leaks: what costs least first, each with its reason and source.

A remedy that the printer's profile has taken already is left out.
"""

from __future__ import annotations

from printers import PrinterProfile

SEALING_OVERLAP = 50.0
"""Percent: the overlap of infill and perimeters that Slic3r and its descendants allow at most
without a change of the flow; Abboodi, arXiv 2608.13233, sealed with 20 to 25."""

MORE_FLOW, MOST_FLOW = 5.0, 125.0
"""Percent: a step, and Abboodi's flow of the infill."""

MORE_HEAT = 5.0
"""°C, a step."""


def remedies(profile: PrinterProfile) -> tuple[tuple[str, str], ...]:
    """What is done, and why, in the order in which to try."""
    found = (
        ("Look where it leaks.", "A leak around the tube needs a clip or glue, not another print."),
        (
            "Dry the filament.",
            "TPU takes up water from the air; in the nozzle it boils and leaves bubbles in the "
            "lines. Follow the maker's temperature and hours.",
        ),
        (
            "Check the first layer.",
            "A leak in the floor is a nozzle too high or a dirty bed: lines lie side by side "
            "without joining.",
        ),
        *_flow(profile),
        *_heat(profile),
        *_layers(profile),
        *_overlap(profile),
        *_seam(profile),
        (
            "Print more slowly.",
            f"Half of {profile.slicer.print_speed:g} mm/s gives lines longer to join, and the "
            "extruder less to push.",
        ),
        (
            "Change the design.",
            "One more line in every wall: more lines seal better than wider ones, and bend less "
            "(Abboodi, arXiv 2608.13233). Evaluate it anew.",
        ),
    )
    return found


def _flow(profile: PrinterProfile) -> tuple[tuple[str, str], ...]:
    flow = min(profile.slicer.flow + MORE_FLOW, MOST_FLOW)
    if flow <= profile.slicer.flow:
        return ()
    why = "More plastic closes the voids between lines; too much of it makes blobs on gaps."
    return ((f"Raise the flow from {profile.slicer.flow:g} to {flow:g} %.", why),)


def _heat(profile: PrinterProfile) -> tuple[tuple[str, str], ...]:
    now = profile.slicer.nozzle_temperature
    why = "Hotter lines weld better; stop where strings begin. The stiffness changes with it."
    return ((f"Raise the nozzle from {now:g} to {now + MORE_HEAT:g} °C.", why),)


def _layers(profile: PrinterProfile) -> tuple[tuple[str, str], ...]:
    least = profile.sealing_layer_height
    if profile.layer_height <= least:
        return ()
    why = (
        "Thinner layers are pressed together better: of printed vessels those of 0.06 and 0.10 mm "
        "held 7.5 bar, those of 0.15 and 0.20 mm did not (Zillen)."
    )
    return ((f"Lower the layers from {profile.layer_height:g} to {least:g} mm.", why),)


def _overlap(profile: PrinterProfile) -> tuple[tuple[str, str], ...]:
    now = profile.slicer.infill_overlap
    if now >= SEALING_OVERLAP:
        return ()
    why = "Infill that ends before the perimeters leaves channels along them."
    return ((f"Raise the infill overlap from {now:g} to {SEALING_OVERLAP:g} %.", why),)


def _seam(profile: PrinterProfile) -> tuple[tuple[str, str], ...]:
    if profile.slicer.seam == "random":
        return ()
    why = "Seams in one line through all layers are a path for air (PrusaSlicer issue 7225)."
    return ((f"Set the seam from {profile.slicer.seam} to random.", why),)
