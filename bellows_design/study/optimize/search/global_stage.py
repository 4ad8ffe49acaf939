"""The global stage: designs of all choices, chosen by what was found before.

Optuna's tree-structured Parzen estimator takes counts and lengths together. What it says depends
on the seed and on the answers alone, so that a run that is resumed, and finds its answers in the
file, goes the same way again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.study.optimize.space.choices import Choice
from bellows_design.study.optimize.space.variables import Variables
from solver.arrays import Reals

if TYPE_CHECKING:
    from optuna.trial import Trial

MOST_REDRAWS = 50
"""Suggestions for each design that exists, at most; the others cost no evaluation."""


def require_optuna() -> None:
    """Raise ``DesignError`` if it is not installed. Imports nothing."""
    if find_spec("optuna") is None:
        raise DesignError(
            "an optimization needs Optuna, which comes with the extra “studies”: "
            "pip install -e '.[studies]'."
        )


@dataclass(frozen=True)
class Suggestion:
    """A design to be evaluated."""

    variables: Variables
    values: Reals
    trial: Any


class GlobalStage:
    """Suggests designs and is told their merits; a session that grows while it is used."""

    def __init__(
        self, choices: Sequence[Choice], variables_of: Callable[[Choice], Variables], seed: int
    ) -> None:
        import optuna

        optuna.logging.set_verbosity(optuna.logging.ERROR)
        self._choices = {choice: variables_of(choice) for choice in choices}
        sampler = optuna.samplers.TPESampler(seed=seed, n_startup_trials=_startup(len(choices)))
        self._study = optuna.create_study(sampler=sampler)

    def suggestions(self, number: int) -> list[Suggestion]:
        """So many designs that exist, or fewer where none are found."""
        from optuna.trial import TrialState

        found: list[Suggestion] = []
        for _ in range(MOST_REDRAWS * number):
            if len(found) == number:
                break
            trial = self._study.ask()
            suggestion = self._suggestion(trial)
            if suggestion is None:
                self._study.tell(trial, state=TrialState.FAIL)
            else:
                found.append(suggestion)
        return found

    def tell(self, suggestion: Suggestion, merit: float | None) -> None:
        """What became of it; None if its evaluation failed."""
        from optuna.trial import TrialState

        if merit is None:
            self._study.tell(suggestion.trial, state=TrialState.FAIL)
        else:
            self._study.tell(suggestion.trial, merit)

    def _suggestion(self, trial: Trial) -> Suggestion | None:
        counts = {
            name: trial.suggest_categorical(
                name, sorted({getattr(choice, name) for choice in self._choices})
            )
            for name in COUNTS
        }
        variables = self._choices.get(Choice(**counts))
        if variables is None:
            return None
        shares = np.array([trial.suggest_float(name, 0.0, 1.0) for name in variables.names])
        span = variables.upper - variables.lower
        values = variables.rounded(variables.within_room(variables.lower + shares * span))
        return None if variables.exists(values) else Suggestion(variables, values, trial)


COUNTS = tuple(Choice.__dataclass_fields__)


def _startup(choices: int) -> int:
    """Random designs before the estimator begins."""
    return max(10, min(24, choices // 4))
