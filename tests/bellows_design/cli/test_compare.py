"""``bellows compare``: its answers, its files, and one sentence for what cannot be."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from synthetic_curves import made_up, model

from bellows_design.materials.library import load_material, material_at
from bellows_design.measured.model.bellows import BellowsModel
from bellows_design.measured.model.curve import ModelCurve
from bellows_design.measured.model.question import Question

Bellows = Callable[..., tuple[int, str, str]]
CONTRACT = {
    "design", "material", "data", "quantity", "unit", "zero_at_mpa", "reading", "model",
    "material_uncertainty_percent", "points", "points_reached", "points_inside_band", "factor",
    "not_determined", "departures", "sentences", "material_file", "plot_file", "refused",
}  # fmt: skip


@pytest.fixture(autouse=True)
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Question]:
    """A model in closed form instead of a solver's; what it was asked."""
    questions: list[Question] = []

    def curve(_: BellowsModel, question: Question, highest: float) -> ModelCurve:
        questions.append(question)
        return model(highest, error=0.01, by_force=question.quantity.by_force)

    monkeypatch.setattr(BellowsModel, "curve", curve)
    return questions


def written(folder: Path, factor: float = 1.2, header: str = "pressure_mpa,angle_deg") -> str:
    part = made_up(np.random.default_rng(1), factor, scatter=0.01, by_force="force" in header)
    rows = "".join(f"{p:.6f},{v:.6f}\n" for p, v in zip(part.pressure, part.value, strict=True))
    path = folder / "print.csv"
    path.write_text(f"{header}\n{rows}", "utf-8")
    return str(path)


def test_a_print_is_compared_drawn_and_calibrates_the_next_design(
    bellows: Bellows, tmp_path: Path
) -> None:
    plot, material = tmp_path / "both.png", tmp_path / "my_print.toml"
    status, out, err = bellows(
        "compare", "prototype_1", written(tmp_path), "--plot", str(plot), "--write-material",
        str(material), "--json",
    )  # fmt: skip
    found = json.loads(out)
    assert status == 0, err
    assert set(found) == CONTRACT | {"schema"} and len(found["points"]) == 20
    factor = found["factor"]
    assert factor["low"] <= 1.2 <= factor["high"] and not factor["agrees"]
    assert found["sentences"][0].startswith("Your print is 1.2")
    assert plot.stat().st_size > 10_000 and found["plot_file"] == str(plot)
    scaled = material_at(material)
    modulus = load_material("ninjaflex").initial_shear_modulus
    assert scaled.initial_shear_modulus == pytest.approx(factor["value"] * modulus)
    status, out, _ = bellows(
        "compare", "prototype_1", written(tmp_path), "--set", f"material={material}", "--json"
    )
    assert json.loads(out)["material"] == "my_print"


def test_the_text_has_reading_points_factor_and_sentence(bellows: Bellows, tmp_path: Path) -> None:
    status, out, _ = bellows("compare", "finger", written(tmp_path, 1.0))
    assert status == 0
    for words in (
        "read: the column “angle_deg” is read as bending angle", "95 % interval", "inside",
        "agrees with the data sheet",
    ):  # fmt: skip
        assert words in out


def test_angle_scene_and_sign_reach_the_model(
    bellows: Bellows, tmp_path: Path, asked: list[Question]
) -> None:
    bellows("compare", "finger", written(tmp_path), "--angle", "chord")
    force = written(tmp_path, header="pressure_mpa,force_n")
    scene = tmp_path / "desk.toml"
    scene.write_text('kind = "blocked"\nsupport = "wall"\ndistance = 6\n')
    status, out, err = bellows("compare", "finger", force, "--scene", str(scene), "--json")
    assert status == 0, err
    assert json.loads(out)["unit"] == "N"
    assert [each.angle for each in asked] == ["chord", "tangent"]
    assert asked[1].quantity.by_force and asked[1].scene_name == "desk"


def test_no_factor_is_no_material(bellows: Bellows, tmp_path: Path) -> None:
    flat, material = tmp_path / "flat.csv", tmp_path / "none.toml"
    flat.write_text("pressure_mpa,angle_deg\n" + "".join(f"{p / 100},0.001\n" for p in range(1, 9)))
    status, out, _ = bellows(
        "compare", "finger", str(flat), "--write-material", str(material), "--json"
    )
    found = json.loads(out)
    assert status == 1 and not material.exists()
    assert found["factor"] is None and found["refused"] == found["not_determined"]
    assert "does not determine the stiffness" in found["refused"]
    assert bellows("compare", "finger", str(flat))[0] == 0  # nothing was asked of the factor


REFUSALS = {
    "no data": ([], "there is no file"),
    "suffix": (["--plot", "x.pdf"], "must end in .png"),
    "material": (["--write-material", "x.csv"], "must end in .toml"),
    "no fit": (["--write-material", "x.toml", "--no-fit"], "--write-material needs the factor"),
    "offset": (["--fit-offset", "--no-fit"], "--fit-offset needs the fit"),
    "scene": (["--scene", "blocked"], "needs one of the kind free or payload"),
    "no scene": (["--scene", "nothing"], "unknown scene"),
    "part": (["--part", "skin"], "--part is for own bodies"),
    "zero": (["--zero-at", "0.5"], "--zero-at is 0.5 MPa but must lie between"),
    "uncertainty": (["--material-uncertainty", "-3"], "must be at least 0 and below 100 %"),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_what_cannot_be_is_refused_in_one_sentence(
    name: str, bellows: Bellows, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    options, said = REFUSALS[name]
    data = "none.csv" if name == "no data" else written(tmp_path)
    status, out, err = bellows("compare", "finger", data, *options)
    assert status == 2 and said in err and out == ""
    assert not list(tmp_path.glob("x.*"))
