"""Base of the hyperelastic laws: volumetric part, and constants for the compiled functions."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from solver.arrays import Reals
from solver.errors import SolverError
from solver.input_types import check_number
from solver.material.constants import Constants

Volumetric = Literal["quadratic", "logarithmic"]


class Hyperelastic:
    """Base of the laws: an energy of the isochoric stretches, and a volumetric part.

    An infinite ``bulk_modulus`` K (MPa) means J = 1; a finite one adds K (J - 1)^2 / 2 if
    ``volumetric`` is "quadratic", K (J^2 - 1 - 2 ln J) / 4 if it is "logarithmic", whose
    stress is unbounded as J goes to 0.
    """

    law: ClassVar[str]
    """Name in the table of laws, ``solver.material.laws``."""

    bulk_modulus: float
    volumetric: Volumetric

    @property
    def values(self) -> Reals:
        """The constants (c,) as the law's compiled functions take them."""
        raise NotImplementedError

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus, MPa."""
        raise NotImplementedError

    @property
    def constants(self) -> Constants:
        """Number of the law and its constants."""
        from solver.material.laws import number_of

        return Constants(number_of(self.law), self.values)

    @property
    def compliance(self) -> float:
        """1 / bulk_modulus, 1/MPa; exactly 0 when incompressible."""
        return 1.0 / self.bulk_modulus

    def energy(self, log_stretches: ArrayLike) -> float:
        """W in MPa at isochoric principal log stretches (3,), whose sum is 0."""
        from solver.material.by_number import law_energy

        constants = self.constants
        return float(
            law_energy(constants.number, np.asarray(log_stretches, float), constants.values)
        )

    def principal_stresses(self, log_stretches: ArrayLike) -> Reals:
        """Deviatoric principal Kirchhoff stresses (3,), MPa, at isochoric log stretches (3,)."""
        from solver.material.states import responses

        stress = responses(np.asarray(log_stretches, float)[None], self.constants).stress[0]
        deviator: Reals = stress - stress.mean()
        return deviator

    def _check_volumetric(self) -> None:
        """Raise ``SolverError`` for an invalid volumetric part."""
        name = type(self).__name__
        check_number(f"{name}: bulk_modulus", self.bulk_modulus)
        if not self.bulk_modulus > 0:
            raise SolverError(
                f"{name}: bulk_modulus must be positive, got {self.bulk_modulus} MPa."
            )
        if self.volumetric not in ("quadratic", "logarithmic"):
            raise SolverError(
                f"{name}: volumetric must be quadratic or logarithmic, got {self.volumetric!r}."
            )
