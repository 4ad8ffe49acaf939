"""Several actuators on one printer's bed, as an assembly with names and colours."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import TypeAlias

import cadquery as cq
import numpy as np
from numpy.typing import NDArray

from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.geometry.tessellation import ClosedMesh, tessellate
from bellows_design.plugin.parts import part_of
from bellows_design.plugin.subjects import Subject, design_of

COLOURS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442")
"""One for each design, in turn: told apart by people who see few colours too (M. Okabe, K. Ito)."""

Counted: TypeAlias = Mapping[str, int] | Sequence[Subject] | Subject
"""Designs: one, several, or how many of each name."""

ROUNDING = 1e-6
"""mm."""


@dataclass(frozen=True)
class Piece:
    """One copy of a design, at its place: ``location`` takes solid and mesh to it."""

    name: str
    design: Design
    solid: cq.Solid
    mesh: ClosedMesh
    location: cq.Location
    colour: str

    @property
    def bounds(self) -> tuple[list[float], list[float]]:
        """Lowest and highest coordinates where it stands, mm."""
        places = placed(self.mesh, self.location)
        return places.min(axis=0).tolist(), places.max(axis=0).tolist()


def plate(
    designs: Counted,
    spacing: float = 5.0,
    bed: tuple[float, float] | tuple[float, float, float] | None = None,
) -> cq.Assembly:
    """Actuators side by side in the middle of a bed, as an assembly.

    Each copy has the name of its design, from the second on with a number (``finger_2``), and each
    design a colour. They lie as they are printed, all along x or all along y, in rows.

    Args:
        designs: A design, a list of designs, or a dict from names to numbers of copies.
        spacing: Least distance between two, and from the edge of the bed, mm.
        bed: Width along x and depth along y, mm, and the height if it counts; without it that of
            the first design's printer.

    Returns:
        The assembly, in the coordinates of the bed: its front left corner is the origin. Its
        ``export`` writes STEP with these names and colours.

    Raises:
        DesignError: they do not fit, there is none, or one is no design.
        GeometryError: The CAD kernel cannot build a part.
        TessellationError: A part's triangles do not close.

    Examples:
        >>> from bellows_design.plugin import plate
        >>> pair = plate({"prototype_1": 2}, spacing=8.0)  # mm
        >>> print([piece.name for piece in pair.children])
        ['prototype_1', 'prototype_1_2']
    """
    return assembly_of(pieces(designs, spacing, bed))


def assembly_of(pieces: Sequence[Piece]) -> cq.Assembly:
    """The assembly of placed pieces."""
    assembly = cq.Assembly(name="plate")
    for piece in pieces:
        assembly.add(piece.solid, name=piece.name, loc=piece.location, color=cq.Color(piece.colour))
    return assembly


def pieces(
    designs: Counted, spacing: float = 5.0, bed: tuple[float, ...] | None = None
) -> list[Piece]:
    """The copies on the bed, placed; see ``plate``."""
    wanted = list(_each(designs))
    if not wanted:
        raise DesignError("a plate needs at least one design.")
    area = tuple(wanted[0].profile().build_volume) if bed is None else tuple(map(float, bed))
    _check(spacing, area)
    solids = {digest: part_of(each) for digest, each in {one.digest: one for one in wanted}.items()}
    meshes = {digest: tessellate(solid) for digest, solid in solids.items()}
    boxes = [_box(meshes[design.digest]) for design in wanted]
    places = _arranged(boxes, spacing, area)
    colours = {digest: COLOURS[k % len(COLOURS)] for k, digest in enumerate(solids)}
    return [
        Piece(name, design, solids[key], meshes[key], place, colours[key])
        for name, design, place in zip(_names(wanted), wanted, places, strict=True)
        for key in (design.digest,)
    ]


def _each(designs: Counted) -> Iterator[Design]:
    """Every copy by itself."""
    if isinstance(designs, Mapping) and designs and all(_is_count(n) for n in designs.values()):
        for name, count in designs.items():
            yield from [design_of(name)] * count
    elif isinstance(designs, Sequence) and not isinstance(designs, str):
        yield from (design_of(each) for each in designs)
    else:
        yield design_of(designs)


def _is_count(value: object) -> bool:
    if isinstance(value, int) and not isinstance(value, bool):
        if value < 1:
            raise DesignError(f"the number of copies must be at least 1, got {value}.")
        return True
    return False


def _names(designs: Sequence[Design]) -> Iterator[str]:
    """Names, each once: of several copies the second has a 2 behind, and so on."""
    taken: dict[str, int] = {}
    for design in designs:
        taken[design.name] = taken.get(design.name, 0) + 1
        number = taken[design.name]
        yield design.name if number == 1 else f"{design.name}_{number}"


def _check(spacing: float, area: tuple[float, ...]) -> None:
    if not (isfinite(spacing) and spacing >= 0):
        raise DesignError(f"spacing = {spacing:g} mm must be a number of at least 0.")
    if len(area) not in (2, 3) or not all(isfinite(size) and size > 0 for size in area):
        raise DesignError("bed must be two or three positive lengths in mm: width, depth, height.")


def rows_of(location: cq.Location) -> NDArray[np.float64]:
    """(4, 3): what x, y and z become, and the move; a point is a row before them."""
    motion = location.wrapped.Transformation()
    table = [[motion.Value(row, column) for row in range(1, 4)] for column in range(1, 5)]
    rows: NDArray[np.float64] = np.array(table).round(9) + 0.0
    return rows


def placed(mesh: ClosedMesh, location: cq.Location) -> NDArray[np.float64]:
    """Vertices (n, 3) of a mesh where a location takes them, mm."""
    rows = rows_of(location)
    vertices: NDArray[np.float64] = mesh.vertices @ rows[:3] + rows[3]
    return vertices


@dataclass(frozen=True)
class Box:
    """Bounds of a part as it lies, mm: where it begins, and how large it is."""

    low: tuple[float, float, float]
    size: tuple[float, float, float]


def _box(mesh: ClosedMesh) -> Box:
    """By the triangles: the CAD kernel's own boxes are some hundredths of a millimetre wider."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    return Box(tuple(low.tolist()), tuple((high - low).tolist()))


def _arranged(boxes: list[Box], spacing: float, area: tuple[float, ...]) -> list[cq.Location]:
    """Where each goes: in rows, all along x or else all along y. Raises ``DesignError``."""
    if len(area) == 3:
        highest = max(box.size[2] for box in boxes)
        if highest > area[2] + ROUNDING:
            raise DesignError(
                f"a part is {highest:.1f} mm high; the printer builds {area[2]:g} mm high."
            )
    tried = []
    for turned in (False, True):
        sizes = [(box.size[1], box.size[0]) if turned else box.size[:2] for box in boxes]
        corners, extent = _rows(sizes, spacing, area[0])
        tried.append(extent)
        if extent[0] <= area[0] + ROUNDING and extent[1] <= area[1] + ROUNDING:
            away = [(area[k] - extent[k]) / 2 for k in range(2)]
            places = [(x + away[0], y + away[1]) for x, y in corners]
            return [_location(*each, turned) for each in zip(boxes, places, strict=True)]
    width, depth = min(tried, key=lambda extent: extent[0] * extent[1])
    raise DesignError(
        f"{len(boxes)} actuator{'s' * (len(boxes) > 1)} with {spacing:g} mm around each need "
        f"{width:.0f} x {depth:.0f} mm in rows; the bed has {area[0]:g} x {area[1]:g} mm."
    )


def _rows(
    sizes: Sequence[tuple[float, ...]], spacing: float, width: float
) -> tuple[list[tuple[float, float]], tuple[float, float]]:
    """Corners (x, y) of boxes in rows of at most ``width``, the deepest first, and the extent."""
    corners = [(0.0, 0.0)] * len(sizes)
    x = y = spacing
    widest = deepest = 0.0
    for number in sorted(range(len(sizes)), key=lambda k: (-sizes[k][1], k)):
        wide, deep = sizes[number][:2]
        if x > spacing and x + wide + spacing > width + ROUNDING:
            x, y, deepest = spacing, y + deepest + spacing, 0.0
        corners[number] = (x, y)
        x += wide + spacing
        widest, deepest = max(widest, x), max(deepest, deep)
    return corners, (widest, y + deepest + spacing)


def _location(box: Box, corner: tuple[float, float], turned: bool) -> cq.Location:
    """Takes a part to the corner of its box on the bed, turned by a right angle or not."""
    x, y = corner
    if turned:  # (x, y) -> (-y, x): the box begins at -(low_y + size_y)
        shift = cq.Vector(x + box.low[1] + box.size[1], y - box.low[0], -box.low[2])
        return cq.Location(shift, cq.Vector(0, 0, 1), 90)
    return cq.Location(cq.Vector(x - box.low[0], y - box.low[1], -box.low[2]))
