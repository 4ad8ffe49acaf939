"""Evaluates a design with one indent after another, and records what each changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from bellows_design.errors import BellowsError, DesignError
from bellows_design.neighbours.equilibrium import unusable
from bellows_design.study.indent.kinds import with_indent
from bellows_design.study.indent.trial import Trial
from solver.errors import MeshingError, SolverError

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.design.design import Design
    from bellows_design.design.indent import Indent

Evaluate = Callable[["Design"], "Evaluation"]
"""How designs are evaluated. Stresses on two meshes differ by as much as many an indent changes:
evaluations of the default accuracy give a survey, a finding needs better ones."""


class Tester:
    """Tries indents of one design against the design without; grows with every trial.

    Attributes:
        design: Without indent.
        plain: Its evaluation.
        trials: All so far.
    """

    def __init__(self, design: Design, evaluate: Evaluate, tell: Callable[[Trial], None]) -> None:
        """Every trial is told to ``tell``.

        Raises ``DesignError`` if the design is not solved, or its result is void.
        """
        self._evaluate, self._tell = evaluate, tell
        self.design = with_indent(design, None)
        self.plain = evaluate(self.design)
        if reason := unusable(self.plain):
            raise DesignError(f"{design.name} without indent: {reason}.")
        self.trials: list[Trial] = []

    def note(self, trial: Trial) -> None:
        """Record a trial."""
        self.trials.append(trial)
        self._tell(trial)

    def tried(self, indent: Indent, how: str) -> Evaluation | None:
        """The design with an indent; None where there is none, or no result that holds."""
        try:
            found = self._evaluate(with_indent(self.design, indent))
        except (BellowsError, MeshingError, SolverError):
            return None
        if unusable(found):
            return None
        self.note(self.trial(found, how))
        return found

    def trial(self, found: Evaluation, how: str) -> Trial:
        """What an evaluation changes."""
        return Trial.of(found.design, found, self.plain, how)
