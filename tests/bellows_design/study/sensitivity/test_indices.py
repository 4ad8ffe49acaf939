"""Sobol' indices against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.study.sensitivity.indices import sobol_indices
from bellows_design.study.sensitivity.surrogate import Data, fitted

pytest.importorskip("SALib")


def test_the_indices_of_ishigamis_function_are_those_of_its_closed_form():
    """T. Ishigami, T. Homma, ISUMA 1990, with a = 7 and b = 0.1."""
    a, b = 7.0, 0.1

    def ishigami(x: np.ndarray) -> np.ndarray:
        one, two, three = (np.pi * x).T
        return np.sin(one) + a * np.sin(two) ** 2 + b * three**4 * np.sin(one)

    alone = 0.5 * (1 + b * np.pi**4 / 5) ** 2
    second, mixed = a**2 / 8, b**2 * np.pi**8 * (1 / 18 - 1 / 50)
    variance = alone + second + mixed
    first = {"one": alone / variance, "two": second / variance, "three": 0.0}
    total = {"one": (alone + mixed) / variance, "two": second / variance, "three": mixed / variance}
    found = sobol_indices(ishigami, ("one", "two", "three"), seed=0)
    assert [each.parameter for each in found] == ["one", "two", "three"]
    for each in found:
        assert each.first == pytest.approx(first[each.parameter], abs=0.02)
        assert each.total == pytest.approx(total[each.parameter], abs=0.02)
        assert each.total_confidence < 0.1


def test_the_indices_of_a_linear_surrogate_are_the_squares_of_its_slopes():
    slopes = np.array([3.0, -2.0, 1.0])
    x = np.random.default_rng(0).uniform(-1, 1, (12, 3))
    surrogate = fitted(Data(x, 5 + x @ slopes, np.tile(slopes, (12, 1))))
    found = {each.parameter: each for each in sobol_indices(surrogate, "abc", seed=1)}
    for name, share in zip("abc", slopes**2 / 14, strict=True):
        assert found[name].first == pytest.approx(share, abs=0.01)
        assert found[name].total == pytest.approx(share, abs=0.01)


@pytest.mark.parametrize("seed", [0, 1])
def test_the_same_seed_gives_the_same_indices_and_intervals(seed: int):
    one, other = (sobol_indices(lambda x: x[:, 0] + x[:, 1] ** 2, "ab", seed, 64) for _ in range(2))
    assert one == other


def test_intervals_are_narrower_with_more_samples():
    def product(x: np.ndarray) -> np.ndarray:
        return x[:, 0] * (1 + x[:, 1])

    few, many = (sobol_indices(product, "ab", 0, count)[0] for count in (64, 4096))
    assert many.first_confidence < 0.5 * few.first_confidence
