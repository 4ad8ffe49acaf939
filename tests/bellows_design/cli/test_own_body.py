"""``bellows evaluate`` on a body of one's own."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from own_body.bodies import bar

from bellows_design.materials.library import material_at
from bellows_design.measured.calibrated import with_stiffness
from bellows_design.own_body import write_body
from bellows_design.own_body.analysis.evaluate import evaluate

Bellows = Callable[..., tuple[int, str, str]]

FILM = {"young_modulus": 0.3, "thickness": 0.2}


@pytest.fixture
def file(tmp_path: Path) -> str:
    """A small bar as TOML and STEP."""
    path = tmp_path / "bar.toml"
    write_body(bar(), path)
    return str(path)


@pytest.mark.thorough
def test_a_body_is_evaluated_at_the_pressures_asked_for(
    bellows: Bellows, file: str, tmp_path: Path
) -> None:
    vtu = tmp_path / "bar.vtu"
    asked = ("--pressure", "0.001:0.002:0.001", "--vtu", str(vtu), "--json")
    status, out, _ = bellows("evaluate", file, *asked)
    found = json.loads(out)
    assert status == 0 and found["body"] == "bar" and found["converged"]
    assert [at["pressure_mpa"] for at in found["curve"]] == pytest.approx([0.001, 0.002])
    assert 0 < found["curve"][0]["bending_angle_deg"] < found["bending_angle_deg"]
    assert found["parts"][0]["material"] == "rubber"
    assert vtu.stat().st_size > 1000


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--set", "load.pressure=0.1"), "--set changes designs of bellows"),
        (("--model", "half"), "an own body has one model only"),
        (("--sensitivities",), "leave them out"),
        (("--pressure", "3"), "must be at most 2 MPa"),
    ],
)
def test_options_of_bellows_are_refused_in_one_sentence(
    bellows: Bellows, file: str, options: tuple[str, ...], sentence: str
) -> None:
    status, out, err = bellows("evaluate", file, *options)
    assert status == 2 and not out and sentence in err


def test_other_commands_say_that_they_take_bellows_only(bellows: Bellows, file: str) -> None:
    status, _, err = bellows("run", file)
    assert status == 2 and "is a body of one's own, which only evaluate and compare take" in err


@pytest.mark.slow
@pytest.mark.parametrize(
    "more",
    [{}, {"gravity": {}, "films": [{"surface": "outside", **FILM}]}],
    ids=["plain", "weight and film"],
)
def test_a_stiffer_body_is_told_from_its_measured_curve(
    bellows: Bellows, tmp_path: Path, more: dict[str, Any]
) -> None:
    """1.3 times as stiff on another mesh, films and weight aside, which stay as they are."""
    path, data, material = (tmp_path / name for name in ("bar.toml", "bar.csv", "print.toml"))
    body = bar(**more)
    write_body(body, path)
    (silicone,) = body.parts
    stiffer = silicone.model_copy(update={"material": with_stiffness(silicone.material, 1.3)})
    asked = [k * 1e-3 for k in range(1, 9)]
    measured = body.model_copy(update={"parts": (stiffer,)}).at_pressure(asked[-1])
    curve = evaluate(measured, pressures=asked, meshes=1).curve
    rows = "".join(f"{at.pressure_mpa},{at.chord_angle_deg}\n" for at in curve)
    data.write_text(f"pressure_mpa,chord_angle_deg\n{rows}", "utf-8")
    options = ("--angle", "chord", "--write-material", str(material), "--json")
    status, out, err = bellows("compare", str(path), str(data), *options)
    assert status == 0, err
    factor = json.loads(out)["factor"]
    assert factor["low"] < 1.3 < factor["high"] < 2 and factor["value"] == pytest.approx(1.3, 0.15)
    modulus = material_at(material).initial_shear_modulus
    assert modulus == pytest.approx(factor["value"] * silicone.material.initial_shear_modulus)
