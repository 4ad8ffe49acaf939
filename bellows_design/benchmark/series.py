"""One model's meshes from coarse to fine: their work, their answers, their true errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from bellows_design.analysis.computation import Seconds
from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.models import HALF
from bellows_design.benchmark.rates import fitted_exponent, observed_orders
from bellows_design.benchmark.reference import Reference


@dataclass(frozen=True)
class Work:
    """What one solve took."""

    elements: int
    unknowns: int
    newton_iterations: int
    factorizations: int
    solver_seconds: float

    @property
    def seconds_per_factorization(self) -> float:
        """Seconds of the solve for each factorization in it."""
        return self.solver_seconds / max(self.factorizations, 1)


@dataclass(frozen=True)
class TrueErrors:
    """Errors in percent of a reference; None where it cannot judge."""

    bending_angle_percent: float | None = None
    max_von_mises_percent: float | None = None


@dataclass(frozen=True)
class Ratios:
    """Estimated over true error; None where one of them is unknown or the true one is zero."""

    bending_angle: float | None
    max_von_mises: float | None


@dataclass(frozen=True)
class Orders:
    """Observed orders of convergence from each mesh to the next."""

    bending_angle: tuple[float | None, ...]
    max_von_mises: tuple[float | None, ...]


@dataclass(frozen=True)
class Level:
    """One mesh: its work, what its solution says, and the estimated errors of that.

    ``so_far`` is what it takes to get to this answer, the coarser meshes included; what the
    ends of a unit cell take is counted with the first mesh. ``peak_memory_mib`` is the process's,
    None where unknown; angle in degrees, stress in MPa, those of the last good state if the load
    was not reached.
    """

    work: Work
    stages: Seconds
    so_far: Seconds
    peak_memory_mib: float | None
    bending_angle_deg: float
    max_von_mises_mpa: float
    estimate: ErrorEstimate = field(default_factory=ErrorEstimate)
    converged: bool = True

    def errors(self, model: str, reference: Reference) -> TrueErrors:
        """True errors in percent of ``reference``; None where it cannot judge a mesh so fine."""
        if not self.converged or not reference.judges(model, self.work.elements):
            return TrueErrors()
        return TrueErrors(
            off(self.bending_angle_deg, reference.bending_angle_deg),
            off(self.max_von_mises_mpa, reference.max_von_mises_mpa),
        )

    def ratios(self, errors: TrueErrors) -> Ratios:
        """How the estimates of this mesh compare with its true errors."""
        return Ratios(
            _ratio(self.estimate.bending_angle_percent, errors.bending_angle_percent),
            _ratio(self.estimate.max_von_mises_percent, errors.max_von_mises_percent),
        )


@dataclass(frozen=True)
class Series:
    """A model's meshes from coarse to fine, and the reference they are measured against.

    ``note`` says why there are fewer meshes than asked for, or what went wrong.
    """

    model: str
    reason: str
    converged: bool
    levels: tuple[Level, ...]
    reference: Reference
    note: str = ""
    ends: Work | None = None

    @property
    def errors(self) -> tuple[TrueErrors, ...]:
        """True errors of every mesh in percent."""
        return self.errors_against(self.reference)

    def errors_against(self, reference: Reference) -> tuple[TrueErrors, ...]:
        """True errors of every mesh in percent of ``reference``."""
        return tuple(level.errors(self.model, reference) for level in self.levels)

    @property
    def ratios(self) -> tuple[Ratios, ...]:
        """Estimated over true errors of every mesh."""
        pairs = zip(self.levels, self.errors, strict=True)
        return tuple(level.ratios(errors) for level, errors in pairs)

    @property
    def orders(self) -> Orders:
        """Observed orders of angle and stress from each mesh to the next.

        A half actuator is compared with the finest half where there is one: what another model
        differs by is no error of a mesh.
        """
        own = self.reference.finest_half if self.model == HALF.name else None
        errors = self.errors_against(own or self.reference)
        sizes = [level.work.elements for level in self.levels]
        return Orders(
            observed_orders(sizes, [error.bending_angle_percent for error in errors]),
            observed_orders(sizes, [error.max_von_mises_percent for error in errors]),
        )

    @property
    def exponent(self) -> float | None:
        """Seconds per factorization grow with this power of the unknowns."""
        return fitted_exponent(
            [level.work.unknowns for level in self.levels],
            [level.work.seconds_per_factorization for level in self.levels],
        )

    @property
    def solve_exponent(self) -> float | None:
        """All seconds of solving up to a mesh grow with this power of its unknowns."""
        return fitted_exponent(
            [level.work.unknowns for level in self.levels],
            [level.so_far.solve for level in self.levels],
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "model": self.model,
            "model_reason": self.reason,
            "converged": self.converged,
            "note": self.note,
            "reference": asdict(self.reference),
            "ends": None if self.ends is None else asdict(self.ends),
            "meshes": [self._mesh_dict(level) for level in self.levels],
            "orders": {name: list(orders) for name, orders in asdict(self.orders).items()},
            "exponent": self.exponent,
            "solve_exponent": self.solve_exponent,
        }

    def _mesh_dict(self, level: Level) -> dict[str, Any]:
        errors, half = level.errors(self.model, self.reference), self.reference.finest_half
        return {
            **asdict(level.work),
            "seconds": level.stages.to_dict(),
            "seconds_per_factorization": level.work.seconds_per_factorization,
            "seconds_so_far": level.so_far.to_dict(),
            "converged": level.converged,
            "peak_memory_mib": level.peak_memory_mib,
            "bending_angle_deg": level.bending_angle_deg,
            "max_von_mises_mpa": level.max_von_mises_mpa,
            "error": asdict(errors),
            "error_against_finest_half": half and asdict(level.errors(self.model, half)),
            "error_estimate": asdict(level.estimate),
            "estimate_over_error": asdict(level.ratios(errors)),
        }


def finest_of(model: str, levels: Sequence[Level]) -> Reference:
    """The finest of a model's own meshes as the reference of the coarser ones."""
    finest = ([level for level in levels if level.converged] or levels)[-1]
    elements = finest.work.elements
    return Reference(
        finest.bending_angle_deg,
        finest.max_von_mises_mpa,
        model,
        elements,
        elements - 1,
        f"its own finest mesh, {elements} tetrahedra, for want of stored values of this design",
    )


def off(value: float, exact: float) -> float | None:
    """Error of a value in percent of the exact one; None where that is zero."""
    return 100 * abs(value / exact - 1) if exact else None


def _ratio(estimate: float | None, error: float | None) -> float | None:
    return estimate / error if estimate is not None and error else None
