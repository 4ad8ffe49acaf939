"""Evaluating a design: the names under which other programs import it.

``evaluate`` does all. Who wants to refine mesh by mesh starts a ``Computation`` with ``started``,
goes on with ``refined``, and gets the record with ``evaluation_of``; the computation behind an
evaluation is its attribute ``computation``.
"""

from __future__ import annotations

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.evaluate import evaluate, evaluation_of, write_vtu
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.mesh_sequence import refined, started

__all__ = [
    "Computation",
    "Evaluation",
    "evaluate",
    "evaluation_of",
    "refined",
    "started",
    "write_vtu",
]
