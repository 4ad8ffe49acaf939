"""Rigid motions in the plane of bending."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.deformed.joined.motion import Motion, fitted
from solver import Mesh, rotation

POINTS = np.random.default_rng(1).normal(size=(9, 3))
ONE, OTHER = Motion(0.7, 3.0, -2.0), Motion(-1.9, 0.5, 4.0)


def test_motions_are_composed() -> None:
    both = ONE.after(OTHER)
    assert both.applied(POINTS) == pytest.approx(ONE.applied(OTHER.applied(POINTS)))


def test_the_inverse_undoes() -> None:
    assert ONE.inverse.applied(ONE.applied(POINTS)) == pytest.approx(POINTS)


def test_a_mirrored_motion_moves_the_mirror_image() -> None:
    mirror = np.array([-1, 1, 1])
    assert ONE.mirrored.applied(POINTS * mirror) == pytest.approx(ONE.applied(POINTS) * mirror)


def test_a_motion_about_a_point_leaves_it() -> None:
    assert Motion.about(0.4, POINTS[2]).applied(POINTS[2:3]) == pytest.approx(POINTS[2:3])


def test_a_fit_finds_the_motion() -> None:
    found = fitted(POINTS, ONE.applied(POINTS))
    assert (found.angle, found.x, found.z) == pytest.approx((ONE.angle, ONE.x, ONE.z))


def test_the_angle_is_the_solvers_rotation() -> None:
    mesh = Mesh(POINTS, np.empty((0, 10)), {"tip": [[0, 1, 2, 3, 4, 5]]})
    turned = Motion(0.7).applied(POINTS) - POINTS
    assert np.radians(rotation(mesh, turned)) == pytest.approx(0.7)
