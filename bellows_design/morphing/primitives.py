"""The boxes, sharp or rounded, whose surfaces bound the bodies that are computed.

Every body is a boolean combination of axis-parallel boxes and of the planes x = 0, y = 0, z = 0,
built in ``geometry.actuator``. A rounded box is all that lies within ``radius`` of its core, so one
formula tells the distance from its planes, cylinders and spheres; an arc is a box whose core is a
line. The boxes of neighbouring designs follow each other in the same order.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.design.indent import Indent
from bellows_design.design.lengths import snapped_radius
from solver.arrays import Reals

Indices = NDArray[np.signedinteger[Any]]
"""Numbers of rows."""

FAR = 1000.0
"""mm. Where a box ends that reaches beyond every body."""

DEGENERATE = 1e-9
"""mm. A core thinner than this is flat, as in ``geometry.named_solids.rounded_box``."""

SOLID, AIR = 1, -1


@dataclass(frozen=True)
class Box:
    """Axis-parallel box from ``lower`` to ``upper`` with edges rounded by ``radius``, mm.

    ``role``: ``SOLID`` where it adds to the body, ``AIR`` where it is taken away.
    """

    lower: tuple[float, float, float]
    upper: tuple[float, float, float]
    radius: float
    role: int

    def moved(self, x: float) -> Box:
        """The same box shifted along x, mm."""
        lower, upper = self.lower, self.upper
        return Box((lower[0] + x, *lower[1:]), (upper[0] + x, *upper[1:]), self.radius, self.role)


@dataclass(frozen=True)
class Boxes:
    """Boxes as arrays: ``core`` (m, 2, 3), lower and upper ends of the cores, ``radius`` (m,), mm.

    The core of a sharp box is the box itself. ``role`` (m,) as in :class:`Box`. ``level_floors``:
    the floors of channel and chambers lie in one plane.
    """

    core: Reals
    radius: Reals
    role: NDArray[np.int64]
    level_floors: bool


def boxes_of(design: Design, model: str, channel_end: float = 0.5) -> Boxes:
    """The boxes of a model's body; ``channel_end`` as in ``geometry.actuator.CHANNEL_ENDS``."""
    middles = (0.0,) if model == "unit-cell" else design.bellows.bubble_middles
    repeated = [box.moved(x) for x in middles for box in _of_a_bubble(design)]
    along = _of_the_cell if model == "unit-cell" else _of_the_actuator
    level = abs(design.bellows.tendon_thickness - design.bellows.bubble_thickness) < DEGENERATE
    return _arrays([*along(design, channel_end), *repeated], level)


def _arrays(boxes: list[Box], level: bool) -> Boxes:
    ends = np.array([(box.lower, box.upper) for box in boxes])
    radius = np.array([box.radius for box in boxes])
    core = ends + radius[:, None, None] * np.array([1.0, -1.0])[:, None]
    flat = np.abs(core[:, 1] - core[:, 0]) < 2 * DEGENERATE
    core = np.where(flat[:, None], core.mean(axis=1, keepdims=True), core)
    return Boxes(core, radius, np.array([box.role for box in boxes]), level)


def _of_the_cell(design: Design, _: float) -> Iterator[Box]:
    """Tendon and channel of the unit cell; the channel runs on beyond the gap's middle."""
    bellows = design.bellows
    end = bellows.pitch / 2
    yield _tendon(bellows, -end, end)
    yield _channel(bellows, -FAR, FAR)


def _of_the_actuator(design: Design, channel_end: float) -> Iterator[Box]:
    """Tendon, channel and fingertip of the whole actuator, or of half of it."""
    bellows = design.bellows
    end = bellows.bubble_middles[-1] + channel_end * bellows.channel_fillet
    yield _tendon(bellows, 0.0, bellows.length)
    yield _channel(bellows, bellows.tendon_thickness, end)
    if design.fingertip is not None:
        yield from _pad(design.fingertip, bellows.length)


def _pad(fingertip: Fingertip, start: float) -> Iterator[Box]:
    """The fingertip that begins at ``start``, and the grooves in it."""
    half, end = fingertip.width / 2, start + fingertip.length
    yield Box((start, -half, 0.0), (end, half, fingertip.thickness), 0.0, SOLID)
    for x in fingertip.grooves:
        lower, upper = start + x, start + x + fingertip.groove_width
        yield Box((lower, -FAR, -FAR), (upper, FAR, fingertip.rib_height), 0.0, AIR)


def _tendon(bellows: BellowsParameters, start: float, stop: float) -> Box:
    half = bellows.tendon_width / 2
    return Box((start, -half, 0.0), (stop, half, bellows.tendon_height), 0.0, SOLID)


def _channel(bellows: BellowsParameters, start: float, stop: float) -> Box:
    half, wall = bellows.channel_width / 2, bellows.tendon_thickness
    lower, upper = (start, -half, wall), (stop, half, bellows.tendon_height - wall)
    return Box(lower, upper, bellows.channel_fillet, AIR)


def _of_a_bubble(design: Design) -> Iterator[Box]:
    """Bubble, chamber and indent about x = 0."""
    bellows = design.bellows
    length, width, height = bellows.bubble_size
    lower, upper = (-length / 2, -width / 2, -FAR), (length / 2, width / 2, height)
    yield Box(lower, upper, bellows.bubble_fillet, SOLID)
    length, width, height = bellows.chamber_size
    floor = bellows.bubble_thickness
    lower, upper = (-length / 2, -width / 2, floor), (length / 2, width / 2, floor + height)
    yield Box(lower, upper, bellows.chamber_fillet, AIR)
    if design.indent is not None:
        yield _groove(design.indent, bellows)


def _groove(indent: Indent, bellows: BellowsParameters) -> Box:
    if indent.side == "inside":
        return _inside_groove(indent, bellows)
    half = indent.width / 2
    if indent.shape == "arc":  # a circle through (-half, 0), (0, depth), (half, 0)
        radius = (half**2 + indent.depth**2) / (2 * indent.depth)
        axis = indent.depth - radius
        lower, upper = (-radius, -FAR, axis - radius), (radius, FAR, indent.depth)
        return Box(lower, upper, radius, AIR)
    return Box((-half, -FAR, -FAR), (half, FAR, indent.depth), indent.fillet, AIR)


def _inside_groove(indent: Indent, bellows: BellowsParameters) -> Box:
    x, y, z = indent.inside_size(bellows)
    bottom = bellows.bubble_thickness - indent.depth
    radius = snapped_radius(indent.fillet, min(x, y, z) / 2)
    return Box((-x / 2, -y / 2, bottom), (x / 2, y / 2, bottom + z), radius, AIR)
