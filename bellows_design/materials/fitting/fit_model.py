"""A form of a law that measurements are fitted with."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from bellows_design.materials.fitting.fit_result import Fit
    from bellows_design.materials.fitting.weighted import Weighted
    from bellows_design.materials.measurements.points import Measurements

Fitter = Callable[["Measurements", "Weighted", "FitModel"], "Fit"]


class FitModel(NamedTuple):
    """A form of a law that measurements are fitted with.

    Attributes:
        name: As ``bellows fit --model`` takes it.
        exponents: α of each term; None where it is fitted.
        fitter: Function that fits it.
        higher: Number of constants besides μ and α.
    """

    name: str
    exponents: tuple[float | None, ...]
    fitter: Fitter
    higher: int = 0

    @property
    def constants(self) -> int:
        """Number of constants that are fitted."""
        return len(self.exponents) + self.exponents.count(None) + self.higher
