"""Closing the declared openings of a part with small solid plugs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from printers.arrays import Flags, Floats
from printers.errors import PrintersError
from printers.measure.shells import Shells, split_shells
from printers.measure.surface import Surface, merged_surface
from printers.model import Opening

if TYPE_CHECKING:
    from manifold3d import Manifold

PLUG_MARGIN = 0.1  # mm wider than the bore: more than a facet's chord error, less than a line
PLUG_SIDES = 64


@dataclass(frozen=True)
class Sealing:
    """The part as it is (`part`) and with its declared openings plugged (`closed`)."""

    part: Shells
    closed: Shells
    openings: tuple[Opening, ...]

    @property
    def openings_closed(self) -> int:
        """Openings the plugs really closed; each one added two to the Euler characteristic."""
        before = self.part.surface.euler_characteristic()
        return (self.closed.surface.euler_characteristic() - before) // 2

    @property
    def may_leak(self) -> bool:
        """Whether the plugs met the part, and yet no cavity closes."""
        joined = len(self.closed.bodies) <= len(self.part.bodies)
        closed = bool(self.part.voids or self.closed.voids)
        return bool(self.openings) and joined and not closed

    @property
    def leaks(self) -> bool:
        """Whether the plugs closed openings of the part, and yet no cavity closes.

        A plug beside which a crack is open closes none.
        """
        return self.may_leak and self.openings_closed > 0


def seal(part: Shells, openings: Sequence[Opening]) -> Sealing:
    """Plug the openings of a part. Raises PrintersError if its surface bounds no solid."""
    if not (part.surface.is_closed and part.surface.volume() > 0):
        raise PrintersError("the mesh is not closed with its normals pointing outwards")
    return Sealing(part, split_shells(plugged(part.surface, openings)), tuple(openings))


def plugged(surface: Surface, openings: Sequence[Opening]) -> Surface:
    """The surface of the part with a plug in every opening.

    A plug is a cylinder around the mouth's axis, reaching one radius into and out of the part.
    Raises PrintersError if the surface bounds no solid.
    """
    solid = solid_of(surface)
    for opening in openings:
        solid = solid + _plug(opening)
    mesh = solid.to_mesh64()
    return merged_surface(mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64))


def solid_of(surface: Surface) -> Manifold:
    """The solid within a closed surface. Raises PrintersError if there is none."""
    from manifold3d import Manifold, Mesh64

    solid = Manifold(Mesh64(surface.vertices, surface.triangles.astype(np.uint64)))
    status = solid.status().name
    if status != "NoError":
        raise PrintersError(f"the mesh bounds no solid ({status}); it cannot be plugged")
    return solid


def frame_of(opening: Opening) -> Floats:
    """(3, 3): a right-handed frame of unit columns, the last of which points out of the opening."""
    axis = np.asarray(opening.direction) / np.linalg.norm(opening.direction)
    helper = np.eye(3)[np.abs(axis).argmin()]
    first = np.cross(helper, axis)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(axis, first), axis])


def near_axis(points: Floats, opening: Opening, depth: float) -> Flags:
    """(k,): which points (k, 3) lie in the plug or up to `depth` mm behind the mouth."""
    axis = np.asarray(opening.direction) / np.linalg.norm(opening.direction)
    offset = points - np.asarray(opening.centre)
    along = offset @ axis
    beside = np.linalg.norm(offset - along[:, None] * axis, axis=1)
    slack = 1e-3
    within = beside <= opening.plug_radius + PLUG_MARGIN + slack
    return (
        within & (along >= -max(depth, opening.radius) - slack) & (along <= opening.radius + slack)
    )


def _plug(opening: Opening) -> Manifold:
    from manifold3d import Manifold

    cylinder = Manifold.cylinder(
        2 * opening.radius, opening.plug_radius + PLUG_MARGIN, -1.0, PLUG_SIDES, True
    )
    return cylinder.transform(np.column_stack([frame_of(opening), opening.centre]))
