"""Which walls touch under pressure, and how near the others come.

The unit cell models contact with its mirror images: of neighbouring bubbles, and of a chamber's
opposite walls. Half and full actuators model that of neighbouring bubbles, the half also that of
inner walls across y = 0. No model keeps other walls apart, such as floor and roof of the channel:
there a solve stops at the first touch, by ``touch_guard``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.cell_chain import chain
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.geometry.bubble_walls import nearest_bubble, on_bubble
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
            touching = _unmodelled(
                *_found_in_actuator(bellows, problem.mesh, state.displacement, problem)
            )
        if not touching:
            return ""
        return f"{' and '.join(touching)} touch, and this model does not keep them apart"

    return refusal


def contact_of(
    bellows: BellowsParameters,
    mesh: Mesh,
    displacement: np.ndarray,
    problem: Problem | None = None,
) -> WallContact:
    """Contact in an actuator, full or half, after ``displacement`` (n, 3), mm.

    ``problem``: on that mesh, by whose contacts walls are kept apart; None if none are.
    """
    outer, inner = _found_in_actuator(bellows, mesh, displacement, problem)
    contacts = problem is not None and bool(problem.contacts)
    missed = _unmodelled(outer, inner)
    inside = (INSIDE,) if _touches(inner.narrowest) else ()
    touching = (*outer.touching, *inside)
    return WallContact(
        detected=bool(touching),
        min_gap_mm=outer.narrowest,
        overlaps_itself=outer.overlap,
        inner_gap_mm=inner.narrowest,
        where=_with_overlap(touching, outer.overlap),
        modelled=contacts and not missed,
        note="" if not missed else PARTLY if contacts else UNMODELLED,
    )


def stopped_inside(bellows: BellowsParameters, ends: Solution) -> bool:
    """Whether in an actuator inner walls that nothing keeps apart are nearest to each other."""
    problem = ends.problem
    outer, inner = _found_in_actuator(bellows, problem.mesh, ends.displacement, problem)
    gap = inner.unkept
    return gap is not None and (outer.narrowest is None or gap <= outer.narrowest)


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
    return _least(gaps.distances)


def _touches(gap: float | None) -> bool:
    return gap is not None and gap <= 0


def _with_overlap(touching: tuple[str, ...], overlap: bool) -> tuple[str, ...]:
    return (*touching, ITSELF) if overlap else touching


@dataclass(frozen=True)
class OuterGaps:
    """Air between outer walls.

    ``gaps``: which walls -> the narrowest, mm, None where nothing faces. ``overlap``: distant parts
    run through each other. ``kept``: those walls that contact keeps apart.
    """

    gaps: Mapping[str, float | None]
    overlap: bool
    kept: tuple[str, ...] = ()

    @property
    def narrowest(self) -> float | None:
        """The narrowest of all, mm."""
        return _least(*(gap for gap in self.gaps.values() if gap is not None))

    @property
    def touching(self) -> tuple[str, ...]:
        """Which walls touch."""
        return tuple(name for name, gap in self.gaps.items() if _touches(gap))

    def keeping(self, gap: float, penetration: float) -> OuterGaps:
        """The same where contact of neighbours has this narrowest gap; it keeps them if not deep.

        Facets are flat, and contact is not: they may just miss each other where it presses.
        """
        facets = self.gaps[NEIGHBOURS]
        least = gap if gap < 0 and (facets is None or gap < facets) else facets
        passed = facets is not None and facets < -DEEPEST * penetration
        kept = () if passed or gap < -FEW * penetration else (NEIGHBOURS,)
        return replace(self, gaps={**self.gaps, NEIGHBOURS: least}, kept=kept)


@dataclass(frozen=True)
class InnerGaps:
    """Narrowest air inside, mm, None if nothing faces: of all walls, and of those that nothing
    keeps apart.
    """

    narrowest: float | None
    unkept: float | None


def _found_in_actuator(
    bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray, problem: Problem | None
) -> tuple[OuterGaps, InnerGaps]:
    """Gaps outside and inside of an actuator, full or half."""
    outer = _outer_gaps(bellows, mesh, displacement)
    within, across = _inner_gaps(bellows, mesh, displacement)
    every = _least(within, across)
    if problem is None:
        return outer, InnerGaps(every, every)
    neighbours, images = _kept_apart(problem, displacement)
    if neighbours is not None:
        outer = outer.keeping(*neighbours)
    if images is None:
        return outer, InnerGaps(every, every)
    pressed = (images,) if images < 0 else ()  # else facets tell, of facing walls only
    return outer, InnerGaps(_least(within, across, *pressed), _least(within))


def _kept_apart(
    problem: Problem, displacement: np.ndarray
) -> tuple[tuple[float, float] | None, float | None]:
    """What contacts say of neighbouring bubbles, and of inner walls across y = 0.

    Of the former the narrowest gap and the penetration of contact, mm; of the latter twice the
    least distance from the plane. None where the problem has no such contact.
    """
    from solver import Contact, SurfaceContact
    from solver.assembly.contact import lowest_gaps

    gaps = lowest_gaps(problem, displacement, np.zeros(2))
    found = list(zip(problem.contacts, gaps, strict=True))
    neighbours = [(c, gap) for c, gap in found if isinstance(c, SurfaceContact)]
    across = [gap for c, gap in found if isinstance(c, Contact) and c.surface == CAVITY]
    depth = max((c.penetration for c, _ in neighbours), default=0.0)
    between = (min(gap for _, gap in neighbours), depth) if neighbours else None
    return between, 2 * min(across) if across else None


def _unmodelled(outer: OuterGaps, inner: InnerGaps) -> tuple[str, ...]:
    """Names of walls of an actuator that touch and that nothing keeps apart."""
    outside = tuple(name for name in outer.touching if name not in outer.kept)
    return (*outside, INSIDE) if _touches(inner.unkept) else outside


FEW = 3.0
"""Contact that lets neighbours in by more penetrations does not keep them apart: its pressure is as
many times the shear modulus."""

DEEPEST = 20.0
"""Neighbours deeper in each other than so many penetrations have passed through their contact; flat
facets of curved walls seem to be in each other by less."""


def _outer_gaps(bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray) -> OuterGaps:
    """Air outside: between neighbouring bubbles, and of one bubble to root, tendon and tip."""
    gaps = facing_gaps(mesh, displacement, *_closed(mesh))
    apart = _bubbles_apart(bellows, gaps)
    walls = on_bubble(bellows, gaps.starts[:, 0]) & on_bubble(bellows, gaps.ends[:, 0])
    notch = _in_notch(bellows, gaps)
    pairs = {NEIGHBOURS: (apart == 1) & walls, OUTER: (apart == 0) | ((apart == 1) & ~walls)}
    return OuterGaps(
        gaps={name: _least(gaps.distances[those & ~notch]) for name, those in pairs.items()},
        overlap=bool((gaps.distances[apart > 1] < 0).any()),
    )


def _inner_gaps(
    bellows: BellowsParameters, mesh: Mesh, displacement: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Air (k,) between walls inside, mm, and between those and their images behind y = 0.

    Distant parts that run through each other past a full turn do not count.
    """
    if CAVITY not in mesh.surfaces:
        return np.zeros(0), np.zeros(0)
    seen = facing_gaps(mesh, displacement, CAVITY, *_closed(mesh), seen_from=(CAVITY,))
    within = seen.distances[_bubbles_apart(bellows, seen) <= 1]
    mirrored = SYMMETRY in mesh.surfaces
    return within, _gaps_across(mesh, displacement) if mirrored else np.zeros(0)


def _least(*gaps: np.ndarray | float) -> float | None:
    """The least of some gaps, None without any."""
    every = np.concatenate([np.zeros(0), *(np.atleast_1d(each) for each in gaps)])
    return float(every.min()) if every.size else None


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
    start, end = (nearest_bubble(bellows, at[:, 0]) for at in (gaps.starts, gaps.ends))
    return np.abs(start - end)
