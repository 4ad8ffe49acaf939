"""Which walls touch under pressure, and how near the others come.

The unit cell models contact with its mirror images: of neighbouring bubbles, and of a chamber's
opposite walls. Half and full actuators model none: there walls run through each other, and the
result says so.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.cell_chain import chain
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.geometry.actuator import CAVITY, OUTSIDE, ROOT, SYMMETRY, TIP
from solver import Mesh
from solver.mesh.proximity import OPPOSING, Gaps, facet_normals, facing_gaps

if TYPE_CHECKING:
    from solver import Solution

NEIGHBOURS, INSIDE, ITSELF = "neighbouring bubbles", "inner walls", "distant parts"

UNMODELLED = "this model lets walls through each other: its result does not hold past the touch"
PARTLY = "inner walls meet where no contact is modelled: the result does not hold past the touch"
FREE_ENDS = "as inner walls touch, each end is taken as half a bubble without a neighbour"


@dataclass(frozen=True)
class WallContact:
    """How near walls come to each other.

    ``detected``: walls touch or run into each other: those of neighbouring bubbles outside, or
    opposite ones inside. ``min_gap_mm``, ``inner_gap_mm``: narrowest air between the former and
    between the latter, None if they face nothing; negative by how far they run into each other, or
    by how far modelled contact lets them. ``overlaps_itself``: distant parts of the actuator run
    through each other, as they do past a full turn. ``where``: which walls touch. ``modelled``:
    the model keeps walls apart, all those found to touch. ``note``: what that means for the result.
    """

    detected: bool
    min_gap_mm: float | None
    overlaps_itself: bool
    inner_gap_mm: float | None = None
    where: tuple[str, ...] = ()
    modelled: bool = False
    note: str = ""


def contact_of(bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray) -> WallContact:
    """Contact in an actuator, full or half, after ``displacement`` (n, 3), mm: none is modelled."""
    outer, itself = _outer_gap(bellows, mesh, displacement)
    inner = _inner_gap(bellows, mesh, displacement)
    touching = [_touches(outer), _touches(inner)]
    where = _named(touching[0], touching[1], itself)
    note = UNMODELLED if any(touching) else ""
    return WallContact(any(touching), outer, itself, inner, where, modelled=False, note=note)


def contact_in_cell(bellows: BellowsParameters, cell: Solution) -> WallContact:
    """Contact in the actuator that a unit cell stands for, where the solver models it."""
    _, itself = _outer_gap(bellows, *chain(bellows, cell))
    outer, inner = (image_gap(cell, surface) for surface in (OUTSIDE, CAVITY))
    within = _gap_within(cell)
    missed, touching = within is not None and within <= 0, [_touches(outer), _touches(inner)]
    return WallContact(
        detected=missed or any(touching),
        min_gap_mm=outer,
        overlaps_itself=itself,
        inner_gap_mm=min((gap for gap in (inner, within) if gap is not None), default=None),
        where=_named(touching[0], missed or touching[1], itself),
        modelled=not missed,
        note=PARTLY if missed else FREE_ENDS if touching[1] else "",
    )


def image_gap(cell: Solution, surface: str) -> float | None:
    """Air (mm) between a surface of a cell and its mirror images; negative where they touch."""
    from solver.assembly.contact import image_gaps

    contacts = cell.problem.contacts
    gaps = image_gaps(cell.problem, cell.displacement, np.array(cell.plane))
    own = [gap for contact, gap in zip(contacts, gaps, strict=True) if contact.surface == surface]
    return min((gap for gap in own if gap is not None), default=None)


def _gap_within(cell: Solution) -> float | None:
    """Air (mm) between a cell's own inner walls, such as the channel's floor and roof."""
    mesh = cell.problem.mesh
    others = (name for name in mesh.surfaces if name != CAVITY)
    gaps = facing_gaps(mesh, cell.displacement, CAVITY, *others, seen_from=(CAVITY,))
    return float(gaps.distances.min()) if gaps.distances.size else None


def _touches(gap: float | None) -> bool:
    return gap is not None and gap <= 0


def _named(outer: bool, inner: bool, itself: bool) -> tuple[str, ...]:
    names = zip((NEIGHBOURS, INSIDE, ITSELF), (outer, inner, itself), strict=True)
    return tuple(name for name, touching in names if touching)


def _outer_gap(
    bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray
) -> tuple[float | None, bool]:
    """Narrowest air between neighbouring bubbles, mm, and whether distant parts overlap."""
    gaps = facing_gaps(mesh, displacement, *_closed(mesh))
    apart = _bubbles_apart(bellows, gaps)
    # in the notch where a bubble stands on the tendon, facets face each other at any small distance
    notch = np.linalg.norm(gaps.starts - gaps.ends, axis=1) < bellows.bubble_distance / 2
    near = gaps.distances[(apart <= 1) & ~notch]
    narrowest = float(near.min()) if near.size else None
    return narrowest, bool((gaps.distances[apart > 1] < 0).any())


def _inner_gap(bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray) -> float | None:
    """Narrowest air between walls inside, mm; None if no inner surface is there.

    Distant parts that run through each other past a full turn do not count.
    """
    if CAVITY not in mesh.surfaces:
        return None
    seen = facing_gaps(mesh, displacement, CAVITY, *_closed(mesh), seen_from=(CAVITY,))
    gaps = seen.distances[_bubbles_apart(bellows, seen) <= 1]
    if SYMMETRY in mesh.surfaces:
        gaps = np.append(gaps, _gaps_across(mesh, displacement))
    return float(gaps.min()) if gaps.size else None


def _gaps_across(mesh: Mesh, displacement: np.ndarray) -> np.ndarray:
    """Air (k,) between inner facets and their mirror images at y = 0, mm."""
    centres, normals = facet_normals(mesh, displacement, CAVITY)
    facing = 1 - 2 * normals[:, 1] ** 2 <= OPPOSING
    return np.asarray(2 * centres[facing & (normals[:, 1] < 0), 1])


def _closed(mesh: Mesh) -> tuple[str, ...]:
    """Surfaces that together close the actuator's outside."""
    return tuple(name for name in (OUTSIDE, ROOT, TIP, SYMMETRY) if name in mesh.surfaces)


def _bubbles_apart(bellows: BellowsParameters, gaps: Gaps) -> np.ndarray:
    """How many bubbles lie between the two facets of each gap, (k,)."""
    return np.abs(_bubble(bellows, gaps.starts) - _bubble(bellows, gaps.ends))


def _bubble(bellows: BellowsParameters, places: np.ndarray) -> np.ndarray:
    """Number of the bubble each place (k, 3) is nearest to along x, (k,)."""
    nearest = np.rint((places[:, 0] - bellows.bubble_middles[0]) / bellows.pitch)
    return np.clip(nearest, 0, bellows.bubble_count - 1)
