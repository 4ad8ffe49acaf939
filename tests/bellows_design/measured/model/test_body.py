"""Which of an own body's readings becomes its curve, and at which stiffnesses it is computed."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import cadquery as cq
import numpy as np
import pytest

from bellows_design.budget import DEFAULT
from bellows_design.errors import DesignError
from bellows_design.materials.library import load_material
from bellows_design.measured.model.body import BodyModel
from bellows_design.measured.model.curve import BetweenFactors, ScaledByPressure
from bellows_design.measured.model.question import Question
from bellows_design.measured.quantities import (
    ANGLE,
    CHORD,
    DISPLACEMENT,
    DISPLACEMENT_Z,
    FORCE,
    Quantity,
)
from bellows_design.own_body import OwnBody
from bellows_design.own_body.analysis.readings import BodyReading
from bellows_design.progress import SILENCE

SOFT = load_material("ecoflex_00_30").initial_shear_modulus


def body(**changed: Any) -> OwnBody:
    """A box that stands for anything: its evaluation is made up."""
    part = {"name": "silicone", "solid": cq.Workplane().box(4, 2, 1), "material": "ecoflex_00_30"}
    given = {
        "name": "made_up", "parts": (part,),
        "surfaces": {"root": "<X", "tip": ">X", "cavity": "<Z"},
        "load": {"pressure": 0.02},
    }  # fmt: skip
    return OwnBody.of(given | changed)


def reading(pressure: float, stiffness: float, contact: bool = True) -> BodyReading:
    turn = 4000 * pressure / stiffness  # degrees; past half a turn for the chord
    chord = (turn / 2 + 180) % 360 - 180
    return BodyReading(
        pressure, turn, chord, (-turn / 10, 0.0, -turn / 5), 50 * pressure if contact else None,
        0.1, 100.0,
    )  # fmt: skip


def evaluate(body: OwnBody, *, pressures: Sequence[float] = (), **_: Any) -> Any:
    """A body that turns in proportion to its pressure; by volume it balloons at 0.02 MPa."""
    stiffness = body.parts[0].material.initial_shear_modulus / SOFT
    volumes = [0.01, 0.02, 0.015, 0.018, 0.03] if body.load.by_volume else pressures
    ways = [
        reading(each * (stiffness if body.load.by_volume else 1), stiffness) for each in volumes
    ]
    error = SimpleNamespace(
        bending_angle_percent=1.0, chord_angle_percent=2.0, tip_displacement_percent=3.0,
        contact_force_percent=4.0, pressure_percent=1.0,
    )  # fmt: skip
    return SimpleNamespace(
        body=body, converged=True, message="", pressure_mpa=ways[-1].pressure_mpa, curve=ways,
        meshes=(1, 2), reason="the whole body", warnings=(), error_estimate=error,
    )  # fmt: skip


@pytest.fixture(autouse=True)
def _made_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bellows_design.own_body.analysis.evaluate.evaluate", evaluate)


def model(**changed: Any) -> BodyModel:
    return BodyModel(body(**changed), SILENCE, DEFAULT)


AT = np.array([0.02, 0.05])


@pytest.mark.parametrize(
    ("quantity", "angle", "value", "percent"),
    [
        (ANGLE, "tangent", 4000 * AT, 1),
        (ANGLE, CHORD, 2000 * AT, 2),
        (DISPLACEMENT_Z, "tangent", -800 * AT, 3),
        (DISPLACEMENT, "tangent", 400 * np.sqrt(5) * AT, 3),
        (FORCE, "tangent", 50 * AT, 4),
    ],
)
def test_every_quantity_is_read_with_its_error(
    quantity: Quantity, angle: str, value: np.ndarray, percent: float
) -> None:
    found = model().curve(Question(quantity, angle), 0.1)
    assert isinstance(found, ScaledByPressure)
    assert found.values(AT) == pytest.approx(value, rel=1e-6)
    assert found.errors(AT) == pytest.approx(percent / 100 * np.abs(value), rel=1e-6)


@pytest.mark.parametrize(
    "changed",
    [
        {"films": ({"surface": "tip", "young_modulus": 4100, "thickness": 0.5},)},
        {
            "gravity": {},
            "parts": (
                {
                    "name": "silicone", "solid": cq.Workplane().box(4, 2, 1),
                    "material": "ecoflex_00_30", "density_kg_m3": 1070,
                },
            ),
        },
    ],
    ids=["film", "weight"],
)  # fmt: skip
def test_what_the_factor_does_not_scale_takes_several_curves(changed: dict[str, Any]) -> None:
    found = model(**changed).curve(Question(ANGLE), 0.1)
    assert isinstance(found, BetweenFactors)
    assert found.values(AT, 1.3) == pytest.approx(4000 * AT / 1.3, rel=1e-3)


def test_the_part_in_question_is_the_one_that_is_scaled() -> None:
    parts = tuple(
        {
            "name": name, "material": material,
            "solid": cq.Workplane(origin=(0, 0, place)).box(4, 2, 1),
        }
        for name, material, place in (("silicone", "ecoflex_00_30", 0), ("cap", "ninjaflex", 1))
    )  # fmt: skip
    both = body(parts=parts)
    chosen = BodyModel(both, SILENCE, DEFAULT, "cap")
    assert chosen.material.name == "ninjaflex" and chosen.materials == 1
    assert isinstance(chosen.curve(Question(ANGLE), 0.1), BetweenFactors)
    assert BodyModel(both, SILENCE, DEFAULT).materials == 2
    with pytest.raises(DesignError, match="--part “cup”; did you mean cap"):
        BodyModel(both, SILENCE, DEFAULT, "cup")


def test_a_body_by_volume_is_followed_as_a_rising_pressure_would() -> None:
    found = model(load={"largest_volume": 3.0}).curve(Question(ANGLE), 0.1)
    assert "volume given ends at 0.03 MPa" in found.ending
    before, after = found.values(np.array([0.0199, 0.0205]))
    assert before == pytest.approx(4000 * 0.0199, rel=0.01)
    assert after == pytest.approx(4000 * 0.0205, rel=0.05)


def test_a_growing_volume_is_not_held_against_a_vacuum() -> None:
    with pytest.raises(DesignError, match=r"no pressure is below 0 MPa, but the measured ones are"):
        model(load={"largest_volume": 3.0}).curve(Question(ANGLE, sign=-1.0), 0.1)


def test_what_a_body_has_nothing_for_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def without(pressure: float, stiffness: float) -> BodyReading:
        return BodyReading(pressure, None, None, None, None, 0.1, None)

    monkeypatch.setitem(globals(), "reading", without)
    for quantity, said in (
        (ANGLE, "no surface “tip”"),
        (FORCE, "no obstacle"),
        (DISPLACEMENT, "tip"),
    ):
        with pytest.raises(DesignError, match=f"made_up has no .*{said}"):
            model().curve(Question(quantity), 0.1)
