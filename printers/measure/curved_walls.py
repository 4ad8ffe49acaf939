"""Which curved walls a part has: cans and domes, but not the corners between flat walls.

A curved face that runs smoothly into a flat wall is the corner of that wall. How the wall thickens
in there depends on both fillets, from nothing where they have one centre to a sharp edge, and any
of that is sound as long as the flat wall is; so corners are not judged, whatever their radii.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.arrays import Flags, Floats, Ints
from printers.measure.slabs import STEADY_SPREAD, Slabs
from printers.measure.surface import Surface, label
from printers.tolerances import FACET_TOLERANCE, SMALLEST_AREA

SMOOTH = float(np.cos(np.radians(30.0)))  # facets of one curved face turn by less
SAME_PLANE = float(np.cos(np.radians(1.0)))
LEAST_BULGE = 1.5 * FACET_TOLERANCE  # mm
ALIKE = float(np.cos(np.radians(16.0)))
"""Faces of a curved wall: those of `slabs.PARALLEL`, and the turn of a facet."""

A_TURN = float(np.cos(np.radians(60.0)))
"""A wall that turns by more is curved on purpose; less is also found beside every round bore."""

HALF_OF_IT = (0.25, 0.75)
"""Quantiles between which a curved wall must keep its thickness: at its rim, where it runs into a
foot or a floor, it may grow."""


def on_flat_faces(surface: Surface) -> Flags:
    """(m,): triangles of flat faces; those of curved ones are facets.

    A facet of width w that turns by an angle δ to its neighbours lies w δ / 8 off the curve
    through them; where that is within the tolerance of the mesh it is a facet. So are flat strips
    that narrow, as no mesh can tell them apart.
    """
    first, second, half_edge = surface.neighbours
    cosine = np.einsum("ij,ij->i", surface.normals[first], surface.normals[second])
    coplanar = cosine >= SAME_PLANE
    face = label(len(surface.triangles), first[coplanar], second[coplanar])
    bent = (cosine >= SMOOTH) & ~coplanar
    ends = surface.vertices[surface.half_edges[half_edge[bent]]]
    length = np.tile(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), 2)
    owner = np.concatenate([face[first[bent]], face[second[bent]]])
    count = int(face.max(initial=-1)) + 1
    rim = np.bincount(owner, length, count)
    turn = np.bincount(owner, length * np.tile(np.arccos(cosine[bent]), 2), count)
    area = np.bincount(face, surface.areas, count)
    # The width is 2 area / rim, the mean angle turn / rim.
    return np.asarray((area * turn > 4 * LEAST_BULGE * rim**2) | (rim == 0))[face]


def facet_turn(surface: Surface) -> Floats:
    """(m,): degrees by which a facet turns to its neighbours at most; 0 on flat faces."""
    first, second, _ = surface.neighbours
    cosine = np.einsum("ij,ij->i", surface.normals[first], surface.normals[second])
    turn = np.where(cosine >= SMOOTH, np.degrees(np.arccos(np.clip(cosine, -1, 1))), 0.0)
    result = np.zeros(len(surface.triangles))
    np.maximum.at(result, first, turn)
    np.maximum.at(result, second, turn)
    return np.where(on_flat_faces(surface), 0.0, result)


def curved_walls(
    surface: Surface, slabs: Slabs, curved: Flags, flat: Flags, constant: Flags
) -> Iterator[Flags]:
    """Flags (k,) of the slabs of every curved standing wall, corners of flat walls left out.

    `curved` (k,): slabs of standing curved faces; `flat` (k,): those of flat walls; `constant`
    (k,): slabs around which the thickness stays the same. What neither turns nor stays constant is
    no wall: a narrow bore in a block has none.
    """
    piece = _smooth_pieces(surface)[slabs.triangle]
    curved = curved & (slabs.facing >= ALIKE)
    for number in np.setdiff1d(np.unique(piece[curved]), _with_flat_walls(slabs, piece, flat)):
        members = curved & (piece == number)
        area = members.sum() * slabs.area
        steady_area = (members & constant).sum() * slabs.area
        if steady_area >= SMALLEST_AREA or (area >= SMALLEST_AREA and _turns(slabs, members)):
            yield members & _typical(slabs, members)


def _smooth_pieces(surface: Surface) -> Ints:
    """(m,): number of the piece of standing face without sharp edges that a triangle is part of."""
    first, second, _ = surface.neighbours
    standing = np.abs(surface.normals[:, 2]) <= np.sqrt(0.5)
    turn = np.einsum("ij,ij->i", surface.normals[first], surface.normals[second])
    smooth = (turn >= SMOOTH) & standing[first] & standing[second]
    return label(len(surface.triangles), first[smooth], second[smooth])


def _with_flat_walls(slabs: Slabs, piece: Ints, flat: Flags) -> Ints:
    """Numbers of the pieces with a flat standing wall."""
    numbers, counts = np.unique(piece[flat & slabs.vertical], return_counts=True)
    return np.asarray(numbers[counts * slabs.area >= SMALLEST_AREA])


def _turns(slabs: Slabs, members: Flags) -> bool:
    normals: Floats = slabs.normal[members]
    farthest = int((normals @ normals[0]).argmin())
    return bool((normals @ normals[farthest]).min() <= A_TURN)


def _typical(slabs: Slabs, members: Flags) -> Flags:
    """(k,): all slabs if the wall tapers, otherwise those about as thick as most of it."""
    low, median, high = np.quantile(slabs.thickness[members], [HALF_OF_IT[0], 0.5, HALF_OF_IT[1]])
    if high - low > STEADY_SPREAD:
        return np.ones(len(members), dtype=bool)
    return np.asarray(np.abs(slabs.thickness - median) <= STEADY_SPREAD / 2)
