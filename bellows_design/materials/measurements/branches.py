"""Tests that go to and fro: which branch of them is read.

A turn is where the strain goes back by more than 2.5 % of its range. Loading for the first time is
the default: the stress of a part that was never strained before. It runs along all loadings as far
as each goes beyond the earlier ones.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.series import Series
from solver.arrays import Reals

TURN = 0.025
"""Part of the range of strain that a branch has at least."""

SHORTEST_BRANCH = 4
"""Points of a branch in the mean; less are points in no order."""


class Branch(NamedTuple):
    """Points from ``start`` to before ``end``; ``rising`` with the size of the strain."""

    start: int
    end: int
    rising: bool


def branches_of(strain: Reals) -> list[Branch]:
    """The branches between the turns of strains (n,) in their order."""
    threshold = TURN * float(np.ptp(strain)) if strain.size else 0.0
    if threshold == 0:
        return [Branch(0, strain.size, True)]
    turns, rising = _turns(strain.tolist(), threshold)
    ends = [0, *turns, strain.size]
    return [
        Branch(low, high, rising if k % 2 == 0 else not rising)
        for k, (low, high) in enumerate(pairwise(ends))
    ]


def _turns(strain: list[float], threshold: float) -> tuple[list[int], bool]:
    """Where branches end, each point after an extreme, and whether the first of them rises."""
    turns: list[int] = []
    high = low = 0
    direction = first = 0
    for k, value in enumerate(strain):
        high = k if value > strain[high] else high
        low = k if value < strain[low] else low
        if direction >= 0 and value < strain[high] - threshold:
            if direction > 0 or high > 0:
                turns.append(high + 1)
            first, direction, low = first or (1 if high > 0 else -1), -1, k
        elif direction <= 0 and value > strain[low] + threshold:
            if direction < 0 or low > 0:
                turns.append(low + 1)
            first, direction, high = first or (-1 if low > 0 else 1), 1, k
    return turns, first >= 0


def on_one_branch(series: Series, wanted: str | None) -> tuple[list[Series], str | None]:
    """The points of the wanted branch, or of each specimen, and a note on what was left out.

    ``series.strain`` is a stretch. Raises ``DesignError`` where returns may be new specimens.
    """
    size = series.strain - 1
    sign = -1.0 if -size.min() > size.max() else 1.0
    if min(-size.min(), size.max()) > 0.1 * max(-size.min(), size.max()):
        return _both_signs(series, wanted)
    found = branches_of(sign * size)
    rising = [each for each in found if each.rising]
    if wanted == "all" or len(found) < 2 or not rising:
        return [series], None
    if series.strain.size < SHORTEST_BRANCH * len(found):
        return _in_steps(series, found, sign * size, wanted)
    if (
        not any(_is_jump(each, sign * size) for each in found if not each.rising)
        and wanted != "specimens"
    ):
        return _chosen(series, found, sign * size, wanted)
    return _in_steps(series, found, sign * size, wanted)


def _both_signs(series: Series, wanted: str | None) -> tuple[list[Series], str | None]:
    """Tension and compression each by itself, then together again."""
    parts, notes = [], []
    for mask in (series.strain < 1, series.strain >= 1):
        part, note = on_one_branch(series.at(mask), wanted)
        parts += part
        notes += [note] if note else []
    if wanted == "specimens":
        return parts, "; ".join(notes) or None
    kept = np.isin(series.lines, np.concatenate([part.lines for part in parts]))
    return [series.at(kept)], "; ".join(notes) or None


def _is_jump(branch: Branch, size: Reals) -> bool:
    """True if a way back has no points on it: most of it is one step."""
    begin, end = size[branch.start - 1], size[branch.end - 1]
    return bool(branch.start > 0 and begin - size[branch.start] > 0.5 * (begin - end))


def _in_steps(
    series: Series, found: list[Branch], size: Reals, wanted: str | None
) -> tuple[list[Series], str | None]:
    """Loadings that begin again without a way back: specimens, cycles, or points in no order."""
    starts = [each.start for each in found if each.rising]
    returns = [each for each in found if not each.rising]
    if series.strain.size < SHORTEST_BRANCH * len(starts) or not all(
        _is_jump(each, size) for each in returns
    ):
        if wanted in (None, "all"):
            return [series], "the points stand in no order of strain; all are used"
        raise DesignError(
            f"{series.place} has points in no order of strain: --branch {wanted} finds no branch."
        )
    restarts = [_restart(each, size) for each in returns]
    if wanted is None and min(np.diff([0, *restarts, size.size])) < SHORTEST_BRANCH:
        return [series], "a few points stand in no order of strain; all are used"
    timed = _times_restart(series, restarts)
    if wanted == "specimens" or (wanted is None and timed):
        parts = np.split(np.arange(size.size), restarts)
        why = ": time begins again as well" if wanted is None else ""
        return [series.at(part) for part in parts if part.size], (
            f"the strain begins again {len(restarts)} times, each a new specimen{why}"
        )
    if wanted is None and timed is None:
        raise DesignError(
            f"{series.where(restarts[0])}: the strain begins again after "
            f"{100 * size[restarts[0] - 1]:.3g} %; --branch specimens, --branch first or --branch "
            "last tells whether these are specimens, or loadings of one; --branch all uses all."
        )
    return _chosen(series, found, size, wanted)


def _restart(branch: Branch, size: Reals) -> int:
    """The first point of the new loading."""
    return min(branch.start, size.size - 1)


def _times_restart(series: Series, restarts: list[int]) -> bool | None:
    """Whether time begins again with the strain; None without times."""
    if np.isnan(series.time).any():
        return None
    return bool(all(series.time[k] < series.time[k - 1] for k in restarts))


def _chosen(
    series: Series, found: list[Branch], size: Reals, wanted: str | None
) -> tuple[list[Series], str]:
    rising = [each for each in found if each.rising]
    if wanted == "last":
        longest = max(np.ptp(size[each.start : each.end]) for each in rising)
        last = [each for each in rising if np.ptp(size[each.start : each.end]) > longest / 2][-1]
        kept, what = np.arange(last.start, last.end), "loading for the last time"
    else:
        kept, what = _first_loading(rising, size), "loading for the first time"
    span = f"strains {100 * size[kept].min():.3g} … {100 * size[kept].max():.3g} %"
    other = "first" if wanted == "last" else "last"
    return [series.at(kept)], (
        f"the test goes to and fro, {len(rising)} times up: {what} is used ({span}), "
        f"{size.size - kept.size} other points are left out; --branch {other} uses the {other}"
    )


def _first_loading(rising: list[Branch], size: Reals) -> np.ndarray:
    """Indices of the first loading, and of later ones where they go beyond all before."""
    kept = [np.arange(rising[0].start, rising[0].end)]
    reached = size[kept[0]].max()
    for each in rising[1:]:
        points = np.arange(each.start, each.end)
        kept.append(points[size[points] > reached])
        reached = max(reached, size[points].max())
    return np.concatenate(kept)
