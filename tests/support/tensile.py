"""Made-up tensile tests, and tables of them as machines write them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from solver.arrays import Reals
from solver.material.constants import Constants
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.ogden import packed

NINJAFLEX = packed([3.2778, 0.19825], [-0.0054, 3.05])
SHEAR = 3.2778 + 0.19825
"""MPa."""
SOFT, SOFT_SHEAR = packed([0.06], [2.4]), 0.06
"""A cast silicone: hardly bends, and is soft enough to pass for a hundredth of something."""


def curve(
    reach: float = 2.0,
    points: int = 60,
    law: Constants = NINJAFLEX,
    seed: int = 0,
    start: float = 0.02,
    noise: float = 0.01,
    mode: str = "uniaxial",
) -> tuple[Reals, Reals]:
    """Nominal strains up to ``reach`` and nominal stresses, MPa, with relative noise."""
    strain = np.linspace(min(start, reach / points), reach, points)
    factors = 1 + noise * np.random.default_rng(seed).standard_normal(points)
    return strain, nominal_stress(MODES[mode], 1 + strain, law) * factors


def table(
    header: str,
    *columns: Reals | Sequence[str],
    separator: str = ",",
    decimal: str = ".",
    ending: str = "",
) -> str:
    """Text of a table below ``header``, which may have several lines; ``ending`` ends each row."""
    rows = [
        separator.join(cell if isinstance(cell, str) else f"{cell:.7g}" for cell in row) + ending
        for row in zip(*columns, strict=True)
    ]
    body = "\n".join(rows).replace(".", decimal)
    return f"{header}\n{body}\n" if header else f"{body}\n"
