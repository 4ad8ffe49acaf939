"""Evaluating a design: the names under which other programs import it."""

from __future__ import annotations

from bellows_design.analysis.evaluate import evaluate, refined, started, write_vtu
from bellows_design.analysis.evaluation import Evaluation

__all__ = ["Evaluation", "evaluate", "refined", "started", "write_vtu"]
