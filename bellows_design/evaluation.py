"""Evaluating a design: the names under which other programs import it.

``evaluate`` does all. Who wants to refine mesh by mesh starts a ``Computation`` with ``started``,
goes on with ``refined``, and gets the record with ``evaluation_of``; the computation behind an
evaluation is its attribute ``computation``. Studies, which ask for many designs that differ by
little, take a ``Pool``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import overload

from bellows_design.analysis import evaluate as analysis
from bellows_design.analysis.computation import Computation
from bellows_design.analysis.evaluate import evaluation_of, write_vtu
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.analysis.mesh_sequence import refined, started
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.neighbours.neighbourhood import Neighbourhood
from bellows_design.neighbours.pool import Pool
from bellows_design.neighbours.record import NeighbourEvaluation
from bellows_design.own_body.analysis import evaluate as own_bodies
from bellows_design.own_body.analysis.evaluation import BodyEvaluation
from bellows_design.own_body.body import OwnBody
from bellows_design.progress import SILENCE, Progress

__all__ = [
    "BodyEvaluation",
    "Computation",
    "Evaluation",
    "LoadedState",
    "NeighbourEvaluation",
    "Neighbourhood",
    "Pool",
    "evaluate",
    "evaluation_of",
    "refined",
    "started",
    "write_vtu",
]

Near = Evaluation | NeighbourEvaluation | Neighbourhood | Pool


def _nothing(_: LoadedState) -> str:
    return ""


@overload
def evaluate(
    design: Design,
    model: str = ...,
    accuracy_percent: float | None = ...,
    pressures: Sequence[float] = ...,
    progress: Progress = ...,
    budget: Budget = ...,
    open_question: Callable[[LoadedState], str] = ...,
    keep: bool = ...,
    near: None = ...,
) -> Evaluation: ...


@overload
def evaluate(
    design: Design, *, progress: Progress = ..., budget: Budget = ..., near: Near
) -> NeighbourEvaluation: ...


@overload
def evaluate(
    design: OwnBody,
    *,
    accuracy_percent: float | None = ...,
    pressures: Sequence[float] = ...,
    progress: Progress = ...,
    budget: Budget = ...,
) -> BodyEvaluation: ...


def evaluate(
    design: Design | OwnBody,
    model: str = "auto",
    accuracy_percent: float | None = None,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    open_question: Callable[[LoadedState], str] = _nothing,
    keep: bool = False,
    near: Near | None = None,
) -> Evaluation | NeighbourEvaluation | BodyEvaluation:
    """Evaluate ``design``: by itself, or starting from a neighbour (``near``).

    Args:
        design: A design of bellows, or a body of one's own, at its design pressure, MPa.
        model: The body that stands for an actuator: ``auto`` (the smallest that answers),
            ``unit-cell``, ``half`` or ``full``. A body of one's own has no other.
        accuracy_percent: Refine the mesh until both error estimates are this small, percent.
        pressures: Further pressures of the curve, between 0 and the design's, MPa.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take. Refinement ends before a mesh that
            would exceed it; the error estimates then say what was reached.
        open_question: Asked with the state on the finest mesh what its error estimates leave open,
            as text; empty if nothing. The mesh is refined further for it.
        keep: Keep the factors of the finest mesh's tangent with the result, for its
            ``sensitivities``; about a hundred megabytes for five thousand tetrahedra.
        near: An evaluation of a design that differs by little. Its mesh is moved and its
            equilibrium is the start, which costs about a tenth. Its model, accuracy and ends are
            taken over. Where that fails the design is evaluated by itself; the result says so.
            From an ordinary evaluation the first neighbour takes longer: pass its result on, or a
            ``Neighbourhood`` or ``Pool``.

    Returns:
        Angle, stress, volume, strain and contact at the pressure reached, with estimated errors;
        with ``converged`` False, of the last good state, where the load could not be reached.

    Raises:
        BellowsError: Unknown model, accuracy or pressures out of bounds, a geometry the CAD kernel
            refuses, a first mesh that exceeds the budget, or ``near`` with a model, accuracy or
            pressures.
        MeshingError: No usable mesh, or none in time.

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> found = evaluate(load_design("prototype_1"), pressures=[0.05])
        >>> (at,) = found.curve
        >>> print(f"{at.bending_angle_deg:.0f}°, {at.max_von_mises_mpa:.1f} MPa")
        139°, 2.8 MPa
        >>> print(f"± {found.error_estimate.bending_angle_percent:.1f} % of the angle")
        ± 2.3 % of the angle
    """
    if isinstance(design, OwnBody):
        if model != "auto" or near is not None or keep:
            raise DesignError("an own body takes no model, near or keep: leave them out.")
        return own_bodies.evaluate(design, accuracy_percent, pressures, progress, budget)
    if near is None:
        return analysis.evaluate(
            design, model, accuracy_percent, pressures, progress, budget, open_question, keep
        )
    if model != "auto" or accuracy_percent is not None or len(pressures):
        raise DesignError(
            "near: a neighbour has the model, the accuracy and the single pressure of the "
            "evaluation that it starts from; leave out model, accuracy_percent and pressures."
        )
    return _session(near).evaluate(design, progress, budget)


def _session(near: Near) -> Neighbourhood | Pool:
    """The session that ``near`` belongs to, or a new one."""
    if isinstance(near, Neighbourhood | Pool):
        return near
    if isinstance(near, Evaluation):
        return Neighbourhood(near)
    return near.neighbourhood or Neighbourhood(near.anchor)
