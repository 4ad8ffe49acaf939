"""Which of the pipeline's results becomes the curve of a bellows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from linear_finger import linear_law

from bellows_design.budget import DEFAULT
from bellows_design.design.design import Design
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.payload import Payload
from bellows_design.design.shipped import load_design
from bellows_design.errors import UnreachedError
from bellows_design.force.scene.solved import Solved
from bellows_design.measured.model.bellows import BellowsModel
from bellows_design.measured.model.curve import BetweenFactors
from bellows_design.measured.model.question import Question
from bellows_design.measured.quantities import (
    ANGLE,
    CHORD,
    DISPLACEMENT,
    DISPLACEMENT_X,
    DISPLACEMENT_Z,
    FORCE,
)
from bellows_design.progress import SILENCE

FINGER = load_design("prototype_1")
END = 0.08
"""MPa, where the made-up evaluation's path ends."""


def evaluated(design: Design, *, pressures: Sequence[float], **_: Any) -> Any:
    """An angle in proportion to the pressure by the stiffness, as far as ``END`` times that."""
    stiffness = design.material.initial_shear_modulus / FINGER.material.initial_shear_modulus
    reached = [each for each in pressures if abs(each) <= END * stiffness]
    ended = len(reached) < len(pressures)
    ways = [
        SimpleNamespace(pressure_mpa=p, bending_angle_deg=1000 * p / stiffness) for p in reached
    ]
    return SimpleNamespace(
        converged=not ended, message="walls touch.", pressure_mpa=END * stiffness if ended else
        pressures[-1], curve=ways, meshes=(1, 2), warnings=("a warning",),
        model=SimpleNamespace(name="unit-cell"),
        error_estimate=SimpleNamespace(bending_angle_percent=None if ended else 2.0),
    )  # fmt: skip


@pytest.fixture(autouse=True)
def _made_up(monkeypatch: pytest.MonkeyPatch) -> None:
    def solved(design: Any, scene: Any, pressures: Any, *_: object) -> Solved:
        return Solved.of(design, scene, pressures, linear_law())

    monkeypatch.setattr("bellows_design.store.evaluated", evaluated, raising=False)
    monkeypatch.setattr("bellows_design.force.curve.solved_with_its_law", solved)


MODEL = BellowsModel(FINGER, SILENCE, DEFAULT)


def test_a_tangents_angle_is_the_evaluations() -> None:
    found = MODEL.curve(Question(ANGLE), 0.05)
    at = np.array([0.02, 0.05])
    assert found.values(at) == pytest.approx(1000 * at)
    assert found.values(at, 2.0) == pytest.approx(500 * at)
    assert found.errors(at) == pytest.approx(0.02 * 1000 * at)
    assert not found.ending and found.notes == (
        "the model is the unit-cell on 2 meshes",
        "a warning",
    )


def test_a_path_that_ends_is_computed_again_to_have_an_error() -> None:
    found = MODEL.curve(Question(ANGLE), 0.2)
    assert "load path ends at 0.08 MPa (walls touch)" in found.ending
    assert found.reach(1.0) == pytest.approx(0.97 * END)
    assert found.errors(np.array([0.05]))[0] == pytest.approx(1.0)


def test_no_more_is_asked_than_a_design_may_have() -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(globals(), "END", 99.0)
        assert MODEL.curve(Question(ANGLE), 5.0).reach(1.0) == pytest.approx(0.6)
        vacuum = MODEL.curve(Question(ANGLE, sign=-1.0), 5.0)
    assert vacuum.reach(1.0) == pytest.approx(0.101325)
    assert vacuum.values(np.array([0.05]))[0] == pytest.approx(-50)


def test_chord_and_displacement_are_those_of_the_tips_lower_edge() -> None:
    at, length = np.array([0.004, 0.008]), FINGER.finger_length
    angle, x, z, whole = (
        MODEL.curve(replace(Question(quantity), angle=CHORD), 0.01).values(at)
        for quantity in (ANGLE, DISPLACEMENT_X, DISPLACEMENT_Z, DISPLACEMENT)
    )
    assert (x < 0).all() and (z < 0).all() and whole == pytest.approx(np.hypot(x, z), rel=1e-3)
    assert angle == pytest.approx(np.degrees(np.arctan2(-z, length + x)), rel=1e-3)
    tangent = MODEL.curve(Question(ANGLE, scene=Free(), scene_name="free"), 0.01).values(at)
    assert angle == pytest.approx(tangent / 2, rel=0.1)  # half of it where the curvature is even


def test_a_force_is_that_of_the_scene_with_its_error() -> None:
    found = MODEL.curve(Question(FORCE), 0.05)
    at = np.array([0.02, 0.04])
    assert (found.values(at) > 0).all() and (np.diff(found.values(at)) > 0).all()
    assert found.values(2 * at, 2.0) == pytest.approx(2 * found.values(at))


def test_a_weight_is_computed_at_several_stiffnesses() -> None:
    scene = Payload(mass_g=20)
    found = MODEL.curve(Question(DISPLACEMENT_Z, scene=scene, scene_name="load"), 0.02)
    assert isinstance(found, BetweenFactors) and len(found.curves) == 3
    # The linear law knows no stiffness: displacements do not fall with it, only pressures do.
    assert abs(found.values(np.array([0.001]))[0]) > 0.1  # hangs without pressure


def test_a_model_that_reaches_no_pressure_is_refused() -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(globals(), "END", 1e-5)
        with pytest.raises(UnreachedError, match="reaches no pressure"):
            MODEL.curve(Question(ANGLE), 0.1)
