"""Polynomials in place of evaluations."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.errors import DesignError
from bellows_design.study.sensitivity.surrogate import Data, error_at, fitted


def points(count: int, parameters: int) -> np.ndarray:
    return np.random.default_rng(count).uniform(-1, 1, (count, parameters))


def quadratic(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A response of five parameters with products, and its slopes."""
    matrix = np.array([[(i - j) * 0.3 + 0.2 for j in range(5)] for i in range(5)])
    linear = np.array([3.0, -2.0, 1.0, 0.5, 0.0])
    return 10 + x @ linear + np.einsum("ni,ij,nj->n", x, matrix, x), linear + x @ (
        matrix + matrix.T
    )


def exponential(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    weights = np.array([0.3, -0.2, 0.15, 0.1, -0.05])
    values = 10 * np.exp(x @ weights)
    return values, values[:, None] * weights


def test_a_quadratic_response_is_found_from_fewer_values_than_it_has_coefficients():
    x = points(10, 5)  # 21 coefficients, 60 equations
    values, slopes = quadratic(x)
    surrogate = fitted(Data(x, values, slopes))
    others = points(30, 5)
    assert surrogate(others) == pytest.approx(quadratic(others)[0], abs=1e-9)
    assert surrogate.error.r_squared == pytest.approx(1)


def test_gradients_make_a_surrogate_of_as_many_points_better():
    x, others = points(30, 5), points(200, 5)
    values, slopes = exponential(x)
    with_gradients = fitted(Data(x, values, slopes))
    without = fitted(Data(x, values))
    errors = [error_at(exponential(others)[0], each(others)) for each in (with_gradients, without)]
    assert errors[0].root_mean_square_percent < 0.5 * errors[1].root_mean_square_percent


def test_the_error_held_out_is_about_the_error_at_other_points():
    x, others = points(40, 5), points(400, 5)
    surrogate = fitted(Data(x, *exponential(x)))
    there = error_at(exponential(others)[0], surrogate(others)).root_mean_square_percent
    # From 40 points the root mean square is itself known to a third or so.
    assert 0.5 < surrogate.error.root_mean_square_percent / there < 3


def test_noise_that_no_polynomial_follows_shows_in_the_error_held_out():
    x = points(60, 3)
    noise = np.random.default_rng(0).normal(0, 1.0, 60)
    surrogate = fitted(Data(x, 100 + noise))
    assert surrogate.error.r_squared < 0.3
    assert surrogate.error.root_mean_square_percent == pytest.approx(1.0, rel=0.5)


def test_too_few_evaluations_are_refused_in_one_sentence():
    x = points(4, 2)
    with pytest.raises(DesignError, match="4 evaluations that succeeded are too few"):
        fitted(Data(x, x[:, 0]))
