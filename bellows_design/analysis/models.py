"""The analysis models: which body is solved for, and how it is supported and loaded.

From small to large: the unit cell that repeats in the middle of the actuator, half of the
actuator, all of it. Each is exact where the next is symmetric or uniform.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Generic, Protocol

from typing_extensions import TypeVar

from bellows_design.analysis.model_names import ModelName
from bellows_design.design.design import Design
from bellows_design.design.lengths import SMALLEST_FEATURE
from bellows_design.errors import DesignError

if TYPE_CHECKING:
    from bellows_design.geometry.meshable import Meshable
    from bellows_design.geometry.named_solids import NamedSolid
    from solver import Contact, Mesh, Problem, SlenderAxis, Solution, SolverOptions, SurfaceContact
    from solver.adaptivity.refinement import Refinement
    from solver.arrays import Reals
    from solver.nonlinear.events import Listener
    from solver.nonlinear.newton import Newton

Subject = TypeVar("Subject", default=Design)
"""What is computed: a design, or a body of one's own."""

_Solved = TypeVar("_Solved", contravariant=True)

FEWEST_BUBBLES = 3
"""From so many bubbles on there is a middle that the ends do not affect."""


PEAK_TOLERANCE = 0.03


@dataclass(frozen=True)
class Solving:
    """How a problem is solved: ``options``, who listens, where it starts and where it stops.

    ``initial``: displacement (n, 3) and hydrostatic pressure (v,), as ``transfer`` gives them;
    ``stops``: pressures asked for, MPa; ``keep`` is given what the solve leaves.
    """

    options: SolverOptions
    listener: Listener
    initial: tuple[Reals, Reals] | None = None
    stops: Sequence[float] = ()
    keep: Callable[[Newton], None] | None = None


class Solve(Protocol[_Solved]):
    """Solves a problem under the whole load of its subject."""

    def __call__(self, subject: _Solved, problem: Problem, how: Solving, /) -> Solution:
        """The last equilibrium found."""


@dataclass(frozen=True)
class AnalysisModel(Generic[Subject]):
    """A body that stands for what is computed, with its supports and its load.

    ``solid`` builds it, ``problem`` supports and loads a mesh of it; ``share`` of them make up the
    repeating part (the unit cell: a bubble) or the whole. ``levels`` meshes are used unless more
    accuracy is asked for; ``growth`` is how many times more elements each next one has, about.
    ``wall``: the thickness, mm, in which edges of a mesh are measured; ``solve`` applies the load;
    ``peak_tolerance``: wanted difference of stresses near the highest, as a fraction of it.
    """

    name: str
    solid: Callable[[Subject], Meshable]
    problem: Callable[[Subject, Mesh], Problem]
    wall: Callable[[Subject], float]
    solve: Solve[Subject]
    share: int
    levels: int
    growth: float
    peak_tolerance: float = PEAK_TOLERANCE

    @property
    def refinement(self) -> Refinement:
        """How the next mesh is made."""
        from solver.adaptivity.refinement import Refinement

        return Refinement(growth=self.growth, peak_tolerance=self.peak_tolerance)


PENETRATION = 0.005
"""In thinnest walls. Four times as much moves the angle of Prototype 1's cell in vacuum by 0.7 %,
two fifths of it by 0.3 %, with more iterations."""


def _cell_solid(design: Design) -> NamedSolid:
    from bellows_design.geometry.actuator import unit_cell

    return unit_cell(design.bellows, design.indent)


def _half_solid(design: Design) -> NamedSolid:
    from bellows_design.geometry.actuator import half_body

    return half_body(design.bellows, design.indent, design.fingertip)


def _full_solid(design: Design) -> NamedSolid:
    from bellows_design.geometry.actuator import full_body

    return full_body(design.bellows, design.indent, design.fingertip)


def _cell_problem(design: Design, mesh: Mesh) -> Problem:
    """Symmetry about the bubble's middle and about y = 0; the gap's middle stays plane.

    Behind each of these planes stands the cell's mirror image, which its walls may touch.
    """
    from bellows_design.geometry.face_names import OUTSIDE
    from solver import Contact

    neighbour = Contact(OUTSIDE, _penetration(design))
    return _cell(design, mesh, (neighbour, *_inner_contacts(design)))


def _free_cell_problem(design: Design, mesh: Mesh) -> Problem:
    """The unit cell of a bubble without neighbours: an end of the actuator, about."""
    return _cell(design, mesh, _inner_contacts(design))


def _inner_contacts(design: Design) -> tuple[Contact, ...]:
    """Of a chamber's opposite walls, along x and across."""
    from bellows_design.geometry.face_names import CAVITY
    from solver import Contact

    depth = _penetration(design)
    return Contact(CAVITY, depth, axis=0), Contact(CAVITY, depth, axis=1)


def _penetration(design: Design) -> float:
    """How far a contact pressure of the shear modulus pushes a wall through a plane, mm."""
    return PENETRATION * thinnest_wall(design)


def _cell(design: Design, mesh: Mesh, contacts: tuple[Contact, ...]) -> Problem:
    from bellows_design.geometry.face_names import BUBBLE_MIDDLE, CAVITY, GAP_MIDDLE, SYMMETRY
    from solver import Problem, SlenderAxis, Supports

    end = design.bellows.pitch / 2
    return Problem(
        mesh=mesh,
        material=design.material.hyperelastic(),
        supports=Supports(symmetry={SYMMETRY: 1, BUBBLE_MIDDLE: 0}),
        pressurised=(CAVITY,),
        axis=SlenderAxis((0.0, end / 2, end)),
        moving_plane=GAP_MIDDLE,
        sharp_edge_radius=sharp_edge_radius(design),
        contacts=contacts,
    )


def _half_problem(design: Design, mesh: Mesh) -> Problem:
    """Root face clamped, symmetry about y = 0, pressure on the whole cavity.

    Walls may touch their neighbours', and inner ones their images behind y = 0.
    """
    from bellows_design.geometry.face_names import CAVITY, SYMMETRY
    from solver import Contact

    across = Contact(CAVITY, _penetration(design), axis=1)
    return _actuator(design, mesh, {SYMMETRY: 1}, (across,))


def _full_problem(design: Design, mesh: Mesh) -> Problem:
    """Root face clamped, pressure on the whole cavity. Walls may touch their neighbours'."""
    return _actuator(design, mesh, {})


def neighbour_contacts(design: Design) -> tuple[SurfaceContact, ...]:
    """Contact of bubbles with the next ones, on a mesh ``with_bubble_walls``."""
    from bellows_design.geometry.bubble_walls import facing_walls
    from solver import SurfaceContact

    depth, reach = _penetration(design), design.bellows.bubble_length / 2
    walls = facing_walls(design.bellows)
    return tuple(SurfaceContact(front, back, depth, reach) for front, back in walls)


def _actuator(
    design: Design, mesh: Mesh, symmetry: dict[str, int], contacts: tuple[Contact, ...] = ()
) -> Problem:
    from bellows_design.geometry.bubble_walls import with_bubble_walls
    from bellows_design.geometry.face_names import CAVITY, ROOT
    from solver import Problem, Supports

    return Problem(
        mesh=with_bubble_walls(mesh, design.bellows),
        material=design.material.hyperelastic(),
        supports=Supports(clamped=(ROOT,), symmetry=symmetry),
        pressurised=(CAVITY,),
        axis=slender_axis(design),
        sharp_edge_radius=sharp_edge_radius(design),
        contacts=(*contacts, *neighbour_contacts(design)),
    )


def thinnest_wall(design: Design) -> float:
    """Thinnest wall of bubbles and tendon, mm."""
    return min(design.bellows.bubble_thickness, design.bellows.tendon_thickness)


def _solve(design: Design, problem: Problem, how: Solving) -> Solution:
    """At the design's pressure, as long as no walls touch that the model does not keep apart."""
    from bellows_design.analysis.wall_contact import touch_guard
    from solver import solve

    return solve(
        problem,
        design.load.pressure,
        how.options,
        listener=how.listener,
        initial=how.initial,
        stops=how.stops,
        guard=touch_guard(design.bellows, problem),
        keep=how.keep,
    )


UNIT_CELL = AnalysisModel(
    ModelName.UNIT_CELL.value,
    _cell_solid,
    _cell_problem,
    thinnest_wall,
    _solve,
    share=4,
    levels=3,
    growth=2.0,
)
HALF = replace(
    UNIT_CELL,
    name=ModelName.HALF.value,
    solid=_half_solid,
    problem=_half_problem,
    share=2,
    levels=2,
    growth=1.6,
)
FULL = replace(HALF, name=ModelName.FULL.value, solid=_full_solid, problem=_full_problem, share=1)
FREE_CELL = replace(UNIT_CELL, name="free-cell", problem=_free_cell_problem)
MODELS = {model.name: model for model in (UNIT_CELL, HALF, FULL)}


def choose(design: Design, name: str = "auto") -> tuple[AnalysisModel, str]:
    """The model called ``name``, or the smallest that answers for ``design``; and why.

    Raises ``DesignError`` for an unknown name.
    """
    if name != "auto":
        if name not in MODELS:
            raise DesignError(f"model = {name!r} must be one of {', '.join(('auto', *MODELS))}.")
        return MODELS[name], "as asked for"
    count = design.bellows.bubble_count
    if count >= FEWEST_BUBBLES:
        return UNIT_CELL, (
            f"{count} bubbles deform alike: a quarter of one answers for all, "
            "and a short actuator for the ends"
        )
    return HALF, (
        f"{count} bubble{'s' * (count > 1)} with an end on either side: body and load are "
        "symmetric about y = 0"
    )


def shortened(design: Design) -> Design:
    """The same actuator with one bubble only: both ends and nothing between them."""
    bellows = design.bellows
    tip = bellows.length - bellows.root_length - bellows.train_length
    numbers = bellows.model_dump() | {
        "number_of_bubbles": 1,
        "length": max(bellows.root_length + bellows.bubble_length + tip, LEAST_LENGTH),
        "offset": bellows.root_length,
    }
    short = type(bellows).model_validate(numbers)
    return design.model_copy(update={"bellows": short})


LEAST_LENGTH = 10.0
"""mm. Bound of ``BellowsParameters.length``; a longer stub at the tip changes nothing."""


def sharp_edge_radius(design: Design) -> float:
    """How near to sharp outer edges no stress is reported, mm: a printed line rounds them."""
    return min(SMALLEST_FEATURE, thinnest_wall(design) / 4)


def slender_axis(design: Design) -> SlenderAxis:
    """Stations at the root, at every bubble's and every gap's middle, and at the finger's end."""
    from solver import SlenderAxis

    bellows = design.bellows
    middles = bellows.bubble_middles
    gaps = (middle + bellows.pitch / 2 for middle in middles[:-1])
    return SlenderAxis(tuple(sorted((0.0, *middles, *gaps, design.finger_length))))
