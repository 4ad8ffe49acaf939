"""Values extended from known points to the others."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.morphing.extension import extension, path_stiffness, simplex_stiffness

SIDE = np.linspace(0, 1, 6)
POINTS = np.stack(np.meshgrid(SIDE, SIDE, [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
QUADS = np.array([[6 * i + j, 6 * i + j + 1, 6 * i + j + 6] for i in range(5) for j in range(5)])
TRIANGLES = np.concatenate([QUADS, np.stack([QUADS[:, 1], QUADS[:, 2] + 1, QUADS[:, 2]], axis=1)])
BORDER = ((POINTS[:, :2] == 0) | (POINTS[:, :2] == 1)).any(axis=1)
ALL = np.ones(len(POINTS), bool)


def test_linear_values_stay_linear_on_equal_cells() -> None:
    extended = extension(simplex_stiffness(POINTS, TRIANGLES), BORDER, ALL)
    values = POINTS @ np.array([[1.0, 2.0], [-3.0, 0.5], [0, 0]])
    assert extended(np.where(BORDER[:, None], values, 0.0)) == pytest.approx(values, abs=1e-12)


def test_constant_values_stay_constant_on_unequal_cells() -> None:
    points = POINTS**1.7
    extended = extension(simplex_stiffness(points, TRIANGLES), BORDER, ALL)
    assert extended(np.where(BORDER[:, None], 3.0, 0.0)) == pytest.approx(3.0, abs=1e-12)


def test_a_path_is_interpolated_by_its_length() -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 2, 0], [1, 2, 5]])
    edges = np.array([[0, 1], [1, 2], [2, 3]])
    known = np.array([True, False, False, True])
    extended = extension(path_stiffness(points, edges), known, np.ones(4, bool))
    assert extended(np.array([[0.0], [0], [0], [8]]))[:, 0] == pytest.approx([0, 1, 3, 8])


def test_the_transposed_extension_gives_the_same_products() -> None:
    generator = np.random.default_rng(3)
    extended = extension(simplex_stiffness(POINTS**1.3, TRIANGLES), BORDER, ALL)
    values, gradient = generator.normal(size=(2, len(POINTS), 3))
    values = np.where(BORDER[:, None], values, 0.0)
    product = (extended.transposed(gradient) * values).sum()
    assert product == pytest.approx((gradient * extended(values)).sum(), rel=1e-12)


def test_nothing_unknown_is_nothing_to_do() -> None:
    extended = extension(simplex_stiffness(POINTS, TRIANGLES), ALL, ALL)
    assert (extended(POINTS) == POINTS).all()
