"""A material's nominal stress over strain, where it was tested, and how far it is strained."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.page.curves.chart import Chart
from bellows_design.web.charts import Line, Mark

if TYPE_CHECKING:
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.materials.material import Material

USUAL = (-0.3, 1.0)
"""Strains that are drawn of a material that says nothing of its tests, and reaches less."""

BEYOND = 1.15
"""Of the largest strain that is named: as far as is drawn."""

LOWEST = -0.9
POINTS = 161


def material_chart(own: Material, reached: ReachedStrain | None) -> Chart:
    """Uniaxial tension and compression, and equibiaxial tension beside it."""
    low, high = strains_drawn(own, reached)
    tested = own.valid_strain
    lines = (
        _line("uniaxial", own, low, high),
        _line("equibiaxial, tension", own, 0.0, high, dashed=True),
    )
    return Chart(
        f"Nominal stress of {own.name} over strain",
        "nominal strain, %",
        "nominal stress, MPa",
        lines,
        marks=tuple(_marks(own, reached)),
        shaded=() if tested is None else ((100 * tested[0], 100 * tested[1]),),
    )


def strains_drawn(own: Material, reached: ReachedStrain | None) -> tuple[float, float]:
    """Lowest and highest strain that is drawn: all that is named, and a little more."""
    lows, highs = [USUAL[0]], [0.0]
    highs += [USUAL[1]] if reached is None and own.valid_strain is None else []
    if reached is not None:
        lows, highs = [*lows, BEYOND * reached.lowest], [*highs, BEYOND * reached.highest, 0.3]
    if own.valid_strain is not None:
        lows.append(BEYOND * own.valid_strain[0])
        highs.append(BEYOND * own.valid_strain[1])
    return max(LOWEST, min(lows)), max(highs)


def uniaxial_stress(own: Material, strains: list[float]) -> list[float]:
    """Nominal stresses, MPa, at nominal strains of a uniaxial test."""
    return _stresses(own, "uniaxial", strains)


def _stresses(own: Material, mode: str, strains: list[float]) -> list[float]:
    import numpy as np

    from solver.material.homogeneous import MODES, nominal_stress

    found = nominal_stress(MODES[mode], 1 + np.array(strains), own.law_constants())
    return [float(each) for each in found]


def _line(name: str, own: Material, low: float, high: float, dashed: bool = False) -> Line:
    strains = [low + (high - low) * step / (POINTS - 1) for step in range(POINTS)]
    mode = "biaxial" if dashed else "uniaxial"
    stresses = _stresses(own, mode, strains)
    return Line(name, [100 * each for each in strains], stresses, dashed=dashed)


def _marks(own: Material, reached: ReachedStrain | None) -> Iterator[Mark]:
    if reached is None:
        return
    for strain in (reached.lowest, reached.highest):
        if strain > LOWEST:
            (stress,) = uniaxial_stress(own, [strain])
            yield Mark(100 * strain, stress, f"{100 * strain:+.0f} % reached")
