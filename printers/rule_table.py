"""The table of all printability rules: what each asks, against which limit, and what follows.

A rule is a row here and a function that measures, in `printers/rules` or in a package of its own.
Documentation, JSON and the severities that a profile may set follow from the rows.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from printers.errors import quoted

Severity = Literal["fail", "warn", "info"]
"""What it means that a part does not keep a rule: it must not be printed; it may, with care; it is
good to know."""


@dataclass(frozen=True)
class Rule:
    """One printability rule.

    Attributes:
        name: As it appears in reports.
        description: What it asks, in one line.
        severity: What it means that the part does not keep it, unless the profile says otherwise.
        limit: Attribute of `PrinterProfile` that holds the limit; None where the limit is the
            design's, or no number of the printer's.
        unit: Of the limit and of what is measured; empty where it has none.
        source: Where the rule and its default limit come from.
        seals: Whether the part's tightness rests on it. Such a rule keeps its severity: an approval
            says that the part is closed, on every printer, and a profile that only warned of an
            open wall would let a leak be exported as approved.

    Examples:
        >>> from printers import RULES
        >>> rule = RULES["gap"]
        >>> print(rule.severity, rule.limit, rule.unit)
        fail minimum_gap mm
    """

    name: str
    description: str
    severity: Severity
    limit: str | None
    unit: str
    source: str
    seals: bool = False


_TOPOLOGY = "definition: a solid's boundary is closed, oriented and free of self-intersection"
_LINES = (
    "Ćurković & Jambrečić 2020, DOI 10.7906/indecs.18.4.8: three lines of the nozzle's width are "
    "airtight; Abboodi, arXiv 2608.13233: lines, not millimetres, seal"
)
_WHOLE = "Justino Netto 2024: one and a half lines give broken paths, whole ones none"
_DESIGN = "the design's own number"
_BED = "the printer's data sheet"
_SAG = "slicer guides: 10-15 mm in general, less in TPU; printing one's own test is better"
_ANGLE = "slicer guides: 45 degrees"
_STRINGS = "about one line: strings and blobs of molten TPU bridge less; not measured, test a print"
_LAYERS = "one closed layer is crossed at its seams; how many seal is the profile's to say"
_SLICED = "model of the beads, measured on broken parts: docs/leak-test.md"

_ROWS = (
    Rule("watertight", "every edge lies between exactly two triangles that run along it in "
         "opposite senses", "fail", None, "bad edges", _TOPOLOGY, True),
    Rule("self_intersection", "the surface nowhere passes through itself", "fail", None,
         "crossings", _TOPOLOGY, True),
    Rule("one_body", "exactly one shell encloses material", "fail", None, "bodies", _TOPOLOGY,
         True),
    Rule("slivers", "no triangle is so thin that a slicer rounds it to a line", "warn", None,
         "triangles", "PrusaSlicer: coordinates are rounded to 1e-6 mm, STL to 32 bits"),
    Rule("build_volume", "the part fits, standing as it is, with its length along either side of "
         "the bed", "fail", "build_volume", "mm", _BED),
    Rule("cross_section", "the extents in y and z keep the design's limits", "fail", None, "mm",
         _DESIGN),
    Rule("bed_contact", "enough of the footprint's rectangle lies flat on the bed", "fail",
         "minimum_bed_contact", "mm²", "our choice: a tenth of it keeps soft parts standing"),
    Rule("layer_height", "the layers are as thin as those that were measured to seal", "fail",
         "sealing_layer_height", "mm",
         "Zillen, printed vessels (CC0): in 140 s, from about 7.6 bar, layers of 0.06 and 0.10 mm "
         "lost at most 0.1 bar, layers of 0.15 and 0.20 mm nearly all", True),
    Rule("wall_multiple", "a declared wall is a whole number of lines or layers", "fail",
         "line_width", "lines", _WHOLE, True),
    Rule("wall_multiple_measured", "so is every wall that is found on the mesh, and none tapers",
         "fail", "line_width", "lines", _WHOLE, True),
    Rule("wall_as_declared", "every declared wall is found on the mesh, between parallel faces",
         "fail", None, "mm", _DESIGN, True),
    Rule("minimum_lines", "the weakest way out of the cavity crosses enough lines", "fail",
         "minimum_wall", "mm", _LINES, True),
    Rule("minimum_layers", "the weakest way out of the cavity, nearly upright, crosses enough "
         "layers", "fail", "minimum_floor", "mm", _LAYERS, True),
    Rule("thinnest_place", "no place of the part is thinner than one line, or one layer: a slicer "
         "leaves it out", "warn", "line_width", "mm",
         "PrusaSlicer issue 5357; CuraEngine issue 431: walls of one nozzle are dropped"),
    Rule("airtightness", "with the openings plugged there is one cavity, closed everywhere else",
         "fail", None, "", _TOPOLOGY, True),
    Rule("air_passage", "air reaches every part of the cavity through passages that stay open",
         "fail", "minimum_gap", "mm", _STRINGS),
    Rule("opening_width", "an opening lets a pin of its declared diameter enter, and one as wide "
         "as the narrowest gap", "fail", "minimum_gap", "mm", _DESIGN),
    Rule("gap", "the declared gap between bubbles stays open", "fail", "minimum_gap", "mm",
         _STRINGS),
    Rule("gap_measured", "the narrowest gap outside stays open", "fail", "minimum_gap", "mm",
         _STRINGS),
    Rule("cavity_width", "the narrowest air in the cavity stays open", "fail", "minimum_gap", "mm",
         _STRINGS),
    Rule("gap_as_declared", "the declared gap is found on the mesh", "fail", None, "mm", _DESIGN),
    Rule("bridge", "no roof spans more than the printer bridges; outside it warns", "fail",
         "maximum_bridge", "mm", _SAG),
    Rule("overhang", "no face beyond the limit hangs free", "warn", "maximum_overhang_angle",
         "mm²", _ANGLE),
    Rule("support", "says how much is printed over air inside, where supports could not be removed",
         "info", None, "mm²", "definition: a closed cavity cannot be reached"),
    Rule("mass", "says what the part weighs", "info", None, "g",
         "volume of the solid and density of the filament"),
    Rule("filament_length", "says how much filament the part takes", "info", None, "m",
         "volume of the solid, the flow and diameter of the filament"),
    Rule("print_time", "says how long printing takes at least", "info", None, "h",
         "volume of the solid over the volumetric flow at the print speed; travels not counted"),
    Rule("leak_test", "where a leak test of the G-code is required, it could be run", "fail", None,
         "", "what was not tested is not known to seal", True),
    Rule("leak_path", "in the G-code every path from the cavity to the outside crosses a bead",
         "fail", None, "of a bead's half width", _SLICED, True),
    Rule("printed_depth", "in the G-code no place is sealed by a whole line less than the profile "
         "asks for", "fail", "minimum_lines", "lines", _SLICED, True),
    Rule("seam_loss", "paths may lose a quarter of a line at their ends before a leak opens",
         "warn", None, "mm", "OrcaSlicer leaves 0.15 nozzles open at each seam"),
    Rule("printed_material", "the G-code lays down what the solid and the flow ask for", "warn",
         None, "%", _SLICED),
)  # fmt: skip

RULES: Mapping[str, Rule] = {rule.name: rule for rule in _ROWS}
"""By their names, in the order of the documentation."""


def severity_problem(name: str) -> str:
    """Why a profile may not set the severity of the rule `name`; empty if it may."""
    if name not in RULES:
        return f"there is no rule {quoted(name)}; known: {', '.join(RULES)}"
    if RULES[name].seals:
        return f"{name} keeps its severity: the part's tightness rests on it"
    if RULES[name].severity == "info":
        return f"{name} keeps its severity: it tells something and judges nothing"
    return ""
