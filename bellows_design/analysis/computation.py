"""A design's solutions so far: one for each mesh, from coarse to fine, and that of the ends."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Generic

from bellows_design.analysis.models import AnalysisModel, Subject
from bellows_design.budget import DEFAULT, Budget

if TYPE_CHECKING:
    from bellows_design.geometry.meshable import Meshable
    from solver import Peak, Solution
    from solver.nonlinear.newton import Newton


@dataclass(frozen=True)
class Seconds:
    """Time spent on each stage, s."""

    geometry: float = 0.0
    mesh: float = 0.0
    solve: float = 0.0

    @property
    def total(self) -> float:
        """All of them, s."""
        return self.geometry + self.mesh + self.solve

    def __add__(self, other: Seconds) -> Seconds:
        return Seconds(
            self.geometry + other.geometry, self.mesh + other.mesh, self.solve + other.solve
        )

    def __sub__(self, other: Seconds) -> Seconds:
        return Seconds(
            self.geometry - other.geometry, self.mesh - other.mesh, self.solve - other.solve
        )

    def to_dict(self) -> dict[str, float]:
        """Plain values for JSON."""
        return asdict(self) | {"total": self.total}


@dataclass(frozen=True)
class SolvedMesh:
    """The solution on one mesh, and its highest von Mises Cauchy stress with its place."""

    solution: Solution
    peak: Peak


@dataclass(frozen=True)
class Body(Generic[Subject]):
    """The solid of a design that is meshed for a model, built when it is first asked for."""

    design: Subject
    model: AnalysisModel[Subject]

    @cached_property
    def solid(self) -> Meshable:
        """The solid. Raises ``GeometryError`` if the CAD kernel cannot build it."""
        return self.model.solid(self.design)


@dataclass(frozen=True)
class Computation(Generic[Subject]):
    """What was solved for a design, or another body, under pressure, and what is needed to go on.

    ``solved`` holds the meshes, the finest last; ``ends`` the solution of a short actuator of one
    bubble, or of a bubble without neighbours, on the unit cell's coarsest mesh size; ``pressures``
    (MPa) those asked for besides the design's; ``reason`` why this model was chosen; ``ends_peak``
    the highest von Mises Cauchy stress in the ends; ``out_of_time`` that a finer mesh was wanted
    for which the budget's time did not suffice; ``workspace`` what the solve on the finest mesh
    left, where ``keep`` asks for it.

    Examples:
        >>> from bellows_design import evaluate, load_design
        >>> computation = evaluate(load_design("prototype_1")).computation
        >>> print(computation.model.name, len(computation.solved) > 1)
        unit-cell True
        >>> finest = computation.finest
        >>> print(finest.displacement.shape == finest.problem.mesh.nodes.shape)
        True
    """

    design: Subject
    model: AnalysisModel[Subject]
    reason: str
    body: Body[Subject]
    pressures: tuple[float, ...] = ()
    budget: Budget = DEFAULT
    solved: tuple[SolvedMesh, ...] = ()
    ends: Solution | None = None
    ends_peak: Peak | None = None
    seconds: Seconds = Seconds()
    out_of_time: bool = False
    keep: bool = False
    workspace: Newton | None = field(default=None, repr=False, compare=False)

    @property
    def in_time(self) -> bool:
        """True if it would be the same however long it took: no limit of time ended anything."""
        stopped = any(each.stopped_by == "budget" for each in self.all_solutions)
        return not stopped and not self.out_of_time

    @property
    def seconds_left(self) -> float:
        """What is left of the budget's time, s; not above 0 where it is spent."""
        return self.budget.seconds - self.seconds.total

    @property
    def solutions(self) -> tuple[Solution, ...]:
        """The solution on every mesh, the finest last."""
        return tuple(mesh.solution for mesh in self.solved)

    @property
    def peaks(self) -> tuple[Peak, ...]:
        """Highest von Mises Cauchy stress on every mesh, with its place."""
        return tuple(mesh.peak for mesh in self.solved)

    @property
    def finest(self) -> Solution:
        """The solution on the finest mesh."""
        return self.solved[-1].solution

    @property
    def all_solutions(self) -> tuple[Solution, ...]:
        """Those on every mesh, and that of the ends."""
        return self.solutions if self.ends is None else (*self.solutions, self.ends)

    @property
    def converged(self) -> bool:
        """True if every solution reached the design pressure."""
        return all(solution.converged for solution in self.all_solutions)

    @property
    def stopped(self) -> Solution | None:
        """The solution that did not reach the design pressure; None if all did."""
        return next((each for each in self.all_solutions if not each.converged), None)

    @property
    def message(self) -> str:
        """How far the load came and why it stopped."""
        if self.ends is not None and not self.ends.converged:
            return f"the ends: {self.ends.message}"
        return self.finest.message

    @property
    def touch_pressure_mpa(self) -> float | None:
        """Pressure from which walls touch that the model does not keep apart, MPa; None if none."""
        stopped = self.stopped
        return stopped.pressure if stopped is not None and stopped.stopped_by == "guard" else None

    @property
    def stable(self) -> bool | None:
        """Whether the state found is stable under its pressure; None if that is unknown."""
        known = {solution.stable for solution in self.all_solutions}
        return False if False in known else None if None in known else True

    @property
    def limit_pressure_mpa(self) -> float | None:
        """Pressure of the limit point that ended the load path, MPa; None if there was none."""
        limits = [each.limit for each in self.all_solutions if each.limit is not None]
        return min(limits, key=abs, default=None)

    @property
    def pressure_mpa(self) -> float:
        """Pressure that every solution reached, MPa."""
        return min((solution.pressure for solution in self.all_solutions), key=abs)
