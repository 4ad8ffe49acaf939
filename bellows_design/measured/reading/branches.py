"""Loading and unloading: which way of a test that goes to and fro is read."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.branches import Branch, branches_of
from bellows_design.validation.quoting import did_you_mean, quoted
from solver.arrays import Reals

LOADING, UNLOADING, ALL = "loading", "unloading", "all"
BRANCHES = (LOADING, UNLOADING, ALL)

_NAMES = {
    LOADING: "loading load up inflation inflate rising belastung hin + 1 ↑",
    UNLOADING: "unloading unload down deflation deflate falling entlastung rück - -1 0 ↓",
}
_WORDS = {word: branch for branch, words in _NAMES.items() for word in words.split()}

MOST_ORDERED = 3
"""Branches that a few points may have and still stand in an order."""

POINTS_OF_A_BRANCH = 4
"""In the mean; with less the points of many branches stand in no order."""

Mask = NDArray[np.bool_]


def on_branch(pressure: Reals, wanted: str, names: Sequence[str] | None) -> tuple[Mask, str]:
    """(n,) which points are of the wanted branch, and a note on it; empty where nothing is left.

    ``names`` are the cells of a column that tells the branch; without one the order of the
    pressures (n,) does. Raises ``DesignError`` for an unknown name, or if no point is left.
    """
    if wanted == ALL:
        return np.ones(pressure.size, bool), ""
    if names is not None:
        chosen = np.array([_named(name) == wanted for name in names])
        told = "as the column of branches says"
    else:
        chosen, told = _by_order(np.abs(pressure), wanted)
    if not chosen.any():
        raise DesignError(f"--branch {wanted}: no point of the file is of that branch.")
    left = int((~chosen).sum())
    if not left:
        return chosen, ""
    others = "are" if left > 1 else "is"
    return chosen, (
        f"the pressure goes to and fro: {wanted} is used, {told}, and {left} other "
        f"point{'s' * (left > 1)} {others} left out; --branch all uses all"
    )


def _named(name: str) -> str:
    word = name.strip().lower()
    if word not in _WORDS:
        raise DesignError(
            f"a branch is called {quoted(name)}{did_you_mean(word, (LOADING, UNLOADING))}"
        )
    return _WORDS[word]


def _by_order(size: Reals, wanted: str) -> tuple[Mask, str]:
    found = branches_of(size)
    if len(found) > max(MOST_ORDERED, size.size / POINTS_OF_A_BRANCH):
        return np.ones(size.size, bool), ""  # in no order: each point by itself
    chosen = np.zeros(size.size, bool)
    for each in found:
        if (_is_loading(each)) == (wanted == LOADING):
            chosen[each.start : each.end] = True
    return chosen, "as the order of the points says"


def _is_loading(branch: Branch) -> bool:
    """A way back of one point is the start of another loading."""
    return branch.rising or (branch.start > 0 and branch.end - branch.start == 1)
