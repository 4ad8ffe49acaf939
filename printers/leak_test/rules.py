"""The results of the leak test as rules of the printability check, and what they are held against.

The profile says how many lines side by side and how many layers seal. A wall that misses a whole
line of them fails, one that misses half a line warns; a floor fails where it misses two layers.
Measured depths scatter by 0.15 lines about the wall's thickness, so the bounds lie off whole
numbers by more than that: a wall of two lines does not pass for one of three.
"""

from __future__ import annotations

from collections.abc import Iterator

from printers.arrays import Floats
from printers.leak_test.result import (
    SURELY_OPEN,
    SURELY_SEALED,
    Depth,
    Leak,
    Material,
    SeamTolerance,
    leak_verdict,
)
from printers.profile import PrinterProfile
from printers.profile.judging import judged
from printers.report import RuleResult, Verdict, pass_or_fail, place
from printers.rules.printing import judged_layer_height

LINES_MISSING = 0.75
LAYERS_MISSING = 1.75
LINES_LACKING = 0.5
"""From here on a wall warns."""

LEAST_BESIDE_VOIDS = 0.25
"""Lines. Parts whose voids join up have none; sound ones have half a line and more."""

LEAST_SEAM_LOSS = 0.25
"""Lines."""

MATERIAL_BAND = 0.05
"""Share by which the plastic may differ from what the solid asks for."""

SCATTER = 0.03
"""Of r*, by the grid's cells and the part's turn."""

DEPTH_SCATTER = 0.15
"""Lines."""


def least_lines(profile: PrinterProfile) -> float:
    """Depth in lines below which a part fails; half of the profile's lines at least."""
    return max(profile.minimum_lines - LINES_MISSING, profile.minimum_lines / 2)


def ample_lines(profile: PrinterProfile) -> float:
    """Depth in lines below which a part warns."""
    return max(profile.minimum_lines - LINES_LACKING, least_lines(profile))


def stretch_of_heights(profile: PrinterProfile) -> float:
    """How many times heights count, so that floors and walls fail at the same depth."""
    layers = profile.minimum_solid_layers
    least_floor = max(layers - LAYERS_MISSING, layers / 2) * profile.layer_height
    return least_lines(profile) * profile.line_width / least_floor


def leak_rules(
    ratio: float,
    leaks: tuple[Leak, ...],
    depth: Depth,
    seams: SeamTolerance | None,
    material: Material,
    layer_heights: Floats,
    profile: PrinterProfile,
) -> Iterator[RuleResult]:
    """One result for every rule, with its severity on this printer.

    `layer_heights` are those of the part's layers, (k,) mm.
    """
    results = _measured(ratio, leaks, depth, seams, material, profile)
    for result in (*results, *_layer_height(layer_heights, profile)):
        yield judged(result, profile)


def _measured(
    ratio: float,
    leaks: tuple[Leak, ...],
    depth: Depth,
    seams: SeamTolerance | None,
    material: Material,
    profile: PrinterProfile,
) -> Iterator[RuleResult]:
    yield _leak_path(ratio, leaks, profile.line_width)
    yield _printed_depth(depth, profile)
    if seams is not None:
        yield _seam_loss(seams, profile)
    if material.share is not None:
        yield _printed_material(material, material.share)


def _layer_height(heights: Floats, profile: PrinterProfile) -> Iterator[RuleResult]:
    """Of the layers that are really printed; none where all beads are bridges."""
    if not len(heights):
        return
    thick = int((heights > profile.sealing_layer_height + 1e-9).sum())
    where = f"{thick} of {len(heights)}" if 0 < thick < len(heights) else "all"
    highest = float(heights.max())
    yield judged_layer_height(highest, profile, f"{where} layers of the G-code above the first")


def _leak_path(ratio: float, leaks: tuple[Leak, ...], line_width: float) -> RuleResult:
    verdict = leak_verdict(ratio)
    weight: Verdict = {"leaks": "fail", "marginal": "warn", "sealed": "pass"}[verdict]  # type: ignore[assignment]
    where = "; ".join(place(leak.place) for leak in leaks) or "whole part"
    if verdict == "sealed":
        message = (
            f"every path from the cavity to the outside crosses plastic: beads overlap by "
            f"{(1 - ratio) * line_width:.2f} mm or more"
        )
    elif verdict == "leaks":
        named = ", ".join(f"{_width(leak)} wide at {place(leak.place)}" for leak in leaks)
        message = f"air passes between the beads: {named}"
    else:
        message = (
            f"beads only just touch at {where}: r* is {ratio:.2f}, and between {SURELY_SEALED:g} "
            f"and {SURELY_OPEN:g} the model of the beads cannot tell sealed from open"
        )
    measured, required = round(ratio, 3), SURELY_SEALED
    unit = "of a bead's half width"
    return RuleResult("leak_path", weight, measured, required, unit, where, message, SCATTER)


def _width(leak: Leak) -> str:
    return f"{'more than ' if leak.at_least else ''}{leak.width:.2f} mm"


def _printed_depth(depth: Depth, profile: PrinterProfile) -> RuleResult:
    least, ample = least_lines(profile), ample_lines(profile)
    where = place(depth.place) if depth.place else "whole part"
    thin = depth.lines < least
    verdict: Verdict = "fail" if thin else "warn" if depth.lines < ample else "pass"
    message = (
        f"the thinnest seal, at {where}, is {depth.lines:.2f} lines or {depth.millimetres:.2f} mm "
        f"of plastic deep; less than {least:g} lines fail, less than {ample:g} warn"
    )
    if depth.lines == 0:
        message = "nothing seals the cavity: air passes between the beads"
    elif not thin and depth.lines_beside_voids < LEAST_BESIDE_VOIDS:
        verdict = "fail"
        message = (
            f"voids between the beads join up through the wall: beside them only "
            f"{depth.lines_beside_voids:.2f} lines of plastic are left, and {LEAST_BESIDE_VOIDS:g} "
            f"are the least"
        )
    measured, required = round(depth.lines, 2), round(least, 2)
    return RuleResult(
        "printed_depth", verdict, measured, required, "lines", where, message, DEPTH_SCATTER
    )


def _seam_loss(seams: SeamTolerance, profile: PrinterProfile) -> RuleResult:
    least = LEAST_SEAM_LOSS * profile.line_width
    verdict = pass_or_fail(seams.holds >= least - 1e-9)
    opens = (
        f"at {seams.leaks_at:g} mm a leak opens"
        if seams.leaks_at is not None
        else "more was not tried"
    )
    message = f"seams hold up to a loss of {seams.holds:g} mm at both ends of every path; {opens}"
    measured, required = round(seams.holds, 3), round(least, 3)
    return RuleResult("seam_loss", verdict, measured, required, "mm", "whole part", message)


def _printed_material(material: Material, share: float) -> RuleResult:
    good = abs(share - 1) <= MATERIAL_BAND
    verdict = pass_or_fail(good)
    message = (
        f"{material.volume / 1000:.2f} cm³ ({material.mass:.1f} g) are laid down, {share:.1%} of "
        f"what the solid needs at a flow of {material.flow:.0%}; "
        f"{'within' if good else 'beyond'} {MATERIAL_BAND:.0%}"
    )
    measured = round(100 * share, 1)
    return RuleResult("printed_material", verdict, measured, 100.0, "%", "whole part", message)
