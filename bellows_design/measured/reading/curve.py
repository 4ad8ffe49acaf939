"""A measured curve, and the record of how it was read."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from bellows_design.materials.measurements.points import Reading
from bellows_design.measured.quantities import Quantity
from solver.arrays import Reals


@dataclass(frozen=True, eq=False)
class MeasuredCurve:
    """What was measured of a part over pressure. Made by ``load_curve``, which checks bounds.

    Attributes:
        name: What messages call it.
        quantity: What was measured.
        pressure: MPa over that outside, ascending in size. *Shape:* (n,).
        value: In the quantity's unit. *Shape:* (n,).
        spread: Standard deviation of each value, in its unit. *Shape:* (n,); None where the file
            states none.
        unit_told: True if an option gave the unit of the values.
        reading: How it was read.
    """

    name: str
    quantity: Quantity
    pressure: Reals
    value: Reals
    spread: Reals | None = None
    unit_told: bool = False
    reading: Reading = field(default_factory=Reading)

    def at(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> MeasuredCurve:
        """Those points alone, by a mask or by indices."""
        spread = None if self.spread is None else self.spread[chosen]
        return replace(
            self, pressure=self.pressure[chosen], value=self.value[chosen], spread=spread
        )

    def noted(self, *notes: str) -> MeasuredCurve:
        """The same with further sentences on how it was read."""
        return replace(self, reading=self.reading + Reading(notes))

    def turned(self) -> MeasuredCurve:
        """The same with values of the other sign."""
        return replace(self, value=-self.value)
