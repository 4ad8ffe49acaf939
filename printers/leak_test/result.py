"""What the virtual leak test says. Places are in the part's own coordinates, mm."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any, Literal

from printers.arrays import Floats, Ints
from printers.gcode.beads import Beads
from printers.report import RuleResult

Place = tuple[float, float, float]
LeakVerdict = Literal["sealed", "marginal", "leaks"]

SURELY_SEALED = 0.95
SURELY_OPEN = 1.05
"""Bounds of r* between which nothing is decided: how far grid and bead model may be off."""


def leak_verdict(ratio: float) -> LeakVerdict:
    """What the scaled distance `r*` of the widest path means."""
    if ratio > SURELY_OPEN:
        return "leaks"
    return "sealed" if ratio < SURELY_SEALED else "marginal"


@dataclass(frozen=True)
class Leak:
    """A path of air from the cavity to the outside.

    Attributes:
        ratio: Smallest scaled distance to a bead on the path; above 1 all of it is air.
        width: Of the air at the narrowest place, mm, for beads of one line.
        place: The narrowest place.
        at_least: Whether the path may be wider.
    """

    ratio: float
    width: float
    place: Place
    at_least: bool = False


@dataclass(frozen=True)
class Depth:
    """The thinnest seal: the least plastic that a path from the cavity to the outside crosses.

    Attributes:
        lines: Of the profile's width, over voids narrower than two thirds of a line as if they were
            closed. Heights are stretched so that floors and walls are held against one limit.
        millimetres: Of plastic on that path, heights as they are.
        lines_beside_voids: Likewise in lines, but every void is open; 0 where a leak is.
        place: Middle of what is crossed; None where the cavity is open.
    """

    lines: float
    millimetres: float
    lines_beside_voids: float
    place: Place | None


@dataclass(frozen=True)
class SeamTolerance:
    """How much each path may lose at both its ends.

    Attributes:
        holds: Largest loss tried that opens no leak, mm.
        leaks_at: Smallest loss tried that opens one, mm; None if none did.
        tried: Each loss, mm, with the r* it gave.
    """

    holds: float
    leaks_at: float | None
    tried: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Material:
    """What was laid down.

    Attributes:
        volume: Of the part's beads, mm³.
        mass: g, by the density of the profile's filament.
        solid_volume: Of the solid, mm³; None if it is not known.
        flow: Multiplier of the nominal extrusion.
    """

    volume: float
    mass: float
    solid_volume: float | None
    flow: float

    @property
    def share(self) -> float | None:
        """Of what the solid needs at this flow; 1 where slicer and solid agree."""
        if self.solid_volume is None:
            return None
        return self.volume / (self.solid_volume * self.flow)


@dataclass(frozen=True, eq=False)
class LayerView:
    """The layer with the leak, or with the thinnest seal, to be drawn.

    Attributes:
        beads: Of that layer, in the frame of the G-code.
        bottom, top: Of the layer above the bed, mm.
        corner: Of the first cell of `air`, mm, in the frame of the G-code.
        voxel: Side of a cell, mm.
        air: 0 within beads, 1 air of the cavity, 2 air outside, 3 plug, 4 voids between beads and
            the narrow part of a leak.
            *Shape:* `(ny, nx)`
        path: Points of the path, mm, in the frame of the G-code.
            *Shape:* `(n, 3)`
        place: In the frame of the G-code.
        to_part: From the frame of the G-code to the part's.
            *Shape:* `(4, 4)`
    """

    beads: Beads
    bottom: float
    top: float
    corner: tuple[float, float]
    voxel: float
    air: Ints
    path: Floats
    place: Place
    to_part: Floats


@dataclass(frozen=True)
class LeakTest:
    """The virtual leak test of one sliced part.

    Attributes:
        verdict: "sealed", "leaks", or "marginal" where the model cannot tell.
        ratio: r*, the scaled distance to the nearest bead at the narrowest place of the widest
            path; below 1 every path crosses plastic.
        line_width: That `ratio` is turned into mm by.
        leaks: Widest first, at most five; none where sealed.
        depth: The thinnest seal.
        seams: None where a leak is open without any loss, or it was not asked for.
        material: Laid down.
        voxel: Side of the grid's cells, mm.
        notes: What limits the answer, one sentence each.
        rules: The results as rules of the printability check.
        view: For the picture.
    """

    verdict: LeakVerdict
    ratio: float
    line_width: float
    leaks: tuple[Leak, ...]
    depth: Depth
    seams: SeamTolerance | None
    material: Material
    voxel: float
    notes: tuple[str, ...]
    rules: tuple[RuleResult, ...]
    view: LayerView | None = field(default=None, repr=False, compare=False)

    @property
    def width(self) -> float:
        """Of the widest path of air, mm; 0 where every path crosses plastic."""
        return max(self.ratio - 1, 0.0) * self.line_width

    @property
    def margin(self) -> float:
        """By which the widest path is closed, mm of overlap between beads; 0 where it is open."""
        return max(1 - self.ratio, 0.0) * self.line_width

    def to_dict(self) -> dict[str, Any]:
        """The result for JSON, without the picture."""
        said = {"notes": list(self.notes), "rules": [asdict(rule) for rule in self.rules]}
        return self.figures() | said

    def figures(self) -> dict[str, Any]:
        """What was measured, for JSON that states rules and notes elsewhere."""
        kept = self.__dataclass_fields__.keys() - {"view", "notes", "rules"}
        record = {name: _plain(getattr(self, name)) for name in sorted(kept)}
        return record | {"width": self.width, "margin": self.margin}


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return asdict(value) if hasattr(value, "__dataclass_fields__") else value
