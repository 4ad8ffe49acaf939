"""Several specimens of one test: their mean curve and its spread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.series import Series
from solver.arrays import Reals
from solver.material.homogeneous import MODES

MOST_POINTS = 200
"""Of a mean curve."""


def mean_of(specimens: Sequence[Series]) -> tuple[Series, Reals, str]:
    """The mean curve of one test's specimens, its spread, and a note.

    The curve is that over the strains which all specimens reach, at the points of the one with
    most; the others are interpolated in between.

    Returns:
        The mean; the standard deviation of each of its points (n,), MPa; a sentence.

    Raises:
        DesignError: The specimens have no strains in common.
    """
    curves = [_sorted(each) for each in specimens]
    low = max(stretch[0] for stretch, _ in curves)
    high = min(stretch[-1] for stretch, _ in curves)
    grids = [stretch[(stretch >= low) & (stretch <= high)] for stretch, _ in curves]
    grid = max(grids, key=len)
    if grid.size < 2:
        raise DesignError(
            f"{specimens[0].place}: its {len(specimens)} specimens have no strains in common, of "
            "which a mean could be taken."
        )
    grid = grid[:: -(-grid.size // MOST_POINTS)]
    stresses = np.stack([np.interp(grid, stretch, stress) for stretch, stress in curves])
    mean, spread = stresses.mean(axis=0), stresses.std(axis=0, ddof=1)
    first = specimens[0]
    nothing = np.full(grid.size, np.nan)
    result = replace(first, specimen="", strain=grid, stress=mean, lines=nothing, time=nothing)
    return result, spread, _note(first, curves, grid, mean, spread)


def _sorted(series: Series) -> tuple[Reals, Reals]:
    """Stretches in rising order, each once, and the mean stress of each."""
    stretch, which = np.unique(series.strain, return_inverse=True)
    counts = np.bincount(which)
    return stretch, np.bincount(which, series.stress) / counts


def _note(
    first: Series, curves: Sequence[tuple[Reals, Reals]], grid: Reals, mean: Reals, spread: Reals
) -> str:
    """How many, how far they agree, and what is left out."""
    far = int(np.abs(mean).argmax())
    relative = spread / np.maximum(np.abs(mean), 0.05 * np.abs(mean).max())
    return (
        f"{len(curves)} specimens in {list(MODES)[first.mode]} tests: their mean is fitted, over "
        f"strains all of them reach ({100 * (grid[0] - 1):.3g} … {100 * (grid[-1] - 1):.3g} %); at "
        f"{100 * (grid[far] - 1):.3g} % it is {mean[far]:.4g} ± {spread[far]:.2g} MPa; the "
        f"standard deviation of a specimen is {100 * float(np.median(relative)):.2g} % (median)"
    )
