"""Stress against force: a table that has both, and the area, says itself which stress it is."""

from __future__ import annotations

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.columns import Pair, shown
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.series import Series
from bellows_design.materials.measurements.table.facts import initial_area
from bellows_design.materials.measurements.table.header import Table
from bellows_design.materials.measurements.table.rows import Sheet
from bellows_design.materials.measurements.table.units import FORCE
from solver.arrays import Reals

SAME = 0.03
"""Relative difference within which stresses are the same."""

STRETCHED = 1.15
"""Stretch from which on nominal and true stress differ by more than that."""


def checked_by_force(
    series: Series, table: Table, pair: Pair, sheet: Sheet, options: ReadingOptions
) -> str | None:
    """A note if the nominal stress of ``series`` is its force over the area, None without both.

    Raises:
        DesignError: It is the force over the present area: true stress, which nobody said.
    """
    area = options.area or initial_area(table.facts)
    columns = [k for k, each in enumerate(table.headings) if each.quantity == "force"]
    if area is None or len(columns) != 1 or columns[0] == pair.stress:
        return None
    forces = _forces(series, table, columns[0], sheet)
    factor = FORCE.get(table.headings[columns[0]].unit or "")
    usable = (series.strain > STRETCHED) & (np.abs(forces) > 0) & np.isfinite(forces)
    if factor is None or usable.sum() < 3:
        return None
    ratio = series.stress[usable] / (forces[usable] * factor / area)
    if np.median(np.abs(ratio - 1)) < SAME:
        return f"{shown(table.headings[pair.stress])} is the force over {area:g} mm²: nominal"
    if np.median(np.abs(ratio / series.strain[usable] - 1)) < SAME:
        raise DesignError(
            f"{table.named}: {shown(table.headings[pair.stress])} is the force over the present "
            "area, which is true stress; --true-stress turns it into nominal stress."
        )
    return None


def _forces(series: Series, table: Table, column: int, sheet: Sheet) -> Reals:
    """The forces in the rows of the points, NaN where there is none."""
    found = {
        row.number: sheet.number(row.cells[column]) for row in table.rows if column < len(row.cells)
    }
    values = [found.get(int(line)) for line in series.lines]
    return np.array([np.nan if value is None else value for value in values])
