"""The beads of plastic that a printer lays down: what G-code means for the part."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.errors import PrintersError

EXTERNAL_PERIMETER = 0
PERIMETER = 1
INFILL = 2
SOLID_INFILL = 3
BRIDGE = 4
GAP_FILL = 5
SUPPORT = 6
SKIRT = 7
OTHER = 8

KIND_NAMES = (
    "external perimeter",
    "perimeter",
    "infill",
    "solid infill",
    "bridge",
    "gap fill",
    "support",
    "skirt, brim or purge",
    "other",
)
"""By the number of the kind."""


@dataclass(frozen=True, eq=False)
class Beads:
    """Straight beads in the order in which they are printed, in the frame of the G-code.

    Arcs are parted into straight beads. Travels and moves without plastic are no beads. Very short
    beads have uncertain widths, since slicers round the filament to 10 nm and places to 1 µm: the
    width of a bead 0.01 mm long and 0.1 mm high by a tenth.

    Attributes:
        start: Of the bead's axis in the plane of its layer, mm.
            *Shape:* `(n, 2)`
        end: Likewise.
            *Shape:* `(n, 2)`
        top: Height of the nozzle above the bed, mm: the upper side of the bead.
            *Shape:* `(n,)`
        height: Of the bead, mm: as the slicer states it, or else down to the layer below.
            *Shape:* `(n,)`
        width: Of a rectangle as high as the bead that holds its plastic, mm: volume over length
            and height, from the filament that is fed.
            *Shape:* `(n,)`
        nominal_width: What the slicer states in a comment, mm; NaN where it states none.
            *Shape:* `(n,)`
        kind: Number in `KIND_NAMES`.
            *Shape:* `(n,)`
        path: Number of the unbroken extrusion the bead belongs to: beads of one path follow each
            other end to end, and plastic begins and ends to flow at the ends of a path.
            *Shape:* `(n,)`
        layer: Number of the layer, from 0: beads of one layer have the same `top`.
            *Shape:* `(n,)`
    """

    start: Floats
    end: Floats
    top: Floats
    height: Floats
    width: Floats
    nominal_width: Floats
    kind: Ints
    path: Ints
    layer: Ints

    def __len__(self) -> int:
        return len(self.start)

    def chosen(self, which: Flags | Ints) -> Beads:
        """The beads picked by flags or by number."""
        return Beads(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    @cached_property
    def length(self) -> Floats:
        """(n,) mm."""
        return np.asarray(np.linalg.norm(self.end - self.start, axis=1))

    @cached_property
    def volume(self) -> Floats:
        """(n,) mm³ of plastic."""
        return self.length * self.width * self.height

    @property
    def part_box(self) -> tuple[Floats, Floats]:
        """(3,) least and (3,) greatest coordinates of the plastic of the part, mm.

        Raises:
            PrintersError: No bead is of the part.
        """
        part = self.chosen(self.of_part)
        if not len(part):
            raise PrintersError("the G-code lays down nothing of the part")
        half = part.width[:, None] / 2
        lower = np.minimum(part.start, part.end) - half
        upper = np.maximum(part.start, part.end) + half
        return (
            np.array([*lower.min(axis=0), (part.top - part.height).min()]),
            np.array([*upper.max(axis=0), part.top.max()]),
        )

    @property
    def layer_heights(self) -> Floats:
        """(k,) mm to the micrometre: the highest bead in each layer of the part but the lowest.

        The lowest is as high as the bed needs it, and counts where there is no other. Bridges
        count for no layer: slicers may lay them as thick as the nozzle.
        """
        layered = self.of_part & (self.kind != BRIDGE)
        above = layered & (self.layer > self.layer[self.of_part].min(initial=0))
        chosen = self.chosen(above if above.any() else layered)
        layers, place = np.unique(chosen.layer, return_inverse=True)
        highest = np.zeros(len(layers))
        np.maximum.at(highest, place, chosen.height)
        return np.round(highest, 3)

    @property
    def of_part(self) -> Flags:
        """(n,): beads that are part of the part, neither support nor skirt, brim or purge."""
        return np.asarray((self.kind != SUPPORT) & (self.kind != SKIRT))
