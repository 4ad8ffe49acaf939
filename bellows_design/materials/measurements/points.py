"""Points of homogeneous tests, and the record of how they were read."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.material.homogeneous import MODES


@dataclass(frozen=True)
class Reading:
    """How measurements were read, in sentences.

    Attributes:
        notes: What was taken for what, what was left out, what was shifted.
        hints: What looks as if it were meant otherwise.
    """

    notes: tuple[str, ...] = ()
    hints: tuple[str, ...] = ()

    def __add__(self, other: Reading) -> Reading:
        """Both, each sentence once."""
        notes, hints = (*self.notes, *other.notes), (*self.hints, *other.hints)
        return Reading(tuple(dict.fromkeys(notes)), tuple(dict.fromkeys(hints)))


@dataclass(frozen=True, eq=False)
class Measurements:
    """Points of homogeneous tests. Made by ``load_measurements``, which checks every bound.

    Attributes:
        name: What messages call them.
        stretch: Length over initial length. *Shape:* (n,).
        stress: Nominal stress, MPa. *Shape:* (n,).
        mode: Number of each point's test along ``MODES``. *Shape:* (n,).
        spread: Standard deviation over the specimens that a point is the mean of, MPa. *Shape:*
            (n,); None where no test has more than one specimen.
        reading: How they were read.

    Examples:
        >>> from pathlib import Path
        >>> from bellows_design.materials import load_measurements
        >>> rows = ("strain (%),stress (MPa)", "5,0.05", "10,0.1", "20,0.18", "40,0.31", "80,0.5")
        >>> _ = Path("test.csv").write_text("\\n".join(rows))
        >>> tests = load_measurements("test.csv")
        >>> print(tests.stretch, tests.stress, "MPa")
        [1.05 1.1  1.2  1.4  1.8 ] [0.05 0.1  0.18 0.31 0.5 ] MPa
    """

    name: str
    stretch: Reals
    stress: Reals
    mode: NDArray[np.intp]
    spread: Reals | None = None
    reading: Reading = field(default_factory=Reading)

    @property
    def modes(self) -> tuple[str, ...]:
        """Names of the tests there are points of."""
        return tuple(name for number, name in enumerate(MODES) if (self.mode == number).any())

    def of(self, mode: str) -> tuple[Reals, Reals]:
        """Stretches and stresses of one test."""
        chosen = self.chosen(mode)
        return self.stretch[chosen], self.stress[chosen]

    def chosen(self, mode: str) -> NDArray[np.bool_]:
        """(n,) which points are of that test."""
        return self.mode == list(MODES).index(mode)

    @property
    def scale(self) -> Reals:
        """(n,) the largest stress of each point's test, MPa."""
        peaks = [np.abs(self.of(name)[1]).max(initial=0.0) for name in MODES]
        return np.array(peaks)[self.mode]

    @property
    def valid_strain(self) -> tuple[float, float]:
        """Lowest and highest principal nominal strain that any of the tests reached."""
        stretches = np.concatenate(
            [MODES[name].principal_stretches(self.of(name)[0]).ravel() for name in self.modes]
        )
        return float(stretches.min()) - 1, float(stretches.max()) - 1
