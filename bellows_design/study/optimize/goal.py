"""What is sought, and what must be kept: from responses of a design to merit and violation."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from bellows_design.errors import DesignError

if TYPE_CHECKING:
    from bellows_design.batch.answer import Answer

Quantity = Literal["angle", "stress", "volume", "material"]

MARGIN = 0.02
"""Fraction by which stresses are taken as higher than found: the least error that an ordinary
evaluation states on four meshes and more. What is verified at the end has an estimate of its own.
"""

LEAST_GAP = 0.02
"""mm. Of bubbles that do not touch."""

CONTACT_DEPTH = 0.05
"""mm. By how much bubbles that touch are moved apart at first."""

TOLERANCE = 1e-3
"""Fraction by which a search aims at less than a limit: it comes so near to its aim."""

GAP_SCALE = 0.1
"""mm of gap that count as much as a logarithm of 1 of another response."""

PENALTY = 5.0
"""Weight of a violation beside the quantity sought, both as logarithms. It exceeds the ratio of
their elasticities, so that more stress than allowed never pays: both change about alike."""


@dataclass(frozen=True)
class Goal:
    """The largest angle, or the least of another quantity at an angle that is asked for.

    Attributes:
        quantity: ``angle`` is maximised; ``stress``, ``volume`` (of air) and ``material`` are
            minimised.
        most_stress_mpa: Limit of the highest von Mises stress including its error.
        least_angle_deg: Required angle; needed unless the angle is maximised.
        most_strain: Limit of the largest principal strain, for fatigue; None without one.
        least_force_n: Blocked force at the design pressure including its error, in N, that the best
            must exert; the search does not know of it, the verification does. None without one.
        least_gap_mm: Air that neighbouring bubbles keep between them under pressure; None where
            they may touch.

    Raises:
        DesignError: A number is out of its bounds, or an angle is missing.
    """

    quantity: Quantity
    most_stress_mpa: float
    least_angle_deg: float | None = None
    most_strain: float | None = None
    least_gap_mm: float | None = LEAST_GAP
    least_force_n: float | None = None

    def __post_init__(self) -> None:
        if self.quantity != "angle" and self.least_angle_deg is None:
            raise DesignError(
                f"the least {self.quantity} is sought at an angle that must be reached: give one "
                "with --angle, in degrees."
            )
        for name, value, unit in (
            ("stress limit", self.most_stress_mpa, " MPa"),
            ("angle", self.least_angle_deg, "°"),
            ("strain limit", self.most_strain, ""),
            ("least force", self.least_force_n, " N"),
        ):
            if value is not None and not (math.isfinite(value) and value > 0):
                raise DesignError(f"{name} is {value:g}{unit} but must be above 0{unit}.")

    @property
    def sign(self) -> float:
        """-1 where the quantity is maximised."""
        return -1.0 if self.quantity == "angle" else 1.0

    def objective(self, values: Mapping[str, float]) -> float:
        """What is minimised: the logarithm of the quantity, of maximised ones its opposite."""
        return self.sign * math.log(max(values[self.quantity], 1e-9))

    def limits(self, values: Mapping[str, float]) -> dict[str, float]:
        """Logarithms of value over limit, by response; positive where a limit is exceeded.

        Of a gap, which may be negative, what it lacks in ``GAP_SCALE``.
        """
        stress = values["stress"] * (1 + MARGIN) * (1 + TOLERANCE)
        found = {"stress": math.log(stress / self.most_stress_mpa)}
        if self.most_strain is not None:
            found["strain"] = math.log(values["strain"] / self.most_strain)
        if self.least_angle_deg is not None:
            required = self.least_angle_deg * (1 + TOLERANCE)
            found["angle"] = math.log(required / max(values["angle"], 1e-9))
        if self.least_gap_mm is not None and "gap" in values:
            found["gap"] = self.least_gap_mm / GAP_SCALE - values["gap"]
        return found

    def violation(self, values: Mapping[str, float]) -> float:
        """By how much the limits are exceeded together, 0 if none is."""
        return sum(max(0.0, each) for each in self.limits(values).values())

    def merit(self, values: Mapping[str, float]) -> float:
        """What is minimised, with a penalty for what is exceeded."""
        return self.objective(values) + PENALTY * self.violation(values)

    def kept(self, values: Mapping[str, float]) -> bool:
        """Whether all limits are kept: a search aims at a little less than them."""
        return all(each <= TOLERANCE for each in self.limits(values).values())

    def kept_but_for_stress(self, values: Mapping[str, float]) -> bool:
        """Whether all limits but that of the stress are."""
        return self.kept({**values, "stress": 1e-9})


def responses(answer: Answer) -> dict[str, float]:
    """What goals are about: angle (°), stress (MPa), air (mm³), strain and gap (``GAP_SCALE``).

    Walls that touch would run into each other by an unknown depth if they were let.
    """
    gap = answer.smallest_gap_mm
    found = {
        "angle": answer.bending_angle_deg,
        "stress": answer.max_von_mises_mpa,
        "volume": answer.cavity_volume_mm3,
        "strain": answer.highest_strain,
        "gap": None if gap is None else (gap if gap > 0 else -CONTACT_DEPTH) / GAP_SCALE,
    }
    return {name: value for name, value in found.items() if value is not None}
