"""What derivatives at a design are taken from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.analysis.models import AnalysisModel
from bellows_design.design.design import Design
from bellows_design.neighbours.carried import Carried

if TYPE_CHECKING:
    from bellows_design.morphing.morpher import Morpher
    from solver import Solution
    from solver.sensitivity.adjoint import Workspace


@dataclass(frozen=True)
class Equilibrium:
    """A design's body in equilibrium, with what moves its mesh and what is at hand of its solve."""

    design: Design
    model: AnalysisModel
    solution: Solution
    morpher: Morpher
    carried: Carried
    workspace: Workspace | None = None
