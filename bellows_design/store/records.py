"""An evaluation with its computation as plain values and arrays, and back.

What the design decides is not kept but made again: the design itself, which is the one that asks,
and the problem on each mesh. The CAD solid is built only if a finer mesh is asked for. Factors of
tangents are not kept.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from bellows_design.analysis.computation import Body, Computation
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import FREE_CELL, HALF, MODELS, AnalysisModel, shortened
from bellows_design.design.design import Design
from bellows_design.store.values import Arrays, plain, restored
from solver import Mesh, Problem, Solution
from solver.nonlinear.newton import Newton

Values = dict[str, Any]

PROBLEMS: Mapping[str, Callable[[Design, Mesh], Problem]] = {
    **{name: model.problem for name, model in MODELS.items()},
    "short actuator": lambda design, mesh: HALF.problem(shortened(design), mesh),
    "bubble without neighbours": FREE_CELL.problem,
}
"""What is solved in an evaluation, from its design and a mesh."""


@dataclass(frozen=True)
class KeptProblem:
    """One of ``PROBLEMS``, and its mesh."""

    name: str
    mesh: Mesh


def record_of(evaluation: Evaluation) -> tuple[Values, Arrays]:
    """Plain values of an evaluation, and the arrays that are named in them."""
    arrays: Arrays = {}
    solved = _solved(evaluation.computation)
    places = {id(solution.problem): place for place, (_, solution) in enumerate(solved)}
    special = {
        Design: lambda _: None,
        Body: lambda _: None,
        AnalysisModel: lambda model: model.name,
        Problem: lambda problem: places[id(problem)],
        Newton: lambda _: None,
    }
    problems = [KeptProblem(name, solution.problem.mesh) for name, solution in solved]
    values = {
        "problems": plain(problems, arrays, special),
        "evaluation": plain(evaluation, arrays, special),
    }
    return values, arrays


def _solved(computation: Computation) -> list[tuple[str, Solution]]:
    """The solution on each mesh, and that of the ends, with the name of what is solved."""
    solved = [(computation.model.name, solution) for solution in computation.solutions]
    if computation.ends is None:
        return solved
    short = computation.ends.problem.moving_plane is None
    name = "short actuator" if short else "bubble without neighbours"
    return [*solved, (name, computation.ends)]


def evaluation_from(
    values: Values, arrays: Mapping[str, NDArray[Any]], design: Design
) -> Evaluation:
    """The evaluation of ``design`` that was kept.

    Raises ``ValueError``, ``KeyError`` or ``TypeError`` for values that are no such record.
    """
    kept = [restored(KeptProblem, each, arrays, {}) for each in values["problems"]]
    problems = [PROBLEMS[each.name](design, each.mesh) for each in kept]
    model = MODELS[values["evaluation"]["model"]]
    special = {
        Design: lambda _: design,
        Body: lambda _: Body(design, model),
        AnalysisModel: lambda name: MODELS[name],
        Problem: lambda place: problems[place],
    }
    found: Evaluation = restored(Evaluation, values["evaluation"], arrays, special)
    return found
