"""Half a silicone bending actuator with a film under it, as published.

P. Moseley et al., *Advanced Engineering Materials* 18, 978 (2016), and the scripts that go with it
(repository HARSHAL-IITB/spa-design-tool, MIT). x runs along the actuator from the clamped end, z
upwards from the mouths of the chambers; the half at y > 0 stands for the whole.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from io import BytesIO

import cadquery as cq
import numpy as np

from solver import Mesh
from solver.arrays import Reals
from solver.meshing import MeshOptions, Part, mesh_solids
from solver.meshing.solid import SizeField

CHAMBER_LENGTH, CHAMBER_WIDTH, CHAMBER_HEIGHT = 2.0, 8.0, 8.0  # mm, along x, y, z
TUNNEL_WIDTH, TUNNEL_HEIGHT = 2.0, 2.0  # mm


@dataclass(frozen=True)
class Actuator:
    """Dimensions of one actuator, mm.

    Attributes:
        chambers: their number.
        wall: between, beside, above and before the chambers.
        layer: of silicone between the mouths of the chambers and the film.
        film: thickness of a film that is a part of the mesh; 0 for one that is a surface.
        inlet_open: whether the tunnel goes on through the clamped end.
        clamp: length of solid added at the inlet.
        missing: chambers left out, from the clamped end on.
    """

    chambers: int
    wall: float
    layer: float = 0.5
    film: float = 0.0
    inlet_open: bool = False
    clamp: float = 0.0
    missing: int = 0

    @property
    def name(self) -> str:
        """As in the publication's data."""
        return f"c{self.chambers}-w{self.wall:g}"

    @property
    def free_length(self) -> float:
        """From the clamp to the tip, mm."""
        walls = self.chambers + 1
        return self.chambers * CHAMBER_LENGTH + walls * self.wall

    @property
    def length(self) -> float:
        """Of the whole body, mm."""
        return self.clamp + self.free_length

    @property
    def half_width(self) -> float:
        """mm."""
        return CHAMBER_WIDTH / 2 + self.wall

    @property
    def height(self) -> float:
        """Above the mouths of the chambers, mm."""
        return CHAMBER_HEIGHT + self.wall

    @property
    def bottom(self) -> float:
        """z of the lower side, mm."""
        return -self.layer - self.film

    @property
    def chamber_starts(self) -> tuple[float, ...]:
        """x of the side of each chamber that is nearer to the clamp, mm."""
        pitch = CHAMBER_LENGTH + self.wall
        first = self.clamp + self.wall
        return tuple(first + pitch * place for place in range(self.missing, self.chambers))

    @property
    def tunnel(self) -> tuple[float, float]:
        """x of both ends, mm."""
        start = self.clamp if self.inlet_open else self.chamber_starts[0]
        return start, self.length - self.wall


def solid(body: Actuator) -> cq.Solid:
    """The half with y > 0, without what is in the clamp."""
    whole = box((body.clamp, body.length), body.half_width, (-body.layer, body.height))
    for start in body.chamber_starts:
        whole = whole.cut(
            box((start, start + CHAMBER_LENGTH), CHAMBER_WIDTH / 2, (0, CHAMBER_HEIGHT))
        )
    found: cq.Solid = whole.cut(box(body.tunnel, TUNNEL_WIDTH / 2, (0, TUNNEL_HEIGHT))).val()
    return found


def box(along: tuple[float, float], half_width: float, up: tuple[float, float]) -> cq.Workplane:
    """A box from y = 0 to ``half_width``, mm."""
    size = (along[1] - along[0], half_width, up[1] - up[0])
    return cq.Workplane().box(*size, centered=False).translate((along[0], 0, up[0]))


def face_name(body: Actuator, face: cq.Face) -> str:
    """``symmetry``, ``clamp``, ``tip``, ``bottom``, ``top``, ``side`` or ``cavity``."""
    centre = face.Center()
    if centre.x < body.clamp and centre.y > 1e-6:
        return "clamp"
    planes = (
        ("symmetry", centre.y, 0.0),
        ("clamp", centre.x, 0.0),
        ("tip", centre.x, body.length),
        ("bottom", centre.z, body.bottom),
        ("top", centre.z, body.height),
        ("side", centre.y, body.half_width),
    )
    return next((name for name, at, plane in planes if abs(at - plane) < 1e-6), "cavity")


def mesh(body: Actuator, near: float, far: float) -> Mesh:
    """Edges of about ``near`` (mm) at the chambers, growing to ``far``."""
    parts = [part(body, "silicone", solid(body))]
    if body.film:
        under = box((body.clamp, body.length), body.half_width, (body.bottom, -body.layer)).val()
        parts.append(part(body, "film", under))
    if body.clamp:
        held = box((0, body.clamp), body.half_width, (body.bottom, body.height)).val()
        parts.append(part(body, "held", held))
    options = MeshOptions(size=far, elements_per_circle=0, smallest_size=min(near, far) / 2)
    coarse = mesh_solids(parts, options)
    field = SizeField(coarse, wanted_sizes(body, coarse.nodes, near, far))
    return mesh_solids(parts, replace(options, field=field))


def part(body: Actuator, name: str, shape: cq.Shape) -> Part:
    """A solid with named faces."""
    brep = BytesIO()
    shape.exportBrep(brep)
    return Part(name, brep.getvalue(), [face_name(body, face) for face in shape.Faces()])


GROWTH = 0.4
"""Of the edges per mm away from the chambers."""


def wanted_sizes(body: Actuator, points: Reals, near: float, far: float) -> Reals:
    """Edge lengths (n,) at points (n, 3), mm."""
    away = np.full(len(points), np.inf)
    for start in body.chamber_starts:
        low = np.array([start, 0.0, 0.0])
        high = np.array([start + CHAMBER_LENGTH, CHAMBER_WIDTH / 2, CHAMBER_HEIGHT])
        outside = np.maximum(np.maximum(low - points, points - high), 0.0)
        away = np.minimum(away, np.linalg.norm(outside, axis=1))
    return np.minimum(near + GROWTH * away, far)
