"""Which points of a space of parameters are looked at."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import DesignError
from bellows_design.study.sweep.space import Axis

MOST = 1_000_000
"""Designs of a sweep. Each takes a kilobyte in memory and in the file."""


class Sampling(StrEnum):
    """How points are chosen."""

    GRID = "grid"
    LATIN_HYPERCUBE = "lhs"
    RANDOM = "random"


def points(
    axes: Sequence[Axis], sampling: Sampling, number: int | None, seed: int
) -> NDArray[np.float64]:
    """Values of the axes, shape (points, axes), in the unit of each.

    A grid has those of all axes with all of the others; ``number`` and ``seed`` are those of a
    sample, which is the same for the same seed. A Latin hypercube divides each axis into as many
    parts as there are points and has one in each (McKay, Beckman and Conover, Technometrics 21(2),
    1979).

    Raises:
        DesignError: No number, too large a one, or one that belongs to another kind of sample.
    """
    _require_numbers(axes, sampling, number)
    if sampling is Sampling.GRID:
        values = (np.linspace(axis.low, axis.high, axis.number or 0) for axis in axes)
        return np.stack(np.meshgrid(*values, indexing="ij"), axis=-1).reshape(-1, len(axes))
    assert number is not None
    low, high = np.array([[axis.low, axis.high] for axis in axes]).T
    return low + (high - low) * _in_unit_cube(sampling, number, len(axes), seed)


def _in_unit_cube(
    sampling: Sampling, number: int, dimensions: int, seed: int
) -> NDArray[np.float64]:
    generator = np.random.default_rng(seed)
    if sampling is Sampling.RANDOM:
        return generator.random((number, dimensions))
    from scipy.stats import qmc

    found: NDArray[np.float64] = qmc.LatinHypercube(dimensions, seed=generator).random(number)
    return found


def _require_numbers(axes: Sequence[Axis], sampling: Sampling, number: int | None) -> None:
    if sampling is Sampling.GRID:
        if number is not None:
            raise DesignError(
                "--number belongs to --sample lhs and random; a grid has a number for each "
                "parameter: --vary bubble_width=16:20:5."
            )
        _require_divided(axes)
        number = int(np.prod([float(axis.number or 0) for axis in axes]))
    elif number is None:
        raise DesignError(f"--sample {sampling.value} needs the --number of designs.")
    if sampling is not Sampling.GRID and any(axis.number for axis in axes):
        name = next(axis.name for axis in axes if axis.number)
        raise DesignError(f"{name} has a number of values, which belongs to --sample grid.")
    if not 1 <= number <= MOST:
        raise DesignError(f"the sweep has {number} designs but must have 1 to {MOST}.")


def _require_divided(axes: Sequence[Axis]) -> None:
    for axis in axes:
        if axis.number is None:
            raise DesignError(
                f"{axis.name} has no number of values, which a grid needs: --vary {axis}:5; or "
                "take a sample: --sample lhs --number 100."
            )
