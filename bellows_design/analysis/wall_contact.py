"""Which walls touch under pressure, and how near the others come.

The unit cell models contact with its mirror images: of neighbouring bubbles, and of a chamber's
opposite walls. Half and full actuators model none, nor does the cell between walls of its own that
are no mirror images, such as floor and roof of the channel: there a solve stops at the first touch,
by ``touch_guard``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.cell_chain import chain
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.geometry.face_names import CAVITY, OUTSIDE, ROOT, SYMMETRY, TIP
from solver import Mesh
from solver.mesh.proximity import OPPOSING, Gaps, facet_normals, facing_gaps

if TYPE_CHECKING:
    from solver import Problem, Solution
    from solver.assembly.state import State
    from solver.nonlinear.events import Guard

NEIGHBOURS, OUTER, INSIDE = "neighbouring bubbles", "outer walls", "inner walls"
ITSELF = "distant parts"

UNMODELLED = "this model lets walls through each other: its result does not hold past the touch"
PARTLY = (
    "walls of one bubble meet where no contact is modelled: the result does not hold past the touch"
)
OVERLAP = (
    "distant parts of the actuator run through each other, as past a full turn: what they exert on "
    "each other is not modelled"
)
FREE_ENDS = "as inner walls touch, each end is taken as half a bubble without a neighbour"


@dataclass(frozen=True)
class WallContact:
    """How near walls come to each other.

    ``detected``: walls touch or run into each other: those of neighbouring bubbles, others outside,
    or opposite ones inside. ``min_gap_mm``, ``inner_gap_mm``: narrowest air between the former and
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

    @property
    def void(self) -> bool:
        """True if walls run through each other that do not in reality: the result does not hold."""
        return self.detected and not self.modelled

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for each thing that makes the result less reliable than it looks."""
        found = (self.note, OVERLAP if self.overlaps_itself else "")
        return tuple(f"{sentence}." for sentence in found if sentence)


def touch_guard(bellows: BellowsParameters, problem: Problem) -> Guard:
    """Refuses states of ``problem`` in which walls touch that it does not keep apart."""
    cell = problem.moving_plane is not None

    def refusal(state: State) -> str:
        if cell:
            outside, inside = _gaps_in_cell(problem.mesh, state.displacement)
            touching = _unmodelled_in_cell(bellows, outside, inside)
        else:
            found = contact_of(bellows, problem.mesh, state.displacement)
            touching = tuple(name for name in found.where if name != ITSELF)
        if not touching:
            return ""
        return f"{' and '.join(touching)} touch, and this model does not keep them apart"

    return refusal


def contact_of(bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray) -> WallContact:
    """Contact in an actuator, full or half, after ``displacement`` (n, 3), mm: none is modelled."""
    outer = _outer_gaps(bellows, mesh, displacement)
    inner = _inner_gap(bellows, mesh, displacement)
    touching = (*outer.touching, *((INSIDE,) if _touches(inner) else ()))
    return WallContact(
        detected=bool(touching),
        min_gap_mm=outer.narrowest,
        overlaps_itself=outer.overlap,
        inner_gap_mm=inner,
        where=_with_overlap(touching, outer.overlap),
        modelled=False,
        note=UNMODELLED if touching else "",
    )


def contact_in_cell(bellows: BellowsParameters, cell: Solution) -> WallContact:
    """Contact in the actuator that a unit cell stands for, where the solver models it."""
    overlap = _overlaps_itself(bellows, cell)
    outer, inner = image_gap(cell, OUTSIDE, CAVITY)
    outside, inside = _gaps_in_cell(cell.problem.mesh, cell.displacement)
    missed, within = _unmodelled_in_cell(bellows, outside, inside), _narrowest(inside)
    modelled = {NEIGHBOURS: _touches(outer), INSIDE: _touches(inner)}
    touching = tuple(
        name for name in (NEIGHBOURS, OUTER, INSIDE) if modelled.get(name) or name in missed
    )
    return WallContact(
        detected=bool(touching),
        min_gap_mm=outer,
        overlaps_itself=overlap,
        inner_gap_mm=min((gap for gap in (inner, within) if gap is not None), default=None),
        where=_with_overlap(touching, overlap),
        modelled=not missed,
        note=PARTLY if missed else FREE_ENDS if modelled[INSIDE] else "",
    )


def image_gap(cell: Solution, *surfaces: str) -> tuple[float | None, ...]:
    """Air (mm) between surfaces of a cell and their mirror images; negative where they touch."""
    from solver.assembly.contact import image_gaps

    contacts = cell.problem.contacts
    gaps = image_gaps(cell.problem, cell.displacement, np.array(cell.plane))
    found = [
        [gap for contact, gap in zip(contacts, gaps, strict=True) if contact.surface == surface]
        for surface in surfaces
    ]
    return tuple(min((gap for gap in own if gap is not None), default=None) for own in found)


def _overlaps_itself(bellows: BellowsParameters, cell: Solution) -> bool:
    """Whether distant parts of the actuator run through each other.

    Each bubble lies between the planes of its gaps' middles, which all meet in the centre of the
    arc. As long as these wedges make less than a full turn together, less one on either side by
    which a fold may pass its plane, distant ones cannot meet. Once all but one make a full turn,
    the tendons of the first bubble and the last, at one distance from the centre, overlap.
    """
    wedge = 2 * abs(cell.plane[0])
    if (bellows.bubble_count + 2) * wedge < 2 * np.pi:
        return False
    if (bellows.bubble_count - 1) * wedge >= 2 * np.pi:
        return True
    return _outer_gaps(bellows, *chain(bellows, cell)).overlap


def _gaps_in_cell(mesh: Mesh, displacement: np.ndarray) -> tuple[Gaps, Gaps]:
    """Gaps that are seen from the outside of a cell, and those seen from its cavity."""
    walls = (OUTSIDE, CAVITY)
    gaps = facing_gaps(mesh, displacement, *mesh.surfaces, seen_from=walls)
    outside, inside = (gaps.chosen(gaps.surfaces == number) for number in range(len(walls)))
    return outside, inside


def _unmodelled_in_cell(bellows: BellowsParameters, outside: Gaps, inside: Gaps) -> tuple[str, ...]:
    """Names of walls of a cell that touch each other, not their mirror images."""
    folded = (outside.distances[~_in_notch(bellows, outside)] <= 0).any()
    names = {OUTER: folded, INSIDE: _touches(_narrowest(inside))}
    return tuple(name for name, touching in names.items() if touching)


def _in_notch(bellows: BellowsParameters, gaps: Gaps) -> np.ndarray:
    """Which gaps (k,) lie where a bubble stands on the tendon, at any small distance."""
    return np.linalg.norm(gaps.starts - gaps.ends, axis=1) < bellows.bubble_distance / 2


def _narrowest(gaps: Gaps) -> float | None:
    """Narrowest air (mm), such as between the channel's floor and roof; None without any."""
    return float(gaps.distances.min()) if gaps.distances.size else None


def _touches(gap: float | None) -> bool:
    return gap is not None and gap <= 0


def _with_overlap(touching: tuple[str, ...], overlap: bool) -> tuple[str, ...]:
    return (*touching, ITSELF) if overlap else touching


@dataclass(frozen=True)
class OuterGaps:
    """``narrowest`` air between outer walls, mm; names of those ``touching``.

    ``overlap``: distant parts run through each other.
    """

    narrowest: float | None
    touching: tuple[str, ...]
    overlap: bool


def _outer_gaps(bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray) -> OuterGaps:
    """Air outside: between neighbouring bubbles, and of one bubble to root, tendon and tip."""
    gaps = facing_gaps(mesh, displacement, *_closed(mesh))
    apart = _bubbles_apart(bellows, gaps)
    notch = _in_notch(bellows, gaps)
    near = gaps.distances[(apart <= 1) & ~notch]
    names = {NEIGHBOURS: apart == 1, OUTER: apart == 0}
    return OuterGaps(
        narrowest=float(near.min()) if near.size else None,
        touching=tuple(
            name for name, pairs in names.items() if (gaps.distances[pairs & ~notch] <= 0).any()
        ),
        overlap=bool((gaps.distances[apart > 1] < 0).any()),
    )


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
