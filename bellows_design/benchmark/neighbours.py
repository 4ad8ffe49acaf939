"""Speed against error of evaluations that start from a neighbour, over the distance to it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.benchmark.reference import Reference
from bellows_design.benchmark.series import TrueErrors, off
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.design.variation import geometric_parameters, same_topology, varied
from bellows_design.errors import DesignError
from bellows_design.neighbours.neighbourhood import Neighbourhood
from bellows_design.neighbours.record import NeighbourEvaluation
from bellows_design.progress import SILENCE, Progress

SHARES = (0.01, 0.02, 0.05, 0.1)
"""By how much all lengths of the neighbours differ."""


@dataclass(frozen=True)
class Row:
    """The design from a neighbour whose lengths differ by ``share``; angle in degrees, MPa, s.

    ``ordinary_seconds``: of the neighbour's own evaluation; ``set_up_seconds``: of its
    neighbourhood, once for all designs in it.
    """

    share: float
    steps: int
    factorizations: int
    newton_iterations: int
    seconds: float
    set_up_seconds: float
    ordinary_seconds: float
    bending_angle_deg: float
    max_von_mises_mpa: float
    estimate: ErrorEstimate
    errors: TrueErrors
    fallback: str

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return asdict(self)


def neighbour_rows(
    design: Design,
    reference: Reference,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> tuple[Row, ...]:
    """``design`` from one neighbour at each distance, against its own reference.

    Raises:
        BellowsError, MeshingError: As ``evaluate``, of a neighbour.
    """
    return tuple(_rows(design, reference, progress, budget))


def _rows(
    design: Design, reference: Reference, progress: Progress, budget: Budget
) -> Iterator[Row]:
    for share in SHARES:
        neighbour = _neighbour(design, share)
        if neighbour is None:
            continue
        progress.stage(f"a neighbour at {100 * share:g} %")
        anchor = evaluate(neighbour, progress=progress, budget=budget)
        session, set_up = _timed(anchor)
        session.evaluate(neighbour, progress, budget)  # its factorization is then at hand
        found = session.evaluate(design, progress, budget)
        yield _row(share, found, anchor.seconds.total, set_up, reference)


def _neighbour(design: Design, share: float) -> Design | None:
    """A design whose lengths are alternately longer and shorter by ``share``; None without one."""
    values = {k: v for k, v in geometric_parameters(design).items() if k not in ENDS}
    for first in (1, -1):
        signs = (first * (-1) ** place for place in range(len(values)))
        pairs = zip(values.items(), signs, strict=True)
        try:
            other = varied(design, {k: v * (1 + sign * share) for (k, v), sign in pairs})
        except DesignError:
            continue
        same_count = other.bellows.bubble_count == design.bellows.bubble_count
        if same_count and not same_topology(design, other):
            return other
    return None


ENDS = ("length", "offset")
"""Lengths that change the ends of an actuator of so many bubbles only."""


def _timed(anchor: Evaluation) -> tuple[Neighbourhood, float]:
    """The neighbourhood of an evaluation, and the seconds that it takes."""
    began = time.perf_counter()
    return Neighbourhood(anchor), time.perf_counter() - began


def _row(
    share: float, found: NeighbourEvaluation, ordinary: float, set_up: float, reference: Reference
) -> Row:
    angle, stress = found.bending_angle_deg, found.max_von_mises_mpa
    return Row(
        share=share,
        steps=found.steps,
        factorizations=found.solver.factorizations,
        newton_iterations=found.solver.newton_iterations,
        seconds=found.seconds.total,
        set_up_seconds=set_up,
        ordinary_seconds=ordinary,
        bending_angle_deg=angle,
        max_von_mises_mpa=stress,
        estimate=found.error_estimate,
        errors=TrueErrors(
            off(angle, reference.bending_angle_deg), off(stress, reference.max_von_mises_mpa)
        ),
        fallback=found.fallback,
    )
