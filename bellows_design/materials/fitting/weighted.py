"""Measurements in the form of a least-squares problem: relative errors, scaled stresses."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from bellows_design.materials.fitting.ogden_terms import unit_slopes, unit_stresses
from bellows_design.materials.measurements.points import Measurements
from solver.arrays import Reals
from solver.material.homogeneous import MODES

FLOOR = 0.05
"""Part of a test's largest stress below which errors count against that part."""

SMALLEST_TEST = 1e-3
"""Largest stress a test counts as having at least, as part of that of all tests."""

FEW_POINTS = 1000
"""Points the starts are compared on; the best of them is refined on all."""


@dataclass(frozen=True)
class Weighted:
    """The points of a least-squares problem, all (n,); ``stress`` in units of ``unit`` MPa.

    ``mean`` and ``gap`` are those of each point's test, ``logs`` the logarithms of its stretch,
    ``weight`` what its error is multiplied by.
    """

    mean: Reals
    gap: Reals
    logs: Reals
    stress: Reals
    weight: Reals
    unit: float

    @classmethod
    def of(cls, data: Measurements) -> Weighted:
        means = np.array([mode.mean for mode in MODES.values()])
        gaps = np.array([mode.gap for mode in MODES.values()])
        unit = float(np.abs(data.stress).max())
        floor = FLOOR * np.maximum(data.scale, SMALLEST_TEST * unit)
        weight = unit / np.maximum(np.abs(data.stress), floor)
        logs = np.log(data.stretch)
        return cls(means[data.mode], gaps[data.mode], logs, data.stress / unit, weight, unit)

    def thinned(self) -> Weighted:
        """At most about ``FEW_POINTS`` of the informative points, evenly from every test."""
        order = np.lexsort((self.logs, self.gap))
        order = order[self.logs[order] != 0]
        chosen = order[:: -(-order.size // FEW_POINTS)]
        names = ("mean", "gap", "logs", "stress", "weight")
        return replace(self, **{name: getattr(self, name)[chosen] for name in names})

    def columns(self, alpha: Reals) -> Reals:
        """(n, terms) weighted stress of each term with μ = 1."""
        return self.weight[:, None] * unit_stresses(self.mean, self.gap, self.logs, alpha)

    def slopes(self, alpha: Reals) -> Reals:
        """(n, terms) their derivatives with respect to α."""
        return self.weight[:, None] * unit_slopes(self.mean, self.gap, self.logs, alpha)

    @property
    def target(self) -> Reals:
        """(n,) weighted measured stress."""
        return self.weight * self.stress

    @property
    def informative(self) -> int:
        """Number of points that depend on the constants: all but those at stretch 1."""
        return int((self.logs != 0).sum())
