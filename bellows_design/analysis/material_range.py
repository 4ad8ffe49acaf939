"""Whether a result stays where its material was tested and is stable.

The strains are the principal nominal strains (stretch - 1) at the quadrature points of the finest
mesh. Their plain extremes count, not quantiles: where the strain exceeds the range of the tests,
in a fillet for instance, the stress is highest. Elements at sharp edges are left out, as they are
for the highest stress, since the strain there depends on the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from bellows_design.materials.material import Material
from solver.arrays import Reals
from solver.material.stability import drucker_margin, shear_margin

if TYPE_CHECKING:
    from solver import Solution

Inequality = Literal["Drucker", "Hill"]


@dataclass(frozen=True)
class Instability:
    """States at which ``inequality`` fails: the least strained of them, and how many points.

    ``strains`` are its principal nominal strains, ascending; ``share`` the part of all points.
    """

    inequality: Inequality
    strains: tuple[float, float, float]
    share: float


@dataclass(frozen=True)
class ReachedStrain:
    """Extreme principal nominal strains of a result, and where the material was tested.

    ``valid`` is None where the material does not say; ``elongation_at_break`` is a strain too.
    """

    lowest: float
    highest: float
    valid: tuple[float, float] | None = None
    elongation_at_break: float | None = None
    instability: Instability | None = None

    @property
    def within(self) -> bool | None:
        """Whether all strains are inside of the range of the tests; None without one."""
        if self.valid is None:
            return None
        return self.valid[0] <= self.lowest and self.highest <= self.valid[1]

    @property
    def breaks(self) -> bool:
        """True if the material is strained beyond its elongation at break."""
        limit = self.elongation_at_break
        return limit is not None and self.highest > limit

    def joined(self, other: ReachedStrain) -> ReachedStrain:
        """The extremes of both, of the same material."""
        return replace(
            self,
            lowest=min(self.lowest, other.lowest),
            highest=max(self.highest, other.highest),
            instability=self.instability or other.instability,
        )

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for everything that makes the numbers less reliable than they look."""
        found = [self._outside(), self._broken(), self._unstable()]
        return tuple(sentence for sentence in found if sentence is not None)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        unstable = self.instability
        return {
            "lowest": self.lowest,
            "highest": self.highest,
            "valid": None if self.valid is None else list(self.valid),
            "within": self.within,
            "elongation_at_break": self.elongation_at_break,
            "stable": unstable is None,
            "unstable_at": None if unstable is None else list(unstable.strains),
        }

    def _outside(self) -> str | None:
        if self.valid is None or self.within:
            return None
        low, high = self.valid
        return (
            f"the material is strained from {_percent(self.lowest)} to {_percent(self.highest)}, "
            f"but its constants were fitted from {_percent(low)} to {_percent(high)}: beyond, they "
            "are a guess."
        )

    def _broken(self) -> str | None:
        limit = self.elongation_at_break
        if limit is None or not self.breaks:
            return None
        return (
            f"the material is strained to {_percent(self.highest)}, beyond its elongation at break "
            f"of {_percent(limit)}."
        )

    def _unstable(self) -> str | None:
        found = self.instability
        if found is None:
            return None
        strains = ", ".join(_percent(strain) for strain in found.strains)
        return (
            f"the material model is unstable at {100 * found.share:.2g} % of the points "
            f"({found.inequality}'s inequality), from principal strains of {strains} on."
        )


def reached_strain(material: Material, solution: Solution) -> ReachedStrain:
    """What ``solution`` asks of ``material``."""
    from solver.results.strains import reached_logs

    return strain_of(material, reached_logs(solution))


def strain_of(material: Material, logs: Reals) -> ReachedStrain:
    """The same from the logarithms of principal stretches (k, 3), ascending."""
    percent = material.elongation_at_break
    return ReachedStrain(
        lowest=float(np.expm1(logs[:, 0].min())),
        highest=float(np.expm1(logs[:, 2].max())),
        valid=material.valid_strain,
        elongation_at_break=None if percent is None else percent / 100,
        instability=_instability(material, logs),
    )


def _instability(material: Material, logs: Reals) -> Instability | None:
    """Where Drucker's or else Hill's inequality fails at the states that were reached."""
    constants = material.law_constants()
    isochoric = logs - logs.mean(axis=1, keepdims=True)
    drucker = ~(drucker_margin(isochoric, constants) > 0)
    unstable = drucker | ~(shear_margin(isochoric, constants) > 0)
    if not unstable.any():
        return None
    size = np.where(unstable, np.linalg.norm(isochoric, axis=1), np.inf)
    first = int(size.argmin())
    low, middle, high = (float(strain) for strain in np.expm1(logs[first]))
    inequality: Inequality = "Drucker" if drucker[first] else "Hill"
    return Instability(inequality, (low, middle, high), float(unstable.mean()))


def _percent(strain: float) -> str:
    return f"{100 * strain:+.3g} %"
