"""Incompressible material in the three tests of homogeneous strain: uniaxial, equibiaxial, planar.

With x = ln λ of the stretch that is measured, the log stretches of a test are x times fixed
numbers, and the direction with the last of them is free of stress. Then the nominal stress of the
measured direction is P = (τ₁ − τ₃)/λ = b x (s₁ − s₃)/(e₁ − e₃)/λ, with b x = e₁ − e₃ and the
divided difference of the law: nothing is divided by λ − 1, and small strains keep all digits.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.material.constants import Constants
from solver.material.states import responses


@dataclass(frozen=True)
class Mode:
    """A test: the principal log stretches over the log stretch that is measured."""

    name: str
    exponents: tuple[float, float, float]

    @property
    def mean(self) -> float:
        """a: mean of the first and the last exponent."""
        return (self.exponents[0] + self.exponents[2]) / 2

    @property
    def gap(self) -> float:
        """b: the first exponent less the last."""
        return self.exponents[0] - self.exponents[2]

    def principal_stretches(self, stretch: Reals) -> Reals:
        """(n, 3) principal stretches at measured stretches (n,)."""
        return np.asarray(stretch)[:, None] ** np.array(self.exponents)


UNIAXIAL = Mode("uniaxial", (1.0, -0.5, -0.5))
BIAXIAL = Mode("biaxial", (1.0, 1.0, -2.0))
PLANAR = Mode("planar", (1.0, 0.0, -1.0))
MODES = {mode.name: mode for mode in (UNIAXIAL, BIAXIAL, PLANAR)}


def nominal_stress(mode: Mode, stretch: Reals, constants: Constants) -> Reals:
    """Nominal stress (n,) in MPa at stretches (n,) of a test, of any law's constants."""
    logs = np.log(np.asarray(stretch, float))
    divided = responses(np.outer(logs, mode.exponents), constants).divided[:, 2]
    stress: Reals = mode.gap * logs * divided * np.exp(-logs)
    return stress
