"""Small solids with known walls, cavities and openings, built with manifold3d."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold
from numpy.typing import NDArray

from printers import Opening

SEGMENTS = 96


def block(size: Iterable[float], corner: Iterable[float]) -> Manifold:
    """Box of the given size with its lowest corner at `corner`."""
    return Manifold.cube(tuple(size)).translate(tuple(corner))


def bore(radius: float, start: Iterable[float], length: float, axis: int = 0) -> Manifold:
    """Cylinder from `start` along a positive axis."""
    turned = {0: (0.0, 90.0, 0.0), 1: (-90.0, 0.0, 0.0), 2: (0.0, 0.0, 0.0)}[axis]
    cylinder = Manifold.cylinder(length, radius, radius, SEGMENTS)
    return cylinder.rotate(turned).translate(tuple(start))


def rounded_bar(
    length: float, width: float, height: float, radius: float, corner: Iterable[float]
) -> Manifold:
    """Bar along y whose cross-section (length in x, height in z) has corners of the radius."""
    core = CrossSection.square((length - 2 * radius, height - 2 * radius))
    core = core.offset(radius, JoinType.Round, circular_segments=SEGMENTS)
    bar = Manifold.extrude(core, width).rotate((90.0, 0.0, 0.0))
    x, y, z = corner
    return bar.translate((x + radius, y + width, z + radius))


def hollow_box(
    wall: float = 1.2,
    floor: float = 1.2,
    inner: tuple[float, float, float] = (12.0, 8.0, 8.0),
    port: bool = True,
) -> Manifold:
    """Box around a cavity `inner` at x, y > 0, standing on z = 0, with a round port in its x = 0
    wall, halfway up."""
    outer = block(np.add(inner, (2 * wall, 2 * wall, 2 * floor)), (0, 0, 0))
    part = outer - block(inner, (wall, wall, floor))
    if port:
        part = part - bore(1.0, (-1.0, wall + inner[1] / 2, floor + inner[2] / 2), wall + 2)
    return part


def port_of(
    wall: float = 1.2, floor: float = 1.2, inner: tuple[float, float, float] = (12.0, 8.0, 8.0)
) -> Opening:
    """The port of `hollow_box`."""
    centre = (0.0, wall + inner[1] / 2, floor + inner[2] / 2)
    return Opening("port", centre, (-1.0, 0.0, 0.0), 1.0)


def arrays(solid: Manifold) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    mesh = solid.to_mesh64()
    return mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)


def bellows(wall: float, tendon_wall: float, chamber: float, gap: float, bubbles: int) -> Manifold:
    """Bubbles with rounded ends on a tendon with a channel, a port boss standing on the bed."""
    length, pitch = chamber + 2 * wall, chamber + 2 * wall + gap
    total = 5 + bubbles * pitch - gap
    outer = [block((total, 6, 6), (0, -3, 0)), block((6.4, 7.2, 7.2), (-4, -3.6, 0))]
    inner = [
        block((total - 2 - 2 * tendon_wall, 6 - 2 * tendon_wall, 6 - 2 * tendon_wall),
              (2 + tendon_wall, tendon_wall - 3, tendon_wall)),
        bore(1.0, (-5.0, 0.0, 3.2), 12),
    ]  # fmt: skip
    for number in range(bubbles):
        x = 5 + number * pitch
        outer.append(rounded_bar(length, 16, 16, 0.45 * length, (x, -8, 0)))
        size = chamber, 16 - 2 * wall, 16 - 2 * wall
        inner.append(rounded_bar(*size, 0.4 * chamber, (x + wall, wall - 8, wall)))
    return Manifold.batch_boolean(outer, _add()) - Manifold.batch_boolean(inner, _add())


def _add() -> Any:
    from manifold3d import OpType

    return OpType.Add
