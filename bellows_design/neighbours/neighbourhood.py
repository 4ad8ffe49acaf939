"""Designs around one that was evaluated: its mesh is moved, its equilibrium is the start."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING

from bellows_design.analysis.computation import Body, Computation, Seconds, SolvedMesh
from bellows_design.analysis.evaluate import effort, evaluate, loaded_state, mesh_size
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.design.variation import between, same_topology
from bellows_design.errors import BellowsError, DesignError
from bellows_design.neighbours.carried import REACH, Carried
from bellows_design.neighbours.distance import distance
from bellows_design.neighbours.equilibrium import Equilibrium, unusable
from bellows_design.neighbours.record import NeighbourEvaluation
from bellows_design.progress import SILENCE, Progress
from solver.errors import SolverError

if TYPE_CHECKING:
    from solver import Peak, Solution
    from solver.nonlinear.newton import Newton

MOST_HALVINGS = 3
"""Of the way to a design that cannot be reached at once."""

MOST_STATES = 64
"""Solved designs that are remembered besides the first; the oldest are forgotten first."""


WITHOUT_FACTORS = 2.0
"""A solved design whose factors are gone counts as so many times as far away."""


class NotReached(BellowsError):
    """A design cannot be reached from its neighbour; the message says why."""


@dataclass(frozen=True)
class SolvedDesign:
    """A design, the equilibrium of its body on the moved mesh, and the highest stress."""

    design: Design
    solution: Solution
    peak: Peak


@dataclass(frozen=True)
class Way:
    """The states between a start and a design, its own the last."""

    solved: tuple[SolvedDesign, ...]

    @property
    def end(self) -> SolvedDesign:
        """The last of them."""
        return self.solved[-1]


class Neighbourhood:
    """A session around one ordinary evaluation: it remembers what is solved in it.

    It holds the factors of two tangents, at the ordinary evaluation and at the last design, about a
    hundred megabytes each for five thousand tetrahedra.

    Examples:
        >>> from bellows_design import evaluate, load_design, varied
        >>> from bellows_design.evaluation import Neighbourhood
        >>> design = load_design("prototype_1")
        >>> session = Neighbourhood(evaluate(design))  # once
        >>> designs = [varied(design, {"bubble_width": width}) for width in (19.8, 20.2)]
        >>> near = [session.evaluate(each) for each in designs]
        >>> print(near[0].bending_angle_deg < near[1].bending_angle_deg)  # degrees
        True
    """

    def __init__(self, anchor: Evaluation) -> None:
        """Raises ``DesignError`` if the evaluation did not reach its pressure, or is void."""
        from bellows_design.morphing.morpher import Morpher

        if reason := unusable(anchor):
            raise DesignError(
                f"near: the evaluation of {anchor.design.name} is no start for a neighbour: "
                f"{reason}."
            )
        self.anchor = anchor
        self._carried = Carried.of(anchor)
        finest, peak = anchor.computation.finest, anchor.computation.peaks[-1]
        self._morpher = Morpher.of(anchor.design, anchor.model.name, finest.problem.mesh)
        self._solved = [SolvedDesign(anchor.design, finest, peak)]
        self._newton: Newton | None = None

    def evaluate(
        self,
        design: Design,
        progress: Progress = SILENCE,
        budget: Budget = DEFAULT,
        reach: float = REACH,
    ) -> NeighbourEvaluation:
        """``design`` at its design pressure, from the nearest design that is solved here.

        Where it cannot be reached, halves of the way are tried, and at last the ordinary
        evaluation; the result says so.

        Args:
            design: What is evaluated.
            progress: Listens to stages and load.
            budget: Limits of an ordinary evaluation.
            reach: Distance up to which ends and errors are carried along. Larger ones than the
                default were not compared with evaluations by themselves: they are for searches that
                evaluate what they find by itself.

        Raises:
            BellowsError, MeshingError: As the ordinary evaluation.
        """
        try:
            return self.continued(design, reach=reach)
        except (BellowsError, SolverError) as reason:
            return ordinary(design, self.anchor.model.name, str(reason), progress, budget)

    def continued(
        self,
        design: Design,
        progress: Progress = SILENCE,
        reach: float = REACH,
        halvings: int = MOST_HALVINGS,
    ) -> NeighbourEvaluation:
        """The same without the ordinary evaluation at last: for previews, which cannot wait for it.

        ``progress`` may raise to end a solve; the way is halved no more often than ``halvings``.

        Raises:
            BellowsError, SolverError: The design cannot be reached; the message says why.
        """
        began = time.perf_counter()
        self._require_near(design, reach)
        way = self._reached(design, self._nearest(design), halvings, progress)
        found = self._judged(way)
        anchor, *others = self._solved
        self._solved = [anchor, *[*others, *way.solved][-MOST_STATES:]]
        return replace(found, seconds=Seconds(solve=time.perf_counter() - began))

    def equilibrium(self, found: NeighbourEvaluation) -> Equilibrium:
        """What the sensitivities of one of its results are taken from."""
        return Equilibrium(
            found.design,
            self.anchor.model,
            found.solution,
            self._morpher,
            self._carried,
            self._at_hand(found.solution),
        )

    def distance(self, design: Design) -> float:
        """How far a design is from that of the ordinary evaluation; infinite if no neighbour."""
        if same_topology(self.anchor.design, design, self.anchor.model.name):
            return math.inf
        return distance(self.anchor.design, design)

    def _require_near(self, design: Design, reach: float) -> None:
        """Raise ``NotReached`` for a design that ends and errors cannot be carried to."""
        anchor = self.anchor.design
        if difference := same_topology(anchor, design, self.anchor.model.name):
            raise NotReached(f"its body has other faces, {difference}")
        apart = distance(anchor, design)
        if math.isinf(apart):
            raise NotReached("its material follows another law")
        if apart > reach:
            raise NotReached(
                f"it is too far away: by {100 * apart:.3g} % in its numbers, above the "
                f"{100 * reach:g} % up to which a neighbour's ends and errors hold"
            )

    def _nearest(self, design: Design) -> SolvedDesign:
        """The solved design to start from: the nearest, rather one whose factors are at hand."""

        def length(solved: SolvedDesign) -> float:
            factor = 1.0 if self._at_hand(solved.solution) is not None else WITHOUT_FACTORS
            return factor * distance(solved.design, design)

        return min(reversed(self._solved), key=length)

    def _at_hand(self, solution: Solution) -> Newton | None:
        """What has the factors of the tangent at a solution; None if they are gone."""
        if solution is self._solved[0].solution:
            return self._at_anchor
        newton = self._newton
        return newton if newton is not None and newton.problem is solution.problem else None

    @cached_property
    def _at_anchor(self) -> Newton:
        """With the factors of the tangent at the ordinary evaluation."""
        from solver import neighbouring

        solution = self._solved[0].solution
        return neighbouring(solution.problem, solution.pressure, solution).newton

    def _reached(
        self, design: Design, start: SolvedDesign, halvings: int, progress: Progress
    ) -> Way:
        """The way to ``design``, by designs in between if it cannot be reached at once."""
        try:
            return Way((self._step(design, start, progress),))
        except NotReached:
            if halvings == 0:
                raise
        half = between(start.design, design, 0.5)
        first = self._reached(half, start, halvings - 1, progress)
        rest = self._reached(design, first.end, halvings - 1, progress)
        return Way((*first.solved, *rest.solved))

    def _step(self, design: Design, start: SolvedDesign, progress: Progress) -> SolvedDesign:
        """The equilibrium of ``design`` from that of a neighbour. Raises ``NotReached``."""
        from solver import neighbouring

        mesh = self._morpher.mesh_of(design)
        problem = self.anchor.model.problem(design, mesh)
        at_hand = self._at_hand(start.solution)
        former, self._newton = self._newton, None  # of no use should the solve be ended
        found = neighbouring(
            problem,
            design.load.pressure,
            start.solution,
            former=former,
            at_hand=at_hand,
            listener=lambda event: progress.load(event.load, event.rotation, event.spent),
        )
        self._newton = found.newton
        if found.solution is None or found.peak is None:
            raise NotReached(found.failure)
        return SolvedDesign(design, found.solution, found.peak)

    def _judged(self, way: Way) -> NeighbourEvaluation:
        """The record of a design that was reached. Raises ``NotReached`` if it does not hold."""
        design, solution, peak = way.end.design, way.end.solution, way.end.peak
        apart = self.distance(design)
        cells = loaded_state(self._computation(design, SolvedMesh(solution, peak)))
        if reason := unusable(cells):
            raise NotReached(reason)
        solutions = [solved.solution for solved in way.solved]
        return NeighbourEvaluation(
            **vars(self._carried.applied(cells, peak, apart)),
            design=design,
            anchor=self.anchor,
            distance=apart,
            steps=len(solutions),
            fallback="",
            mesh=mesh_size(solution),
            solver=effort(solutions),
            seconds=Seconds(),
            solution=solution,
            neighbourhood=self,
        )

    def _computation(self, design: Design, solved: SolvedMesh) -> Computation:
        """That of a design's cells on the moved mesh alone, without ends."""
        former = self.anchor.computation
        body = Body(design, former.model)
        return replace(
            former, design=design, body=body, solved=(solved,), ends=None, ends_peak=None
        )


def ordinary(
    design: Design, model: str, reason: str, progress: Progress, budget: Budget
) -> NeighbourEvaluation:
    """The ordinary evaluation of a design that no neighbour leads to, and why it was needed."""
    progress.stage(f"no neighbour: {reason}")
    found = evaluate(design, model, progress=progress, budget=budget)
    return NeighbourEvaluation(
        **{field.name: getattr(found, field.name) for field in fields(LoadedState)},
        design=design,
        anchor=found,
        distance=0.0,
        steps=0,
        fallback=reason,
        mesh=found.mesh,
        solver=found.solver,
        seconds=found.seconds,
        solution=found.computation.finest,
    )
