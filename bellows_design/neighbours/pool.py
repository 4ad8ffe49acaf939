"""Several neighbourhoods: for studies that ask for one design after another."""

from __future__ import annotations

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.neighbours.carried import REACH
from bellows_design.neighbours.equilibrium import unusable
from bellows_design.neighbours.neighbourhood import Neighbourhood, ordinary
from bellows_design.neighbours.record import NeighbourEvaluation
from bellows_design.progress import SILENCE, Progress

MOST = 4
"""Neighbourhoods of a pool, each with the factors of two tangents in memory."""


class Pool:
    """Evaluates designs, each from the nearest ordinary evaluation so far.

    A design that none is near to is evaluated ordinarily, and begins a neighbourhood of its own. A
    session of one model, that grows while it is used.

    Examples:
        >>> from bellows_design import load_design, varied
        >>> from bellows_design.evaluation import Pool
        >>> pool, design = Pool(), load_design("prototype_1")
        >>> designs = [varied(design, {"bubble_width": width}) for width in (20.0, 20.1)]
        >>> found = [pool.evaluate(each) for each in designs]
        >>> print([each.fallback == "" for each in found])  # the first has no neighbour
        [False, True]
    """

    def __init__(self, model: str = "auto", most: int = MOST) -> None:
        """``model`` as for ``evaluate``; ``most`` neighbourhoods are kept, the last ones used."""
        self._model = model
        self._most = most
        self._neighbourhoods: list[Neighbourhood] = []

    def evaluate(
        self, design: Design, progress: Progress = SILENCE, budget: Budget = DEFAULT
    ) -> NeighbourEvaluation:
        """``design`` at its design pressure.

        Raises:
            BellowsError, MeshingError: As the ordinary evaluation.
        """
        nearest = self._nearest(design)
        if nearest is None:
            reason = "none is near that was evaluated before"
            return self._kept(ordinary(design, self._model, reason, progress, budget))
        self._use(nearest)
        found = nearest.evaluate(design, progress, budget)
        return self._kept(found) if found.fallback else found

    def add(self, evaluation: Evaluation) -> None:
        """Begin a neighbourhood of an ordinary evaluation; nothing if it is no start for one."""
        if not unusable(evaluation):
            self._use(Neighbourhood(evaluation))

    def _nearest(self, design: Design) -> Neighbourhood | None:
        near = [each for each in self._neighbourhoods if each.distance(design) <= REACH]
        return min(near, key=lambda each: each.distance(design), default=None)

    def _use(self, neighbourhood: Neighbourhood) -> None:
        others = [each for each in self._neighbourhoods if each is not neighbourhood]
        self._neighbourhoods = [*others, neighbourhood][-self._most :]

    def _kept(self, found: NeighbourEvaluation) -> NeighbourEvaluation:
        self.add(found.anchor)
        return found
