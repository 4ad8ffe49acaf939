"""Deliberately broken parts: each says which rule must catch it, and where the fault is.

All are made from two sound parts by one cut or one change of their triangles: a hollow box of
14.4 × 10.4 × 10.4 mm and a bellows of three bubbles, 24.6 × 16 × 16 mm, both with walls of three
0.4 mm lines and a port. They are sliced in seconds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray
from small_solids import arrays, bellows, block, bore, hollow_box, port_of

from printers import Opening

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Place = tuple[tuple[float, float, float], tuple[float, float, float]]

BELLOWS_PORT = Opening("port", (-4.0, 0.0, 3.2), (-1.0, 0.0, 0.0), 1.0)
BOX_PORT = port_of()


@dataclass(frozen=True, eq=False)
class BrokenPart:
    """A part with one fault.

    Attributes:
        vertices: mm.
            *Shape:* `(n, 3)`
        triangles: Numbers of their vertices.
            *Shape:* `(m, 3)`
        opening: The port.
        rule: Name of the rule that must find the fault; empty for a sound part.
        place: Lower and upper corner of the box around the fault, mm.
        verdict: Of the rule.
    """

    vertices: Floats
    triangles: Ints
    opening: Opening
    rule: str = ""
    place: Place = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    verdict: str = "fail"

    def distance(self, point: Iterable[float]) -> float:
        """From a point to the fault, mm."""
        at = np.asarray(list(point))
        return float(np.linalg.norm(at - np.clip(at, *np.asarray(self.place))))


def sound_bellows() -> BrokenPart:
    """Three bubbles on a tendon with a channel, and a port; nothing is wrong with it."""
    return BrokenPart(*arrays(_bellows()), BELLOWS_PORT)


def sound_box() -> BrokenPart:
    """A hollow box with a port in a wall; nothing is wrong with it."""
    return BrokenPart(*arrays(hollow_box()), BOX_PORT)


# Cuts through the wall. The middle bubble lies at x = 10.6 to 15.0, its chamber at 11.8 to 13.8.


def pin_hole_in_wall(diameter: float = 0.2) -> BrokenPart:
    """A round hole across the side wall of the middle bubble."""
    hole = bore(diameter / 2, (12.8, 6.5, 8.0), 2.0, axis=1)
    return _cut(_bellows(), hole, "airtightness", ((12.8, 6.8, 8.0), (12.8, 8.0, 8.0)))


def pin_hole_in_roof(diameter: float = 0.2) -> BrokenPart:
    """A round hole up through the roof of the middle bubble."""
    hole = bore(diameter / 2, (12.8, 0.0, 14.5), 2.0, axis=2)
    return _cut(_bellows(), hole, "airtightness", ((12.8, 0.0, 14.8), (12.8, 0.0, 16.0)))


def slit_between_bubbles(width: float = 0.2) -> BrokenPart:
    """An upright slit of 4 mm in the wall between the middle bubble and the gap behind it."""
    slit = block((1.6, width, 4.0), (13.6, -width / 2, 7.0))
    return _cut(_bellows(), slit, "airtightness", ((13.8, 0.0, 7.0), (15.0, 0.0, 11.0)))


def unsealed_root(width: float = 0.2) -> BrokenPart:
    """A slit across the tendon's roof where the middle bubble stands on it."""
    slit = block((width, 2.0, 2.4), (15.1, -1.0, 4.0))
    return _cut(_bellows(), slit, "airtightness", ((15.1, -1.0, 4.4), (15.1 + width, 1.0, 6.0)))


# Walls that are closed, but too thin.


def thin_wall(remaining: float = 0.8) -> BrokenPart:
    """A pocket of 1.5 × 1.5 mm outside, in the side wall of the middle bubble."""
    pocket = block((1.5, 2.0, 1.5), (12.05, 6.8 + remaining, 7.25))
    place = ((12.05, 6.8, 7.25), (13.55, 6.8 + remaining, 8.75))
    return _cut(_bellows(), pocket, "minimum_lines", place)


def dent_inside(remaining: float = 0.5) -> BrokenPart:
    """A round dent of 1.6 mm inside, in the side wall of the middle bubble."""
    depth, radius = 1.2 - remaining, 0.8
    ball = Manifold.sphere(1.0, 64).scale((radius, depth, radius)).translate((12.8, 6.8, 8.0))
    place = ((12.8, 8.0 - remaining, 8.0), (12.8, 8.0, 8.0))
    return _cut(_bellows(), ball, "minimum_lines", place)


def thin_roof(remaining: float = 0.4) -> BrokenPart:
    """A pocket of 1.5 × 1.5 mm in the roof of the middle bubble, from outside."""
    pocket = block((1.5, 1.5, 2.0), (12.05, -0.75, 14.8 + remaining))
    place = ((12.05, -0.75, 14.8), (13.55, 0.75, 14.8 + remaining))
    return _cut(_bellows(), pocket, "minimum_layers", place)


def vanishing_fin(thickness: float = 0.25) -> BrokenPart:
    """A fin outside, on the box's roof, thinner than a line: a slicer leaves it out."""
    fin = block((4.0, thickness, 3.0), (5.0, 5.0, 10.3))
    place = ((5.0, 5.0, 10.4), (9.0, 5.0 + thickness, 13.3))
    return BrokenPart(*arrays(hollow_box() + fin), BOX_PORT, "thinnest_place", place)


def two_and_a_half_lines() -> BrokenPart:
    """A box with standing walls of 1 mm."""
    place = ((0.0, 0.0, 0.0), (14.0, 10.0, 10.4))
    port = port_of(wall=1.0)
    return BrokenPart(*arrays(hollow_box(wall=1.0)), port, "wall_multiple_measured", place)


def tapered_wall() -> BrokenPart:
    """A box whose wall at y = 10.4 is 1.2 mm thick at one end and 1.9 mm at the other."""
    corners = [(x, y, z) for z in (0.0, 10.4) for x, y in ((0, 10.3), (0, 10.4), (14.4, 10.3))]
    wedge = Manifold.hull_points(np.array([*corners, (14.4, 11.1, 0.0), (14.4, 11.1, 10.4)]))
    place = ((0.0, 9.2, 0.0), (14.4, 11.1, 10.4))
    whole = arrays(hollow_box() + wedge)
    return BrokenPart(*whole, BOX_PORT, "wall_multiple_measured", place)


# Air: cavities that do not meet, or too narrowly, and walls that fuse.


def second_cavity() -> BrokenPart:
    """The channel to the last bubble is closed by a wall: its chamber is a cavity of its own."""
    wall = block((1.2, 2.8, 2.8), (15.0, -1.4, 1.6))
    place = ((16.2, -6.8, 1.2), (19.4, 6.8, 14.8))
    return BrokenPart(*arrays(_bellows() + wall), BELLOWS_PORT, "airtightness", place)


def blocked_channel(width: float = 0.2) -> BrokenPart:
    """The channel to the last bubble is closed but for a hole of that diameter."""
    wall = block((1.2, 2.8, 2.8), (15.0, -1.4, 1.6)) - bore(width / 2, (14.0, 0.0, 3.0), 4.0)
    place = ((15.0, 0.0, 3.0), (16.2, 0.0, 3.0))
    return BrokenPart(*arrays(_bellows() + wall), BELLOWS_PORT, "air_passage", place)


def fused_gap(width: float = 0.2) -> BrokenPart:
    """Two bubbles so close to each other that their walls fuse."""
    place = ((9.4, -8.0, 0.0), (9.4 + width, 8.0, 16.0))
    body = bellows(1.2, tendon_wall=1.6, chamber=2.0, gap=width, bubbles=2)
    return BrokenPart(*arrays(body), BELLOWS_PORT, "gap_measured", place)


def narrow_port() -> BrokenPart:
    """A ring in the port's mouth leaves 1.2 of the 2 mm that the tube needs."""
    ring = bore(1.1, (-4.0, 0.0, 3.2), 0.6) - bore(0.6, (-5.0, 0.0, 3.2), 3.0)
    place = ((-4.0, -1.0, 2.2), (-3.4, 1.0, 4.2))
    return BrokenPart(*arrays(_bellows() + ring), BELLOWS_PORT, "opening_width", place)


def long_bridge(span: float = 14.0) -> BrokenPart:
    """A box with a flat roof over air, wider than a printer bridges."""
    inner = (span, span, 8.0)
    place = ((1.2, 1.2, 9.2), (1.2 + span, 1.2 + span, 10.4))
    return BrokenPart(*arrays(hollow_box(inner=inner)), port_of(inner=inner), "bridge", place)


def on_a_foot() -> BrokenPart:
    """The box on a narrow foot, which leaves nearly all of its floor above the bed."""
    raised = hollow_box().translate((0.0, 0.0, 2.0)) + block((2.0, 2.0, 2.1), (6.0, 4.0, 0.0))
    port = Opening("port", (0.0, 5.2, 7.2), (-1.0, 0.0, 0.0), 1.0)
    return BrokenPart(*arrays(raised), port, "bed_contact", ((6.0, 4.0, 0.0), (8.0, 6.0, 0.0)))


# Faults of the mesh.


def flipped_shell() -> BrokenPart:
    """A second cavity whose shell looks outwards, as if it were a body inside another."""
    part = second_cavity()
    return _changed(part, _flipped(part.triangles, _of_shell(part, part.place)), "one_body")


def inverted_normals() -> BrokenPart:
    """The box with all its triangles the other way round."""
    part = sound_box()
    everywhere = np.ones(len(part.triangles), dtype=bool)
    place = ((0.0, 0.0, 0.0), (14.4, 10.4, 10.4))
    return _changed(part, _flipped(part.triangles, everywhere), "one_body", place)


def flipped_triangle() -> BrokenPart:
    """One triangle of the bellows the other way round."""
    part = sound_bellows()
    chosen = np.arange(len(part.triangles)) == _small_triangle(part)
    return _changed(part, _flipped(part.triangles, chosen), "watertight", _around(part, chosen))


def open_edge() -> BrokenPart:
    """The bellows without one of its triangles."""
    part = sound_bellows()
    chosen = np.arange(len(part.triangles)) == _small_triangle(part)
    return _changed(part, part.triangles[~chosen], "watertight", _around(part, chosen))


def two_parts_in_one_file() -> BrokenPart:
    """The box, and a cube of 3 mm beside it."""
    both = hollow_box() + block((3.0, 3.0, 3.0), (20.0, 3.0, 0.0))
    place = ((20.0, 3.0, 0.0), (23.0, 6.0, 3.0))
    return BrokenPart(*arrays(both), BOX_PORT, "one_body", place)


def self_intersection() -> BrokenPart:
    """The box, and a cube that runs into its wall and was not united with it."""
    (first, cells), (second, others) = arrays(hollow_box()), arrays(block((3, 3, 3), (13.8, 3, 3)))
    triangles = np.concatenate([cells, others + len(first)])
    place = ((13.8, 3.0, 3.0), (14.4, 6.0, 6.0))
    whole = np.concatenate([first, second]), triangles
    return BrokenPart(*whole, BOX_PORT, "self_intersection", place)


def sliver_triangles(height: float = 1e-6) -> BrokenPart:
    """The box with a vertex so close to an edge that the triangle between them is a needle."""
    part = sound_box()
    areas = np.linalg.norm(_normals(part), axis=1)
    corners = part.triangles[int(areas.argmax())]
    a, b, c = part.vertices[corners]
    inwards = c - a - (b - a) * ((c - a) @ (b - a)) / ((b - a) @ (b - a))
    point = (a + b) / 2 + height * inwards / np.linalg.norm(inwards)
    number, (first, second, third) = len(part.vertices), corners
    parts = [[first, second, number], [second, third, number], [third, first, number]]
    triangles = np.concatenate([np.delete(part.triangles, int(areas.argmax()), axis=0), parts])
    low, high = np.minimum(a, b), np.maximum(a, b)
    place = (tuple(low.tolist()), tuple(high.tolist()))
    vertices = np.concatenate([part.vertices, [point]])
    return BrokenPart(vertices, triangles, BOX_PORT, "slivers", place, "warn")


SOUND: Mapping[str, Callable[[], BrokenPart]] = {
    "sound bellows": sound_bellows,
    "sound box": sound_box,
}

BROKEN: Mapping[str, Callable[[], BrokenPart]] = {
    "pin hole of 0.2 mm in a wall": pin_hole_in_wall,
    "pin hole of 0.2 mm in a roof": pin_hole_in_roof,
    "slit of 0.2 mm between bubbles": slit_between_bubbles,
    "slit of 0.05 mm between bubbles": lambda: slit_between_bubbles(0.05),
    "root that is not sealed": unsealed_root,
    "wall thinned to 0.8 mm": thin_wall,
    "wall thinned to 0.1 mm": lambda: thin_wall(0.1),
    "dent inside that leaves 0.5 mm": dent_inside,
    "dent inside that leaves 0.9 mm": lambda: dent_inside(0.9),
    "roof thinned to 0.4 mm": thin_roof,
    "fin of 0.25 mm": vanishing_fin,
    "walls of two and a half lines": two_and_a_half_lines,
    "wall that tapers from 1.2 to 1.9 mm": tapered_wall,
    "second cavity": second_cavity,
    "channel blocked but for 0.2 mm": blocked_channel,
    "gap of 0.2 mm": fused_gap,
    "port narrowed to 1.2 mm": narrow_port,
    "bridge of 14 mm inside": long_bridge,
    "part on a narrow foot": on_a_foot,
    "shell turned inside out": flipped_shell,
    "normals inverted": inverted_normals,
    "triangle the other way round": flipped_triangle,
    "triangle left out": open_edge,
    "two parts in one file": two_parts_in_one_file,
    "part that runs into itself": self_intersection,
    "needle of a triangle": sliver_triangles,
}
"""What is wrong, and the part with it."""


def _bellows() -> Manifold:
    return bellows(1.2, tendon_wall=1.6, chamber=2.0, gap=1.2, bubbles=3)


def _cut(solid: Manifold, tool: Manifold, rule: str, place: Place) -> BrokenPart:
    return BrokenPart(*arrays(solid - tool), BELLOWS_PORT, rule, place)


def _changed(
    part: BrokenPart, triangles: Ints, rule: str, place: Place | None = None
) -> BrokenPart:
    return BrokenPart(part.vertices, triangles, part.opening, rule, place or part.place)


def _flipped(triangles: Ints, which: NDArray[np.bool_]) -> Ints:
    return np.where(which[:, None], triangles[:, ::-1], triangles)


def _of_shell(part: BrokenPart, place: Place) -> NDArray[np.bool_]:
    """Triangles that lie within the box, as only those of one shell do."""
    low, high = np.asarray(place) + [[-1e-6], [1e-6]]
    corners = part.vertices[part.triangles]
    return np.asarray(((corners >= low) & (corners <= high)).all(axis=(1, 2)))


def _normals(part: BrokenPart) -> Floats:
    corners = part.vertices[part.triangles]
    return np.asarray(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))


def _small_triangle(part: BrokenPart) -> int:
    """Number of a triangle with all its sides between 0.1 and 2 mm."""
    corners = part.vertices[part.triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    return int(np.flatnonzero((sides > 0.1).all(axis=1) & (sides < 2.0).all(axis=1))[0])


def _around(part: BrokenPart, chosen: NDArray[np.bool_]) -> Place:
    corners = part.vertices[part.triangles[chosen]].reshape(-1, 3)
    return tuple(corners.min(axis=0).tolist()), tuple(corners.max(axis=0).tolist())
